#pragma once
// A FalconDevice connected to a model whose grip moves as the test requires.

#include "falcon/device/falcon_device.hpp"
#include "falcon/sim/falcon_model.hpp"
#include "falcon/sim/loopback_transport.hpp"
#include "tests/falcon/device/dummy_firmware.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace clay::falcon {

inline constexpr std::int64_t kTickUs = 1'000;
// Within 40 mm of the centre, one encoder count is at most 67 um; each leg is off by half a count.
inline constexpr double kEncoderMm = 0.07;

/// The grip of the model at each frame [mm]: a circle of radius 20 mm about the centre, 1 turn/s.
inline glm::dvec3 on_circle(std::uint64_t frame) {
  const double turn = 2e-3 * 3.14159265358979 * static_cast<double>(frame);
  return kFalconCentreMm + 20.0 * glm::dvec3(std::cos(turn), std::sin(turn), 0.0);
}

/// A device with its model, on a simulated clock.
struct FalconBench {
  explicit FalconBench(FalconModelSettings model_settings = {}, FalconSettings settings = {})
      : model(std::make_shared<FalconModel>(
            std::move(model_settings),
            [this](const glm::dvec3&, double) { return grip(frame++); })) {
    auto transport = std::make_unique<LoopbackTransport>(model, SimClock::stepped);
    line = transport.get();
    device = std::make_unique<FalconDevice>(std::move(transport), settings);
  }

  DeviceSample tick(const glm::dvec3& force_n = {}) {
    device->write(force_n);
    return device->read(kTickUs);
  }

  std::uint64_t frame = 0;
  std::function<glm::dvec3(std::uint64_t)> grip = on_circle;
  std::shared_ptr<FalconModel> model;
  LoopbackTransport* line = nullptr;
  std::unique_ptr<FalconDevice> device;
};

inline FalconModelSettings ready_model() {
  FalconModelSettings settings;
  settings.loaded = settings.homed = true;
  return settings;
}

class FirmwareFile {
 public:
  FirmwareFile() {
    close(mkstemp(path_.data()));
    const auto bytes = dummy_firmware();
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<long>(bytes.size()));
  }
  ~FirmwareFile() { unlink(path_.c_str()); }
  FirmwareFile(const FirmwareFile&) = delete;
  FirmwareFile& operator=(const FirmwareFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  /// A template until mkstemp replaces it.
  std::string path_ = std::filesystem::temp_directory_path() / "firmware-XXXXXX";
};

}  // namespace clay::falcon
