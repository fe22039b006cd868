#include "tests/falcon/device/usb/fake_usb.hpp"

#include <hidapi.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace clay::falcon {

FakeHid& fake_hid() {
  static FakeHid hid;
  return hid;
}

}  // namespace clay::falcon

using clay::falcon::fake_hid;

struct hid_device_ {};

extern "C" {

hid_device_info* hid_enumerate(unsigned short, unsigned short) {
  hid_device_info* first = nullptr;
  for (const std::string& path : fake_hid().paths) {
    auto* info = new hid_device_info{};
    info->path = strdup(path.c_str());
    info->next = first;
    first = info;
  }
  return first;
}
void hid_free_enumeration(hid_device_info* info) {
  while (info != nullptr) {
    hid_device_info* next = info->next;
    free(info->path);
    delete info;
    info = next;
  }
}
hid_device* hid_open_path(const char*) { return new hid_device; }
void hid_close(hid_device* device) { delete device; }
int hid_write(hid_device*, const unsigned char*, std::size_t size) {
  return static_cast<int>(size);
}
int hid_read_timeout(hid_device*, unsigned char* report, std::size_t size, int) {
  ++fake_hid().readings;
  if (fake_hid().reports > 0) {
    --fake_hid().reports;
    std::memset(report, 0, size);
    return static_cast<int>(size);
  }
  if (!fake_hid().read_fails) return 0;
  if (fake_hid().read_error != 0) errno = fake_hid().read_error;
  return -1;
}

}  // extern "C"
