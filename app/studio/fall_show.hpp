#pragma once
// A fall that is shown: the pot is fallen already, and the view follows.

#include "app/history/work.hpp"
#include "app/render/picture.hpp"
#include "claystack/engine/collapse.hpp"

#include <optional>
#include <vector>

namespace clay::studio {

/// As long as it takes to see it; a real one is over in a fifth of that.
inline constexpr double kFallS = 1.2;

class FallShow {
 public:
  /// Of a pot that has collapsed. One whose fall is not known is not shown.
  void begin(history::SharedPot pot, double now_s);
  void end() noexcept { frames_.clear(); }
  [[nodiscard]] bool running() const noexcept { return !frames_.empty(); }
  /// Where the part that falls is now, in proportion to its real pace: it gains speed as it loses
  /// height. Nothing once it lies.
  [[nodiscard]] std::optional<render::FallenView> at(double now_s, const render::PotView& view);

 private:
  history::SharedPot pot_;
  std::vector<FallFrame> frames_;
  std::vector<double> times_s_;  // of the frames, from the first
  double begun_s_ = 0.0;
};

}  // namespace clay::studio
