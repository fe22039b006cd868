#pragma once
// Tasks for the simulated potters, and their results.

#include "app/bench/hands/pot_measures.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace clay::bench {

enum class Task { open, cylinder, belly, collar, bowl, plate, bottle };
inline constexpr std::array kTasks{Task::open, Task::cylinder, Task::belly, Task::collar,
                                   Task::bowl, Task::plate,    Task::bottle};

struct TaskFacts {
  std::string_view name;
  std::string_view strokes;
  double width_mm;         ///< intended width
  double least_printable;  ///< share of pots that must be printable with the clay rules
};
[[nodiscard]] const TaskFacts& facts_of(Task task);

/// 1 kg of clay, a ball of 10 mm, rings of `ring_height_mm`; pinches are permitted. A plate starts
/// from a flat lump, all others from one about as high as wide.
[[nodiscard]] SceneSpec hands_scene(Task task, const std::optional<ClaySpec>& clay,
                                    double ring_height_mm = 0.335063);

struct PlayedTick {
  Pose pose;
  bool in_contact = false;
};

struct ThrownPot {
  ClayStack stack;
  PotMeasures measures;
  double wheel_s = 0.0;  ///< session time
  WideQuanta volume_error = 0;
  std::vector<PlayedTick> ticks;
};

/// Throws a whole pot from the lump.
[[nodiscard]] ThrownPot throw_pot(Task task, const SceneSpec& scene, std::uint64_t seed);

/// Mean CPU time [us] of the ticks in contact, as the pot is thrown again. NaN without contact.
[[nodiscard]] double contact_tick_us(const SceneSpec& scene, const std::vector<PlayedTick>& ticks);

}  // namespace clay::bench
