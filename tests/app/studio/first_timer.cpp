#include "tests/app/studio/first_timer.hpp"

#include "app/studio/app_state.hpp"
#include "app/studio/readings/clay_figures.hpp"
#include "tests/app/studio/timed_host.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace clay::test {
namespace {

using namespace clay::studio;

constexpr double kFarMm = 6.0;  // the tool is seen to be behind
constexpr double kEventS = kFrameS, kReactionS = 0.4, kCorrelationS = 0.1;

/// A first-order autoregressive deviation of the hand.
class Shake {
 public:
  Shake(std::uint64_t seed, double noise_mm) : random_(seed), noise_mm_(noise_mm) {}
  glm::dvec2 next() {
    const double keep = std::exp(-kEventS / kCorrelationS);
    const double add = noise_mm_ * std::sqrt(1.0 - keep * keep);
    at_ = keep * at_ + add * glm::dvec2(normal_(random_), normal_(random_));
    return at_;
  }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double noise_mm_;
  glm::dvec2 at_{0.0};
};

glm::dvec2 along(const std::vector<PathPoint>& path, double way_mm) {
  for (std::size_t k = 1; k < path.size(); ++k) {
    const double piece = glm::length(path[k].at_mm - path[k - 1].at_mm);
    if (way_mm <= piece && piece > 0.0)
      return path[k - 1].at_mm + way_mm / piece * (path[k].at_mm - path[k - 1].at_mm);
    way_mm -= piece;
  }
  return path.back().at_mm;
}

double length_mm(const std::vector<PathPoint>& path) {
  double sum = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k)
    sum += glm::length(path[k].at_mm - path[k - 1].at_mm);
  return sum;
}

class Newcomer {
 public:
  Newcomer(AppState& state, TimedHost& host, std::uint64_t seed, double noise_mm)
      : state_(state), host_(host), shake_(seed, noise_mm) {}

  /// One stroke along the path that the view shows.
  double stroke() {
    const std::vector<PathPoint> path = state_.guide.plan()->path;
    const double speed_mm_s = shake_.between(20.0, 45.0), all_mm = length_mm(path);
    point(path.front().at_mm);
    button(true);
    double pressed_s = 0.0;
    for (double way_mm = 0.0; way_mm < all_mm && state_.stroke.throwing(); frame()) {
      pressed_s += kEventS;
      // The hand waits until the tool on screen has caught up.
      if (pressed_s > kReactionS && state_.stroke.stretch_mm() < kFarMm)
        way_mm += speed_mm_s * kEventS;
      point(along(path, way_mm));
    }
    button(false);
    frame();
    return pressed_s;
  }
  void frame() {
    host_.advance();
    state_.readings.update(state_.document, state_.stroke, {false, false, {}}, host_.frame_ns(),
                           state_.log);
    update(state_);
  }

 private:
  void point(glm::dvec2 at_mm) {
    const auto at = state_.scene.pixel_of(at_mm + shake_.next());
    if (!at) return;
    Actions actions;
    pixel_ = *at;
    state_.scene.pointer_moved(view_model(state_), {pixel_}, actions);
    apply_all(state_, actions);
  }
  void button(bool down) {
    Actions actions;
    state_.scene.button(view_model(state_), {MouseButton::left, down, 0}, actions);
    apply_all(state_, actions);
  }

  AppState& state_;
  TimedHost& host_;
  Shake shake_;
  glm::vec2 pixel_{0.0f};
};

double capacity_ml(const Pot& pot) { return 1e-3 * account_of(pot).capacity_mm3; }

}  // namespace

FirstPot throw_first_pot(std::size_t sample, std::uint64_t seed, double noise_mm, double most_s) {
  TimedHost host;
  AppState state{host, Settings{}, [](std::string_view) {}};
  state.scene.place({{0.0f, 0.0f}, {1280.0f, 760.0f}});
  apply(state, BeginLesson{sample, false});
  Newcomer newcomer(state, host, seed, noise_mm);
  FirstPot first;
  while (first.stroke_s < most_s && !state.document.pot().collapse && !state.guide.finished()) {
    newcomer.frame();
    if (state.guide.plan() == nullptr) continue;
    first.stroke_s += std::max(0.5, newcomer.stroke());
    ++first.strokes;
    newcomer.frame();
  }
  const Pot& pot = state.document.pot();
  first.finished = state.guide.finished();
  first.fallen = pot.collapse.has_value();
  const PotCheck check = check_pot({{state.document.shared_pot(), state.document.view()}, "fdm"});
  first.pot = state.document.shared_pot();
  first.ready = check.ready() && !first.fallen;
  first.verdict = ready_text(check, LengthUnit::mm);
  first.thinnest_mm = check.thinnest_mm;
  first.height_mm = pot.stack.height_mm();
  first.capacity_ml = first.fallen ? 0.0 : capacity_ml(pot);
  if (const auto made = finished_pot(samples().at(sample))) {
    first.sample_height_mm = made->stack.height_mm();
    first.sample_capacity_ml = capacity_ml(*made);
  }
  return first;
}

}  // namespace clay::test
