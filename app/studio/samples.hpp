#pragma once
// The samples that come with the program, so that a first pot needs no file.

#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/scene.hpp"

#include <array>
#include <string_view>

namespace clay::studio {

struct Sample {
  std::string_view name;
  const char* title;
  const char* words;                          ///< what it teaches
  std::string_view scene_text, session_text;  ///< as in samples/
};

[[nodiscard]] const std::array<Sample, 4>& samples();
[[nodiscard]] const Sample* find_sample(std::string_view name);

Result<SceneSpec> scene_of(const Sample& sample);
/// What its session makes of it; some 20 ms of work.
Result<render::PotView> finished(const Sample& sample);

/// A plain lump for one's own pot: a cylinder of that radius, as high as the clay makes it, and
/// settings in proportion to it. Refuses what StepPlan::build refuses.
inline constexpr double kLeastClayKg = 0.1, kMostClayKg = 20.0;
[[nodiscard]] SceneSpec lump_of(double clay_kg, double radius_mm);
[[nodiscard]] double lump_height_mm(double clay_kg, double radius_mm);

}  // namespace clay::studio
