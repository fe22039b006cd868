#pragma once
// The least ball of one face, or of all pairs of them.

#include "tangent_ball.hpp"

namespace clay::solid {

class WallSearch {
 public:
  explicit WallSearch(const EdgeTree& tree) : tree_(tree) {}

  [[nodiscard]] double bound(const EdgeNode& a, const EdgeNode& b) const;
  [[nodiscard]] double best() const { return least_.diameter; }
  void leaves(const EdgeNode& a, const EdgeNode& b);

  /// Against every other face of its piece; `sample` may be a part of the face it is a sample of.
  void from(const Face& sample);
  /// Against the axis: of one face, or of all faces of the piece.
  void across(const AxisClay& axis, const Face& sample) { offer(axis.least_ball(sample)); }
  void across(const AxisClay& axis, std::uint32_t piece, std::size_t node = 0);
  [[nodiscard]] const Ball& least() const { return least_; }

 private:
  void offer(const Ball& ball) {
    if (ball.diameter < least_.diameter) least_ = ball;
  }
  void compare(const Face& a, const Face& b);

  const EdgeTree& tree_;
  const Face* sample_ = nullptr;
  Ball least_;
};

}  // namespace clay::solid
