#include "live/scene_hand.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <memory>

namespace clay::live {
namespace {

constexpr double kSPerUs = 1e-6;
constexpr double kHandStiffness = 2000.0, kHandDamping = 40.0;  // N/m, N s/m

struct Place {
  double time_s;
  glm::dvec3 device_mm;
};

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
    places->push_back({kHandLeadS + kSPerUs * static_cast<double>(pose.time_us),
                       mapping.to_device(pose.position_mm)});
  return [places = std::shared_ptr<const std::vector<Place>>(std::move(places))](double time_s) {
    return place_at(*places, time_s);
  };
}

double seconds_of(const std::vector<Pose>& poses) noexcept {
  return poses.empty() ? 0.0 : kHandLeadS + kSPerUs * static_cast<double>(poses.back().time_us);
}

falcon::SimulatedSettings simulated_potter(const std::vector<Pose>& poses, const Mapping& mapping) {
  falcon::SimulatedSettings settings = falcon::simulated_and_loaded();
  settings.path = hand_path(poses, mapping);
  settings.hand.stiffness_n_per_m = glm::dvec3(kHandStiffness);
  settings.hand.damping_ns_per_m = glm::dvec3(kHandDamping);
  return settings;
}

}  // namespace clay::live
