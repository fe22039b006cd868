#pragma once
// `*.scene.json`: strict JSON, described by samples/schema/scene.schema.json.

#include "claystack/engine/result.hpp"
#include "claystack/engine/scene.hpp"

#include <string>
#include <string_view>

namespace clay {

/// Errors read "NAME:LINE: what was expected, what was found". Unknown fields, duplicate
/// keys, wrong types and values outside their range are errors.
Result<SceneSpec> parse_scene(std::string_view text, std::string_view name);
std::string write_scene(const SceneSpec& scene);

}  // namespace clay
