// The arm or controller at the potter's: it takes the clay, and goes.

#include "app/studio/stroke_controller.hpp"
#include "claystack/servo/servo.hpp"

namespace clay::studio {
namespace {

/// As stiff as the device can render at this rate, and no stiffer than the scene. What becomes of
/// the clay does not depend on it.
Result<SceneSpec> softened(SceneSpec scene, const servo::LiveSettings& settings) {
  return servo::soften(scene, settings).map([&](double) { return scene; });
}

}  // namespace

void StrokeController::take(std::unique_ptr<falcon::HapticDevice> device,
                            servo::LiveSettings settings) {
  release();
  device_ = std::move(device);
  device_settings_ = settings;
  device_waits_ = true;
}

/// The force went with it; the mouse takes over.
void StrokeController::lose_device() {
  news_.error = Error{ErrorKind::device, falcon::text_of(device_->problem())};
  news_.device_lost = true;
  device_.reset();
}

void StrokeController::hold(const ToolSpec& tool, double rate_per_s) {
  if (!device_ || !work_ || (tool == scene_.tool && rate_per_s == scene_.removal.rate_per_s))
    return;
  release();
  scene_.tool = tool;
  scene_.removal.rate_per_s = rate_per_s;
}

/// A servo that has ended has told the device to give no force until it is opened again.
void StrokeController::sit_with_device() {
  device_waits_ = false;
  auto opened = device_->open();
  if (!opened) return lose_device();
  const SceneSpec wanted = scene_;
  auto begun =
      (device_->info().can_push ? softened(scene_, device_settings_) : Result<SceneSpec>(scene_))
          .and_then(
              [&](const SceneSpec& scene) { return sit_down(scene, *device_, device_settings_); });
  scene_ = wanted;
  if (!begun) news_.error = begun.error();
}

}  // namespace clay::studio
