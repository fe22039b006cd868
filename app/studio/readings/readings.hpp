#pragma once
// Readings for the panels: computed in frames in which the clay has changed, and in the background
// if that takes long.

#include "app/studio/document.hpp"
#include "app/studio/readings/clay_figures.hpp"
#include "app/studio/readings/curves.hpp"
#include "app/studio/readings/pot_checker.hpp"
#include "app/studio/stroke_controller.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace clay::studio {

/// Data that the open panels need; the rest is not computed.
struct Wanted {
  bool check = false, ticks = false;
  std::string process;  ///< as in PotQuestion
  SharedTarget target = nullptr;
  double shrinkage = 0.0;
  friend bool operator==(const Wanted&, const Wanted&) = default;
};

class Readings {
 public:
  /// Without `background` checks run within `update`, so that scripts are reproducible.
  explicit Readings(bool background) : checker_(background) {}

  /// Call once a frame, with the time of the servo's clock. Checks of pots at rest are logged.
  void update(const Document& document, StrokeController& stroke, const Wanted& wanted,
              std::int64_t now_ns, const std::function<void(std::string_view)>& log);

  /// Null: no clay on the wheel.
  [[nodiscard]] const ClayStack* stack() const noexcept;
  [[nodiscard]] double widest_mm() const noexcept { return widest_mm_; }  ///< radius
  /// The largest diameter: that of the smoothed section, as the export states it, or, until that is
  /// known, that of the rings.
  [[nodiscard]] double diameter_mm() const noexcept;
  /// To the brim, likewise.
  [[nodiscard]] double capacity_mm3() const noexcept;
  [[nodiscard]] bool live() const noexcept { return subject_.live(); }
  [[nodiscard]] bool fallen() const noexcept { return subject_.pot && subject_.pot->collapse; }
  [[nodiscard]] const ClayAccount& account() const noexcept { return account_; }
  [[nodiscard]] const StressCurve& stress() const noexcept { return stress_; }
  [[nodiscard]] const TickHistory& ticks() const noexcept { return ticks_; }
  /// The newest check, of this clay or of an earlier state of it.
  [[nodiscard]] const std::optional<PotCheck>& check() const noexcept { return check_; }
  /// A check is running.
  [[nodiscard]] bool checking() const { return checker_.busy(); }
  /// Section of the current clay in `rows` rows.
  [[nodiscard]] const std::vector<SectionRow>& section(std::size_t rows) const;

 private:
  void read(const Document& document, const StrokeController& stroke);
  void ask(const Wanted& wanted, std::int64_t now_ns);

  Subject subject_;
  std::optional<ClayStack> outline_stack_;  // during a stroke
  double widest_mm_ = 0.0;
  ClayAccount account_, resting_account_;
  StressCurve stress_;
  TickHistory ticks_;
  std::optional<PotCheck> check_;
  std::optional<Wanted> asked_;  // of the last check
  std::int64_t asked_ns_ = 0;
  bool changed_ = false;  // since the last check
  bool current_ = false;  // `check_` is of this clay
  mutable std::vector<SectionRow> section_;
  mutable std::size_t section_size_ = 0;
  PotChecker checker_;
};

}  // namespace clay::studio
