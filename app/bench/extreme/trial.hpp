#pragma once
#include "app/bench/extreme/suite.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <string>

namespace clay::extreme {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// 60 solid rings of 1 mm height and 30 mm radius, a sphere of 8 mm, kernel of 12 mm.
SceneSpec small_pot();

/// Plays one subject tick by tick. After every tick 0 <= r < R must hold, radii and force must be
/// finite, and no loop endless or formula undefined; at the end no clay may be lost. Stores the
/// first failure.
class Trial {
 public:
  Trial(Model model, const SceneSpec& scene);

  /// The scene was refused; `why` holds the engine's message.
  [[nodiscard]] bool refused() const { return !subject_; }
  [[nodiscard]] const std::string& why() const { return why_; }

  Subject& subject() { return *subject_; }
  [[nodiscard]] bool has_no_fault() const { return fault_.empty(); }

  /// Gap of all following poses; 0: one tool.
  void pinch(double gap_mm) { gap_mm_ = gap_mm; }
  /// One tick, `dt_us` after the last one.
  Tick at(const glm::dvec3& hip_mm, bool trim = false, std::int64_t dt_us = 1000);
  /// `ticks` ticks on the straight line between two points, both included.
  void stroke(const glm::dvec3& from_mm, const glm::dvec3& to_mm, int ticks, bool trim = false);

  /// Stores `failure` unless the condition holds.
  void require(bool holds, const std::string& failure);
  /// Checks the volume now, exactly; also done at the end.
  void weigh();
  /// The verdict. `extra` is appended to the note.
  Outcome done(const std::string& extra = {});

  [[nodiscard]] bool touched() const { return touched_; }
  [[nodiscard]] double largest_force_n() const { return largest_force_n_; }
  [[nodiscard]] const Tick& last() const { return last_; }

 private:
  void check_tick();

  std::unique_ptr<Subject> subject_;
  std::string why_, fault_;
  Exact before_ = 0;
  Tick last_;
  std::int64_t time_us_ = 0;
  std::size_t ticks_ = 0;
  bool touched_ = false, exact_;
  double largest_force_n_ = 0.0, gap_mm_ = 0.0;
};

/// Passes if the scene is refused; otherwise plays a stroke and judges it.
Outcome refused_or_sound(Model model, const SceneSpec& scene, const glm::dvec3& from_mm,
                         const glm::dvec3& to_mm, int ticks);

}  // namespace clay::extreme
