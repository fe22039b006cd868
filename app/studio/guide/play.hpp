#pragma once
// Plays the guide's strokes on the wheel, as the mouse would, more slowly than an experienced hand.

#include <cstddef>

namespace clay::studio {

struct AppState;

class Play {
 public:
  /// Once a frame, if a lesson is open.
  void advance(AppState& state);

 private:
  double time_s_ = 0.0;        // along the path of the stroke in progress
  double last_s_ = 0.0;        // of the previous frame, on the host's clock
  double rest_until_s_ = 0.0;  // time to read the step, before a stroke
  bool playing_ = false;
  std::size_t read_plan_ = 0;  // number of the plan that is being read
};

}  // namespace clay::studio
