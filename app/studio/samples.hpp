#pragma once
// Samples embedded in the program, so that a first pot needs no file.

#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"

#include <array>
#include <string_view>

namespace clay::studio {

struct Sample {
  std::string_view name;
  const char* title;
  const char* description;                                  ///< purpose of the sample
  std::string_view scene_text, session_text, strokes_text;  ///< contents of the files in samples/
};

inline constexpr std::size_t kSamples = 4;
[[nodiscard]] const std::array<Sample, kSamples>& samples();

Result<SceneSpec> scene_of(const Sample& sample);
/// The pot that the session of the sample makes; takes about 0.1 s.
Result<Pot> finished_pot(const Sample& sample);
Result<render::PotView> finished(const Sample& sample);

}  // namespace clay::studio
