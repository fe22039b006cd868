#include "claystack/falcon/usb.hpp"
#include "falcon/device/usb/held_signals.hpp"
#include "falcon/device/usb/usb_error.hpp"

#include <hidapi.h>
#include <libusb.h>
#include <unistd.h>

#include <algorithm>
#include <cwchar>
#include <memory>

namespace clay::falcon::inline device {
namespace {

constexpr const char* kNone = "connect one; a Falcon appears on USB even without its power supply";

tl::unexpected<DeviceError> usb_is_out(int code) {
  return device_failure(DeviceFault::transfer_failed,
                        std::string("USB: could not list devices: ") + libusb_strerror(code));
}

DeviceResult<void> list_falcons(std::vector<ListedDevice>& found) {
  libusb_context* context = nullptr;
  if (const int code = libusb_init(&context); code != 0) return usb_is_out(code);
  libusb_device** devices = nullptr;
  const auto count = libusb_get_device_list(context, &devices);
  for (ssize_t i = 0; i < count; ++i) {
    libusb_device_descriptor descriptor{};
    if (libusb_get_device_descriptor(devices[i], &descriptor) != 0) continue;
    if (descriptor.idVendor != kFalconVendor || descriptor.idProduct != kFalconProduct) continue;
    ListedDevice device{DeviceKind::falcon, "Novint Falcon", place_of(devices[i]), true, {}};
    if (auto access = check_usb_access(devices[i]); !access) {
      device.usable = access.error().fault == DeviceFault::driver_bound;
      device.problem = access.error();
    }
    found.push_back(std::move(device));
  }
  if (count >= 0) libusb_free_device_list(devices, 1);
  libusb_exit(context);
  if (count < 0) return usb_is_out(static_cast<int>(count));
  return {};
}

std::string narrow(const wchar_t* text) {
  std::string narrowed;
  for (; text && *text != 0; ++text) narrowed += *text < 128 ? static_cast<char>(*text) : '?';
  return narrowed;
}

// A device may have several HID interfaces: a receiver those of a keyboard, a bridge one for its
// log. hidapi's libusb backend does not distinguish them: their usage page is 0.

bool is_multi_axis(const hid_device_info& info) {
  constexpr int kGenericDesktop = 1, kMultiAxis = 8;
  return info.usage_page == 0 || (info.usage_page == kGenericDesktop && info.usage == kMultiAxis);
}

bool is_stream(const hid_device_info& info) {
  constexpr int kVendorDefined = 0xFF00;
  return info.usage_page == 0 || info.usage_page == kVendorDefined;
}

std::optional<ListedDevice> recognise(const hid_device_info& info) {
  const std::string product = narrow(info.product_string);
  if (product.starts_with(kBridgeProduct) && is_stream(info))
    return ListedDevice{DeviceKind::bridge, "Novint Falcon behind a bridge", info.path, true, {}};
  for (const SpaceMouseModel& model : space_mouse_models())
    if (model.vendor == info.vendor_id && model.product == info.product_id && is_multi_axis(info))
      return ListedDevice{DeviceKind::space_mouse, std::string(model.name), info.path, true, {}};
  return std::nullopt;
}

void list_hid(std::vector<ListedDevice>& found) {
  const HeldSignals held;
  const std::unique_ptr<hid_device_info, decltype(&hid_free_enumeration)> all(
      hid_enumerate(0, 0), &hid_free_enumeration);
  for (const hid_device_info* info = all.get(); info; info = info->next) {
    auto device = recognise(*info);
    const bool twice = device && std::any_of(found.begin(), found.end(), [&](const auto& other) {
                         return other.place == device->place;
                       });
    if (!device || twice) continue;
    // A /dev node has permissions; the names of hidapi's libusb backend are not nodes.
    if (device->place.front() == '/' && access(device->place.c_str(), R_OK | W_OK) != 0) {
      device->usable = false;
      device->problem = node_error(device->place);
    }
    found.push_back(std::move(*device));
  }
}

std::unique_ptr<HapticDevice> make_device(const ListedDevice& listed,
                                          const DeviceSettings& settings) {
  switch (listed.kind) {
    case DeviceKind::falcon:
      return make_falcon(make_ftdi_transport(listed.place), settings.falcon);
    case DeviceKind::bridge:
      return make_falcon(make_bridge_transport(listed.place), settings.falcon);
    case DeviceKind::space_mouse:
      return make_space_mouse(listed.name, listed.place, settings.space_mouse);
  }
  return nullptr;
}

}  // namespace

std::string_view name_of(DeviceKind kind) noexcept {
  switch (kind) {
    case DeviceKind::falcon:
      return "falcon";
    case DeviceKind::bridge:
      return "bridge";
    case DeviceKind::space_mouse:
      return "spacemouse";
  }
  return "unknown";
}

DeviceResult<std::vector<ListedDevice>> list_devices() {
  std::vector<ListedDevice> found;
  if (auto listed = list_falcons(found); !listed) return tl::make_unexpected(listed.error());
  list_hid(found);
  std::stable_sort(found.begin(), found.end(),
                   [](const ListedDevice& a, const ListedDevice& b) { return a.kind < b.kind; });
  return found;
}

DeviceResult<std::unique_ptr<HapticDevice>> open_device(std::string_view which,
                                                        const DeviceSettings& settings) {
  const auto found = list_devices();
  if (!found) return tl::make_unexpected(found.error());
  const auto fits = [which](const ListedDevice& device) {
    return which == "auto" || which == name_of(device.kind) || which == device.place;
  };
  const auto usable = [&fits](const ListedDevice& device) { return fits(device) && device.usable; };
  auto chosen = std::find_if(found->begin(), found->end(), usable);
  if (chosen == found->end()) chosen = std::find_if(found->begin(), found->end(), fits);
  if (chosen == found->end())
    return device_failure(DeviceFault::not_found,
                          which == "auto" ? std::string("no device is connected")
                                          : std::string(which) + ": no such device is connected",
                          kNone);
  if (!chosen->usable) return tl::make_unexpected(*chosen->problem);
  auto device = make_device(*chosen, settings);
  if (auto opened = device->open(); !opened) return tl::make_unexpected(opened.error());
  return device;
}

}  // namespace clay::falcon::inline device
