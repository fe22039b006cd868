#pragma once
#include "claystack/engine/scene.hpp"
#include "core/json/json_builder.hpp"
#include "core/json/located_json.hpp"

#include <array>
#include <string_view>

namespace clay::files {

/// The JSON document of a scene.
Json scene_json(const SceneSpec& scene);
Result<SceneSpec> scene_of(const LocatedJson& document);

// Also used by the pot file, which repeats some fields of its scene.
inline constexpr std::array<std::string_view, 2> kModelNames = {"conserving", "paper"};

}  // namespace clay::files
