#include "app/cli/commands.hpp"
#include "app/cli/device_choice.hpp"
#include "app/cli/device_monitor.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/live_throw.hpp"
#include "app/cli/usage.hpp"
#include "app/servo/words.hpp"
#include "claystack/falcon/usb.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

namespace clay::cli {
namespace {

struct DevicesOptions {
  std::string device;
  falcon::FalconSettings falcon;
  bool monitor = false;
  servo::MappingSettings mapping;
  double seconds = 0.0;  // 0: until interrupted
};

Json problem_json(const falcon::DeviceError& error) {
  return {{"fault", name_of(error.fault)}, {"what", error.what}, {"remedy", error.remedy}};
}

/// One device, and its answer when opened briefly.
struct Entry {
  falcon::ListedDevice listed;
  falcon::DeviceState state = falcon::DeviceState::closed;
};

Entry looked_at(falcon::ListedDevice listed, const falcon::DeviceSettings& settings) {
  Entry entry{std::move(listed), {}};
  if (!entry.listed.usable) return entry;
  const auto device = falcon::open_device(entry.listed.place, settings);
  if (device) {
    (*device)->write({});
    entry.state = (*device)->read(100'000).state;
  } else {
    entry.listed.usable = false;
    entry.listed.problem = device.error();
  }
  return entry;
}

Json entry_json(const Entry& entry) {
  const falcon::ListedDevice& device = entry.listed;
  Json json = {{"kind", name_of(device.kind)},  {"name", device.name},
               {"place", device.place},         {"usable", device.usable},
               {"state", name_of(entry.state)}, {"problem", nullptr}};
  if (device.problem) json["problem"] = problem_json(*device.problem);
  return json;
}

void print_entry(const Entry& entry, const Console& console) {
  const falcon::ListedDevice& device = entry.listed;
  const std::string state = device.usable ? words_of_name(name_of(entry.state)) : "cannot be used";
  console.print(
      fmt::format("{:<11}{:<16}{}: {}", name_of(device.kind), device.place, device.name, state));
  if (device.problem) console.print("  " + device.problem->message);
  if (entry.state == falcon::DeviceState::needs_homing)
    console.print(std::string("  ") + servo::kHomingAdvice);
}

/// The exit status of a command that ends with this error.
int report_device(const falcon::DeviceError& error) {
  return report(error, {{"problem", problem_json(error)}});
}

int list(const falcon::DeviceSettings& settings, const Console& console) {
  auto found = falcon::list_devices();
  if (!found) return report_device(found.error());
  Json json = {{"devices", Json::array()}};
  for (falcon::ListedDevice& device : *found) {
    const Entry entry = looked_at(std::move(device), settings);
    json["devices"].push_back(entry_json(entry));
    print_entry(entry, console);
  }
  if (found->empty())
    console.print("no device is connected; a Falcon is listed even without its power supply");
  if (console.json) print_json(json);
  return kDone;
}

int show(const DevicesOptions& options, const falcon::DeviceSettings& settings,
         const Console& console) {
  auto device = open_chosen(options.device.empty() ? "auto" : options.device, settings.falcon,
                            falcon::simulated_and_loaded());
  if (!device) return report_device(device.error());
  falcon::HapticDevice& open = **device;
  if (options.monitor) {
    const auto mapping = servo::Mapping::build(options.mapping);
    if (!mapping) return report(by_option(mapping.error()));
    const auto watched = watch(open, options.seconds, *mapping, console);
    return watched ? kDone : report_device(watched.error());
  }
  open.write({});
  const falcon::DeviceState state = open.read(100'000).state;
  const falcon::DeviceInfo& info = open.info();
  console.print(fmt::format("{} at {}: {}", info.name, info.place, words_of_name(name_of(state))));
  if (state == falcon::DeviceState::needs_homing) console.print(servo::kHomingAdvice);
  if (console.json)
    print_json({{"name", info.name},
                {"place", info.place},
                {"state", name_of(state)},
                {"can_push", info.can_push},
                {"force_limit_n", info.force_limit_n},
                {"half_workspace_mm", info.half_workspace_mm.x},
                {"rate_hz", info.rate_hz}});
  return kDone;
}

}  // namespace

void add_devices_command(CLI::App& app, Console& console, int& exit) {
  auto options = std::make_shared<DevicesOptions>();
  CLI::App* command = app.add_subcommand(
      "devices", "List connected devices, whether each can be used, and what to do if not");
  command
      ->add_option("device", options->device,
                   "Device to open: auto, falcon, bridge, spacemouse, simulated, or a place from "
                   "the list, such as usb:1-2 or /dev/hidraw0")
      ->type_name("DEVICE")
      ->check(check_device_name);
  add_falcon_options(*command, options->falcon);
  CLI::Option* const monitor = command->add_flag("--monitor", options->monitor,
                                                 "Show position and buttons until interrupted");
  command
      ->add_option("--seconds", options->seconds,
                   "Duration of the monitor [s] (default: until interrupted)")
      ->needs(monitor)
      ->check(in_range(1e-3, 1e6));
  add_place_options(*command, options->mapping);
  command->footer(
      "\nExamples:\n  claystack devices\n  claystack devices falcon --firmware FILE --monitor\n"
      "  claystack devices simulated --monitor --seconds 5\n\n"
      "Exit status: 0 done; 2 bad option or firmware file; 3 could not read that file; 4 could not "
      "open the device, or it failed.");
  command->callback([options, &console, &exit] {
    falcon::DeviceSettings settings;
    settings.falcon = options->falcon;
    const bool one = options->monitor || !options->device.empty();
    exit = one ? show(*options, settings, console) : list(settings, console);
  });
}

}  // namespace clay::cli
