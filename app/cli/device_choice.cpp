#include "app/cli/device_choice.hpp"

#include "app/cli/console.hpp"
#include "app/cli/usage.hpp"

#ifdef CLAYSTACK_USB
#include "claystack/falcon/usb.hpp"
#endif

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <utility>

namespace clay::cli {
namespace {

using DevicePointer = std::unique_ptr<falcon::HapticDevice>;

falcon::DeviceResult<DevicePointer> open_simulated(const falcon::SimulatedSettings& settings) {
  auto simulated = falcon::make_simulated_falcon(settings);
  if (!simulated) return tl::make_unexpected(simulated.error());
  if (auto opened = simulated->device->open(); !opened) return tl::make_unexpected(opened.error());
  return std::move(simulated->device);
}

}  // namespace

std::string check_device_name(const std::string& which) {
  for (const char* name : kDeviceNames)
    if (which == name) return {};
  if (which.starts_with("usb:") || which.starts_with("/dev/")) return {};
  return fmt::format("expected {}, usb:BUS-PORT or /dev/hidrawN, found {}",
                     fmt::join(kDeviceNames, ", "), which);
}

void add_falcon_options(CLI::App& command, falcon::FalconSettings& settings) {
  add_file(command, "--firmware", settings.firmware_path,
           "File with the Falcon's firmware, from its driver")
      ->envname("CLAYSTACK_FALCON_FIRMWARE");
  command
      .add_option_function<std::string>(
          "--geometry",
          [&settings](const std::string& name) {
            settings.geometry = name == "libnifalcon" ? falcon::kLibnifalconGeometry
                                                      : falcon::kMartinHillierGeometry;
          },
          "Dimensions of the Falcon's arms: libnifalcon or martin-hillier")
      ->check(one_of({"libnifalcon", "martin-hillier"}))
      ->default_str("libnifalcon");
  command
      .add_option(
          "--motor-counts", settings.motor_counts_per_nmm,
          "Motor counts of a Falcon per 1 N mm at an arm; a larger number gives a larger force")
      ->check(in_range(1e-3, 1e3))
      ->capture_default_str();
}

falcon::DeviceResult<DevicePointer> open_chosen(const std::string& which,
                                                const falcon::FalconSettings& settings,
                                                const falcon::SimulatedSettings& simulated) {
  if (which == "simulated") return open_simulated(simulated);
#ifdef CLAYSTACK_USB
  return falcon::open_device(which, {.falcon = settings, .space_mouse = {}});
#else
  (void)settings;
  return falcon::device_failure(
      falcon::DeviceFault::bad_setting,
      which + ": expected simulated, since this program was built without USB devices");
#endif
}

}  // namespace clay::cli
