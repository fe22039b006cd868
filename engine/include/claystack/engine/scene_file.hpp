#pragma once
// `*.scene.json`: strict JSON, described by samples/schema/scene.schema.json.

#include "claystack/engine/result.hpp"
#include "claystack/engine/scene.hpp"

#include <string>
#include <string_view>

namespace clay {

/// Errors read "NAME:LINE: FIELD: what was expected, what was found". Unknown fields, duplicate
/// keys, wrong types and values outside their range are errors. `schema`, `lump` and `tool` must
/// be there; what else is absent takes its default in SceneSpec, but without `force` or
/// `stability` that stage is left out.
Result<SceneSpec> parse_scene(std::string_view text, std::string_view name);
/// Every field, defaults too. A value outside its range is written as it is, for the reader to
/// refuse.
std::string write_scene(const SceneSpec& scene);

}  // namespace clay
