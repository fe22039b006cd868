// list_devices: lists the connected devices, with a remedy for those that cannot be opened.
#include <claystack/falcon/usb.hpp>

#include <cstdio>

int main() {
  const auto devices = clay::falcon::list_devices();
  if (!devices) {
    std::fprintf(stderr, "%s\n", devices.error().message.c_str());
    return 4;
  }
  if (devices->empty()) std::puts("no device is connected");
  for (const auto& device : *devices) {
    std::printf("%s at %s\n", device.name.c_str(), device.place.c_str());
    if (device.problem) std::printf("  %s\n", device.problem->message.c_str());
  }
  return 0;
}
