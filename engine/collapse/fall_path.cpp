#include "engine/collapse/fall_path.hpp"

#include "claystack/engine/clay.hpp"
#include "core/portable_trig.hpp"
#include "engine/collapse/fallen_body.hpp"
#include "engine/collapse/yield_power.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace clay {
namespace {

constexpr double kStepsPerReach = 400.0;
// Part of a step: the depth by which a face may enter the clay it meets.
constexpr double kLeastStep = 1e-4;
constexpr std::size_t kMaxFrames = 20000;  // far above the number that any collapse has needed

double weight_of(const FallenBody& body, double density_g_cm3) noexcept {
  return 1e-6 * density_g_cm3 * body.volume_mm3() * kStandardGravity;
}

/// A screw motion in the plane: a twist applied for some time.
struct Course {
  glm::dvec2 velocity{0.0};
  double omega = 0.0;

  [[nodiscard]] Twist twist(double gyration_mm) const noexcept {
    return {velocity.x, velocity.y, omega * gyration_mm};
  }
};

glm::dvec2 turned(glm::dvec2 v, double angle) noexcept {
  const auto [c, s] = cos_sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

class Fall {
 public:
  Fall(const ClayStack& stack, double density_g_cm3, std::size_t failed_ring,
       const FallPlane& plane, double threshold_kpa)
      : body_(stack, failed_ring),
        weight_n_(weight_of(body_, density_g_cm3)),
        power_(stack, failed_ring, body_, weight_n_, threshold_kpa),
        plane_(plane),
        pose_{{0.0, body_.centre_height_mm()}, 0.0},
        step_(body_.reach_mm() / kStepsPerReach) {}

  std::vector<FallFrame> run() {
    if (body_.empty()) return {FallFrame{}};
    add_frame();
    turn_about_hip();
    settle_freely();
    roll();
    return std::move(frames_);
  }

 private:
  /// The pose after some time on a course, and the course as seen from there.
  struct Arrival {
    PlanePose pose;
    Course course;
  };

  [[nodiscard]] Arrival arrival(const Course& course, double time) const noexcept {
    const double turn = course.omega * time;
    // Along the chord: sin(turn)/turn and (1 - cos(turn))/turn.
    const double half = 0.5 * turn;
    const double chord =
        std::abs(half) > 1e-4 ? cos_sin(half).sine / half : 1.0 - half * half / 6.0;
    Arrival result{pose_, {turned(course.velocity, turn), course.omega}};
    result.pose.centre_mm += chord * time * turned(course.velocity, half);
    result.pose.angle_rad += turn;
    return result;
  }

  [[nodiscard]] double height(const PlanePose& pose) const noexcept {
    return pose.centre_mm.y + body_.lowest(pose.angle_rad).y;
  }

  double net_after(const Course& course, double time) {
    const Arrival there = arrival(course, time);
    power_.place(there.pose);
    return power_.net(there.course.twist(body_.gyration_mm()));
  }

  /// One step along a course of positive net power: up to `time`, to the wheel, or to where it
  /// gains no more power. Returns false at the wheel.
  bool advance(const Course& course, double time) {
    bool free = true;
    if (height(arrival(course, time).pose) < 0.0) {
      free = false;
      double low = 0.0, high = time;
      while (high - low > 1e-12 * time) {
        const double middle = 0.5 * (low + high);
        (height(arrival(course, middle).pose) < 0.0 ? high : low) = middle;
      }
      time = low;
    }
    if (net_after(course, time) < 0.0) {
      double low = 0.0, high = time;
      while (high - low > kLeastStep * time) {
        const double middle = 0.5 * (low + high);
        (net_after(course, middle) < 0.0 ? high : low) = middle;
      }
      free = free || high < time;
      time = high;
    }
    commit(course, time);
    return free;
  }

  void commit(const Course& course, double time) {
    const Arrival there = arrival(course, time);
    move_to(there.pose, course.twist(body_.gyration_mm()), there.course.twist(body_.gyration_mm()),
            time);
  }

  /// Ends the step where no more power is gained: a face that lands there has cost no power before.
  void move_to(const PlanePose& pose, const Twist& setting_off, const Twist& arriving,
               double time) {
    power_.place(pose_);
    const double before = power_.plastic(setting_off);
    power_.place(pose);
    const double after = power_.plastic(arriving);
    const double fallen_mm = pose_.centre_mm.y - pose.centre_mm.y;
    plastic_mj_ += weight_n_ * std::min(0.5 * time * (before + after), fallen_mm);
    pose_ = pose;
    add_frame();
  }

  [[nodiscard]] double fastest(const Course& course) const noexcept {
    return glm::length(course.velocity) + std::abs(course.omega) * body_.reach_mm();
  }

  /// Rotates toward the axis, where the centre of mass is.
  void turn_about_hip() {
    const glm::dvec2 pivot = plane_.pivot_mm;
    while (!out_of_frames()) {
      const glm::dvec2 arm = pose_.centre_mm - pivot;
      const Course course{{-arm.y, arm.x}, 1.0};
      power_.place(pose_);
      if (!(power_.net(course.twist(body_.gyration_mm())) > 0.0)) return;
      if (!advance(course, step_ / fastest(course))) {
        on_wheel_ = true;
        return;
      }
    }
  }

  void settle_freely() {
    while (!on_wheel_ && !out_of_frames()) {
      power_.place(pose_);
      const Twist u = power_.steepest();
      if (u == Twist{0.0}) return;
      const Course course{{u.x, u.y}, u.z / body_.gyration_mm()};
      on_wheel_ = !advance(course, step_ / fastest(course));
    }
  }

  /// The part sticks to the wheel where it touches: it may only roll.
  void roll() {
    if (!on_wheel_) return;
    pose_.centre_mm.y = -body_.lowest(pose_.angle_rad).y;
    while (!out_of_frames() && (roll_step(1.0) || roll_step(-1.0))) continue;
  }

  /// Rotates about the contact that remains: the one that a slightly larger angle would make the
  /// only one.
  [[nodiscard]] Course rolling(const PlanePose& pose, double sense) const noexcept {
    constexpr double kAhead = 1e-10;
    const glm::dvec2 contact = body_.lowest(pose.angle_rad + sense * kAhead);
    return {{-sense * pose.centre_mm.y, -sense * contact.x}, sense};
  }

  [[nodiscard]] PlanePose rolled(double turn) const noexcept {
    PlanePose pose = pose_;
    pose.angle_rad += turn;
    pose.centre_mm.y = -body_.lowest(pose.angle_rad).y;
    pose.centre_mm.x -= 0.5 * turn * (pose_.centre_mm.y + pose.centre_mm.y);
    return pose;
  }

  double rolling_net(const PlanePose& pose, double sense) {
    power_.place(pose);
    return power_.net(rolling(pose, sense).twist(body_.gyration_mm()));
  }

  bool roll_step(double sense) {
    const Twist setting_off = rolling(pose_, sense).twist(body_.gyration_mm());
    power_.place(pose_);
    if (!(power_.net(setting_off) > YieldPower::kRest * glm::length(setting_off))) return false;
    double turn = 1.0 / kStepsPerReach;
    if (rolling_net(rolled(sense * turn), sense) < 0.0) {
      double low = 0.0, high = turn;
      while (high - low > 1e-9 * turn) {
        const double middle = 0.5 * (low + high);
        (rolling_net(rolled(sense * middle), sense) < 0.0 ? high : low) = middle;
      }
      turn = high;
    }
    const PlanePose there = rolled(sense * turn);
    move_to(there, setting_off, rolling(there, sense).twist(body_.gyration_mm()), turn);
    return true;
  }

  [[nodiscard]] bool out_of_frames() const noexcept { return frames_.size() >= kMaxFrames; }

  void add_frame() {
    const glm::dvec2 arm = glm::dvec2{0.0, body_.centre_height_mm()} - plane_.pivot_mm;
    const glm::dvec2 shift = pose_.centre_mm - plane_.pivot_mm - turned(arm, pose_.angle_rad);
    frames_.push_back({pose_.angle_rad,
                       {shift.x * plane_.outward.x, shift.y, shift.x * plane_.outward.z},
                       weight_n_ * pose_.centre_mm.y,
                       plastic_mj_});
  }

  FallenBody body_;
  double weight_n_;
  YieldPower power_;
  FallPlane plane_;
  PlanePose pose_;
  double step_;
  bool on_wheel_ = false;
  double plastic_mj_ = 0.0;
  std::vector<FallFrame> frames_;
};

}  // namespace

FallPlane::FallPlane(const glm::dvec3& hip_mm) noexcept
    : pivot_mm(length_of(hip_mm.x, hip_mm.z), hip_mm.y) {
  if (pivot_mm.x > 0.0) outward = {hip_mm.x / pivot_mm.x, 0.0, hip_mm.z / pivot_mm.x};
}

std::vector<FallFrame> fall_path(const ClayStack& stack, double density_g_cm3,
                                 std::size_t failed_ring, const FallPlane& plane,
                                 double threshold_kpa) {
  return Fall(stack, density_g_cm3, failed_ring, plane, threshold_kpa).run();
}

}  // namespace clay
