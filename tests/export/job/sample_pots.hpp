#pragma once
// The sample pots, thrown in memory from their scenes and sessions.

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"

#include <array>
#include <string>

namespace clay::solid::samples {

inline constexpr std::array kStandingPots{"vase", "bowl", "bottle", "cylinder"};

/// CLAYSTACK_SAMPLES names the folder; a fault in a file is an error that names the file.
inline Result<Pot> thrown_pot(const std::string& sample) {
  const std::string path = std::string(CLAYSTACK_SAMPLES "/") + sample;
  const auto parsed = [&](const std::string& ending, auto parse) {
    return read_file(path + ending).and_then([&](const std::string& text) {
      return parse(text, path + ending);
    });
  };
  auto scene = parsed(".scene.json", parse_scene);
  if (!scene) return tl::make_unexpected(scene.error());
  const auto session = parsed(".session", parse_session);
  if (!session) return tl::make_unexpected(session.error());
  auto wheel = Wheel::build(*scene);
  if (!wheel) return tl::make_unexpected(wheel.error());
  for (const Pose& pose : session->poses) wheel->step(pose);
  return wheel->pot();
}

}  // namespace clay::solid::samples
