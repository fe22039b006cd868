#pragma once
// Connects a HID gadget for the tested backend of hidapi: as a kernel node for hidraw, as a USB
// device for libusb (CLAYSTACK_HIDAPI_LIBUSB).

#include "tests/rigs/hid_gadget.hpp"

namespace clay::rig {

#ifdef CLAYSTACK_HIDAPI_LIBUSB
class Plugged {
 public:
  Plugged(UMockdevTestbed* testbed, HidGadget& gadget) : plug_(testbed, gadget) {}
  void pump() {}
  void show(bool) {}

 private:
  UsbPlug plug_;
};
#else
class Plugged {
 public:
  Plugged(UMockdevTestbed* testbed, HidGadget& gadget)
      : node_(testbed, gadget, gadget.identity().port) {}
  /// See HidrawNode.
  void pump() { node_.pump(); }
  void show(bool there) { node_.show(there); }

 private:
  HidrawNode node_;
};
#endif

}  // namespace clay::rig
