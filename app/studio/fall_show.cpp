#include "app/studio/fall_show.hpp"

#include "app/render/pot_view.hpp"

#include <algorithm>
#include <cmath>

namespace clay::studio {
namespace {

/// Lower bound of the part of the lost energy that is motion, so that the first frames take a
/// finite time.
constexpr double kLeastMoving = 1e-3;

/// Frames are equally spaced. The duration of each is inversely proportional to the speed, the
/// square root of the kinetic energy gained before it.
std::vector<double> times_of(const std::vector<FallFrame>& frames) {
  const double lost_mj = frames.front().potential_mj - frames.back().potential_mj;
  std::vector<double> times(frames.size(), 0.0);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const double moving_mj =
        frames.front().potential_mj - frames[i].potential_mj - frames[i].plastic_mj;
    const double part = lost_mj > 0.0 ? moving_mj / lost_mj : 1.0;
    times[i] = times[i - 1] + 1.0 / std::sqrt(std::max(part, kLeastMoving));
  }
  for (double& time : times) time *= kFallS / times.back();
  return times;
}

}  // namespace

const char* fall_reason(const Collapse& fall) noexcept {
  return fall.parted() ? "the tool cut the wall" : "the clay could not carry its own weight";
}

void FallShow::begin(history::SharedPot pot, double now_s) {
  frames_ = fall_frames(*pot);
  if (frames_.size() < 2) return end();
  pot_ = std::move(pot);
  times_s_ = times_of(frames_);
  begun_s_ = now_s;
}

std::optional<render::FallenView> FallShow::at(double now_s, const render::PotView& view) {
  if (!running()) return std::nullopt;
  const auto next = std::ranges::upper_bound(times_s_, now_s - begun_s_);
  if (next == times_s_.end()) {
    end();
    return std::nullopt;
  }
  const auto index = static_cast<std::size_t>(next - times_s_.begin());
  const FallFrame& frame = frames_[index == 0 ? 0 : index - 1];
  return render::fallen_view(*pot_->collapse, frame, view, pot_->stack);
}

}  // namespace clay::studio
