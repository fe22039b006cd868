#include "app/servo/scene_hand.hpp"

#include "app/servo/controls.hpp"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>

namespace clay::servo {
namespace {

constexpr double kSPerUs = 1e-6;
constexpr double kHandStiffness = 200.0, kHandDamping = 0.3;  // N/mm, N s/mm

struct Place {
  double time_s;
  glm::dvec3 device_mm;
};

struct Hold {
  double time_s;
  falcon::Fingers fingers;
};

double time_of(const Pose& pose) {
  return kHandLeadS + kSPerUs * static_cast<double>(pose.time_us);
}

glm::dvec3 place_at(const std::vector<Place>& places, double time_s) {
  const auto later = std::ranges::upper_bound(places, time_s, {}, &Place::time_s);
  if (later == places.begin()) return places.front().device_mm;
  if (later == places.end()) return places.back().device_mm;
  const Place& before = *(later - 1);
  const double part = (time_s - before.time_s) / (later->time_s - before.time_s);
  return glm::mix(before.device_mm, later->device_mm, part);
}

}  // namespace

falcon::HandPath hand_path(const std::vector<Pose>& poses, const Mapping& mapping) {
  if (poses.empty()) return falcon::idle_circle_mm;
  auto places = std::make_shared<std::vector<Place>>();
  places->reserve(poses.size());
  for (const Pose& pose : poses)
    places->push_back({time_of(pose), mapping.to_device(pose.position_mm)});
  return [places = std::shared_ptr<const std::vector<Place>>(std::move(places))](double time_s) {
    return place_at(*places, time_s);
  };
}

falcon::HandFingers hand_fingers(const std::vector<Pose>& poses) {
  if (poses.empty()) return {};
  // Only when it changes.
  auto holds = std::make_shared<std::vector<Hold>>();
  for (const Pose& pose : poses) {
    const falcon::Fingers fingers{static_cast<std::uint8_t>(pose.trim ? kFalconButtons.trim : 0u),
                                  pose.gap_mm};
    if (holds->empty() || holds->back().fingers != fingers)
      holds->push_back({time_of(pose), fingers});
  }
  return [holds = std::shared_ptr<const std::vector<Hold>>(std::move(holds))](double time_s) {
    const auto later = std::ranges::upper_bound(*holds, time_s, {}, &Hold::time_s);
    return later == holds->begin() ? falcon::Fingers{} : (later - 1)->fingers;
  };
}

MappingSettings fitted(MappingSettings settings, const std::vector<Pose>& poses, double reach_mm) {
  if (poses.empty()) return settings;
  glm::dvec3 low = poses.front().position_mm, high = low;
  for (const Pose& pose : poses) {
    low = glm::min(low, pose.position_mm);
    high = glm::max(high, pose.position_mm);
  }
  const glm::dvec3 middle(std::max(0.0, 0.5 * (low.x + high.x)), 0.5 * (low.y + high.y), 0.0);
  double farthest_mm = 0.0;
  for (const Pose& pose : poses)
    farthest_mm = std::max(farthest_mm, glm::distance(middle, pose.position_mm));
  settings.side = Side::right;
  settings.reach_mm = middle.x;
  settings.height_mm = middle.y;
  settings.scale = std::max(settings.scale, farthest_mm / reach_mm);
  return settings;
}

double seconds_of(const std::vector<Pose>& poses) noexcept {
  return poses.empty() ? 0.0 : time_of(poses.back());
}

falcon::SimulatedSettings simulated_potter(const std::vector<Pose>& poses, const Mapping& mapping) {
  falcon::SimulatedSettings settings = falcon::simulated_and_loaded();
  settings.path = hand_path(poses, mapping);
  settings.fingers = hand_fingers(poses);
  settings.hand.stiffness_n_per_mm = glm::dvec3(kHandStiffness);
  settings.hand.damping_ns_per_mm = glm::dvec3(kHandDamping);
  return settings;
}

}  // namespace clay::servo
