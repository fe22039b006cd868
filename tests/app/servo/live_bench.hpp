#pragma once
// A live throw on a virtual clock, which only the device's answers advance.

#include "app/servo/scene_hand.hpp"
#include "app/servo/servo_loop.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/falcon/falcon_device.hpp"
#include "falcon/sim/falcon_model.hpp"
#include "falcon/sim/loopback_transport.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace clay::servo {

/// The clock of a LoopbackTransport in virtual time. Sleeping does nothing, because reading waits.
class LineClock final : public Clock {
 public:
  explicit LineClock(const falcon::Transport& line) : line_(line) {}
  std::int64_t now_ns() noexcept override {
    if (on_reading) on_reading();
    return 1000 * line_.now_us();
  }
  void sleep_until_ns(std::int64_t) noexcept override {}

  std::function<void()> on_reading;  ///< happens just before a reading

 private:
  const falcon::Transport& line_;
};

inline SceneSpec sample_scene(const std::string& name) {
  const std::string path =
      std::string(CLAYSTACK_SAMPLES).append("/paper/").append(name).append(".scene.json");
  return parse_scene(read_file(path).value(), path).value();
}

inline std::vector<Pose> sample_stroke(const std::string& name) {
  const std::string path =
      std::string(CLAYSTACK_SAMPLES).append("/paper/").append(name).append(".session");
  return parse_session(read_file(path).value(), path).value().poses;
}

/// The hand in the device's frame [mm], at a time [s] since the first frame.
using HandAt = std::function<glm::dvec3(double)>;

struct VirtualThrow {
  static falcon::FalconModelSettings homed() {
    falcon::FalconModelSettings settings;
    settings.loaded = settings.homed = true;
    return settings;
  }

  /// The force does not move the hand, so a test knows its position.
  VirtualThrow(const SceneSpec& scene, LiveSettings live_settings, HandAt hand_at,
               Recorder* recorder = nullptr,
               const falcon::FalconModelSettings& model_settings = homed())
      : settings(std::move(live_settings)),
        hand(std::move(hand_at)),
        wheel(Wheel::build(scene).value()),
        model(std::make_shared<falcon::FalconModel>(model_settings,
                                                    [this](const glm::dvec3&, double dt_s) {
                                                      time_s += dt_s;
                                                      return falcon::kFalconCentreMm + hand(time_s);
                                                    })),
        falcon_device(falcon::make_falcon(make_line(), {})),
        device(*falcon_device),
        clock(*line) {
    EXPECT_TRUE(device.open());
    auto built = ServoLoop::build({wheel, device, clock, recorder, &trace}, settings);
    EXPECT_TRUE(built) << built.error().message;
    loop = std::make_unique<ServoLoop>(std::move(*built));
    loop->start();
  }

  Ending tick() { return loop->tick(gate, commands, view, heartbeat_us); }
  /// Ticks for `seconds`, or until the throw ends.
  Ending run(double seconds) {
    const std::int64_t end_us = clock.now_us() + static_cast<std::int64_t>(1e6 * seconds);
    Ending ending = Ending::none;
    while (ending == Ending::none && clock.now_us() < end_us) ending = tick();
    return ending;
  }
  [[nodiscard]] const LiveStatus& status() const { return loop->status(); }
  void fault(falcon::WireFault what, int times = 1) {
    for (int i = 0; i < times; ++i) model->plan({what, 0});
  }

  LiveSettings settings;
  HandAt hand;
  double time_s = 0.0;
  Wheel wheel;
  std::shared_ptr<falcon::FalconModel> model;
  falcon::LoopbackTransport* line = nullptr;
  std::unique_ptr<falcon::HapticDevice> falcon_device;
  falcon::HapticDevice& device;
  LineClock clock;
  std::unique_ptr<ServoLoop> loop;
  falcon::ForceGate gate;
  Commands commands;
  LiveView view;
  TickTrace trace;
  std::atomic<std::int64_t> heartbeat_us{0};

 private:
  std::unique_ptr<falcon::Transport> make_line() {
    auto made = std::make_unique<falcon::LoopbackTransport>(model, falcon::SimClock::stepped);
    line = made.get();
    return made;
  }
};

/// A solid lump of 40 mm radius and a rib 20 mm high; the tool touches the lump at 46 mm from the
/// axis. The clay yields slowly, so a resting hand meets a force for seconds.
inline SceneSpec rib_scene() {
  SceneSpec scene;
  scene.lump = {.rings = 120, .ring_height_mm = 0.5, .outer_radius_mm = 40.0};
  scene.tool.shape = RibSpec{20.0, 6.0};
  scene.removal.rate_per_s = 0.02;
  scene.force->stiffness_n_per_mm2 = 0.02;
  scene.force->friction = 0.2;
  return scene;
}

inline LiveSettings one_to_one() {
  LiveSettings settings;
  settings.mapping.scale = 1.0;
  settings.mapping.reach_mm = 46.0;
  settings.mapping.height_mm = 30.0;
  return settings;
}

/// Off the clay until the force has ramped up, then pressed to a depth [mm] in 0.5 s.
inline HandAt press_to(double depth_mm) {
  return [=](double t) {
    const double part = std::clamp((t - 2.5) / 0.5, 0.0, 1.0);
    return glm::dvec3(2.0 - part * (2.0 + depth_mm), 0.0, 0.0);
  };
}

}  // namespace clay::servo
