#include "tests/rigs/usb_gadget.hpp"

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace clay::rig {
namespace {

// Emulated nodes always poll as ready, so libusb would spin without a pause.
constexpr auto kHold = std::chrono::microseconds(50);
constexpr std::uint32_t kCapabilities = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                        USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                                        USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
constexpr int kFullSpeed = 2;  // USB_SPEED_FULL
constexpr std::size_t kSetupBytes = 8;

std::uint8_t low(std::uint16_t word) { return static_cast<std::uint8_t>(word & 0xFF); }
std::uint8_t high(std::uint16_t word) { return static_cast<std::uint8_t>(word >> 8); }

/// USB 2.0, section 9.6: device, configuration, interface, two endpoints; HID 1.11, 6.2.1 between.
Bytes descriptors_of(const UsbIdentity& id) {
  const bool hid = id.interface_class == 3;
  const auto total = static_cast<std::uint8_t>(9 + 9 + (hid ? 9 : 0) + 2 * 7);
  Bytes bytes = {
      18, 1, 0, 2, 0, 0, 0, 64, low(id.vendor), high(id.vendor), low(id.product), high(id.product),
      0,  4, 1, 2, 0, 1};
  const auto add = [&bytes](std::initializer_list<std::uint8_t> more) {
    bytes.insert(bytes.end(), more);
  };
  add({9, 2, total, 0, 1, 1, 0, 0x80, 50});
  add({9, 4, 0, 0, 2, id.interface_class, static_cast<std::uint8_t>(hid ? 0 : 0xFF),
       static_cast<std::uint8_t>(hid ? 0 : 0xFF), 0});
  if (hid)
    add({9, 0x21, 0x11, 1, 0, 1, 0x22, static_cast<std::uint8_t>(id.report_descriptor.size()), 0});
  const std::uint8_t type = id.interrupt ? 3 : 2, interval = id.interrupt ? 1 : 0;
  add({7, 5, id.in, type, 64, 0, interval});
  add({7, 5, id.out, type, 64, 0, interval});
  return bytes;
}

std::string hexadecimal(std::uint16_t word) {
  return rig::hexadecimal(Bytes{high(word), low(word)});
}

UMockdevIoctlData* resolve(UMockdevIoctlData* data, std::size_t offset, std::size_t size) {
  return umockdev_ioctl_data_resolve(data, offset, size, nullptr);
}

usbdevfs_urb& urb_in(UMockdevIoctlData* data) {
  return *reinterpret_cast<usbdevfs_urb*>(data->data);
}

}  // namespace

std::string hexadecimal(const Bytes& bytes) {
  std::string text;
  char digits[3];
  for (const std::uint8_t byte : bytes) {
    std::snprintf(digits, sizeof digits, "%02X", byte);
    text += digits;
  }
  return text;
}

UsbPlug::UsbPlug(UMockdevTestbed* testbed, UsbGadget& gadget) : testbed_(testbed), gadget_(gadget) {
  const UsbIdentity& id = gadget.identity();
  const std::string port = std::to_string(id.port), number = std::to_string(id.port + 1);
  node_ = "/dev/bus/usb/001/00" + number;
  const std::string path = "/devices/pci0000:00/0000:00:14.0/usb1/1-" + port;
  path_ = "/sys" + path;
  const std::string text =
      "P: " + path + "\nN: bus/usb/001/00" + number +
      "\nE: DEVTYPE=usb_device\nE: DEVNAME=" + node_ + "\nE: BUSNUM=001\nE: DEVNUM=00" + number +
      "\nE: MAJOR=189\nE: MINOR=" + port +
      "\nE: SUBSYSTEM=usb\nA: bConfigurationValue=1\nA: busnum=1\nA: devnum=" + number +
      "\nA: speed=12\nA: idVendor=" + hexadecimal(id.vendor) +
      "\nA: idProduct=" + hexadecimal(id.product) + "\nA: product=" + id.name +
      "\nA: manufacturer=rig\nA: bcdDevice=0400\nH: descriptors=" +
      hexadecimal(descriptors_of(id)) + "\n\n";
  base_ = umockdev_ioctl_base_new();
  g_signal_connect(base_, "handle-ioctl", G_CALLBACK(&UsbPlug::on_ioctl), this);
  g_signal_connect(base_, "client-vanished", G_CALLBACK(&UsbPlug::on_vanished), this);
  GError* error = nullptr;
  if (!umockdev_testbed_add_from_string(testbed, text.c_str(), &error) ||
      !umockdev_testbed_attach_ioctl(testbed, node_.c_str(), base_, &error)) {
    std::fprintf(stderr, "umockdev: %s\n", error->message);
    std::abort();
  }
}

UsbPlug::~UsbPlug() {
  g_signal_handlers_disconnect_by_data(base_, this);
  g_object_unref(base_);
}

void UsbPlug::pull() {
  (void)umockdev_testbed_detach_ioctl(testbed_, node_.c_str(), nullptr);
  umockdev_testbed_remove_device(testbed_, path_.c_str());
}

gboolean UsbPlug::on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  static_cast<UsbPlug*>(self)->handle(client);
  return TRUE;
}

void UsbPlug::on_vanished(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  auto& plug = *static_cast<UsbPlug*>(self);
  const std::scoped_lock held(plug.gadget_.lock);
  if (plug.claimed_by_ == client) plug.claimed_by_ = nullptr;
}

/// 0, or the error.
int UsbPlug::claim(const UMockdevIoctlClient* client) {
  if (gadget_.unplugged()) return ENODEV;
  if (manners.kernel_driver || (claimed_by_ != nullptr && claimed_by_ != client)) return EBUSY;
  claimed_by_ = client;
  return 0;
}

void UsbPlug::handle(UMockdevIoctlClient* client) {
  const std::scoped_lock held(gadget_.lock);
  const unsigned long request = umockdev_ioctl_client_get_request(client);
  const auto answer = [client](int result, int error = 0) {
    umockdev_ioctl_client_complete(client, error == 0 ? result : -1, error);
  };
  UMockdevIoctlData* data = _IOC_SIZE(request) == 0 ? nullptr
                                                    : resolve(umockdev_ioctl_client_get_arg(client),
                                                              0, _IOC_SIZE(request));
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES:
      std::memcpy(data->data, &kCapabilities, sizeof kCapabilities);
      answer(0);
      break;
    case USBDEVFS_GETDRIVER: {
      auto& driver = *reinterpret_cast<usbdevfs_getdriver*>(data->data);
      if (manners.kernel_driver) std::strcpy(driver.driver, "ftdi_sio");
      answer(0, manners.kernel_driver ? 0 : ENODATA);
      break;
    }
    case USBDEVFS_IOCTL: {
      const auto& inner = *reinterpret_cast<usbdevfs_ioctl*>(data->data);
      const bool disconnects = inner.ioctl_code == static_cast<int>(USBDEVFS_DISCONNECT);
      answer(0, disconnects && manners.kernel_driver ? 0 : ENODATA);
      if (disconnects) manners.kernel_driver = false;
      break;
    }
    case USBDEVFS_CLAIMINTERFACE:
      answer(0, claim(client));
      break;
    case USBDEVFS_RELEASEINTERFACE:
      if (claimed_by_ == client) claimed_by_ = nullptr;
      [[fallthrough]];
    case USBDEVFS_SETCONFIGURATION:
    case USBDEVFS_CLEAR_HALT:
    case USBDEVFS_RESET:
      answer(0, gadget_.unplugged() ? ENODEV : 0);
      break;
    case USBDEVFS_GET_SPEED:
      answer(kFullSpeed);
      break;
    case USBDEVFS_SUBMITURB:
      submit(client, data);
      break;
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      reap(client, data);
      break;
    case USBDEVFS_DISCARDURB:
      discard(client);
      break;
    case USBDEVFS_BULK:
      bulk(client, data);
      break;
    default:
      answer(0, ENOTTY);
  }
  if (data) g_object_unref(data);
}

void UsbPlug::finish(const Urb& urb, int status, std::size_t length) {
  urb_in(urb.data).status = status;
  urb_in(urb.data).actual_length = static_cast<int>(length);
  done_.push_back(urb);
}

/// Strings (USB 2.0, section 9.6.7): languages, manufacturer, name; in UTF-16.
std::optional<Bytes> UsbPlug::describe(const Setup& setup) const {
  constexpr std::uint8_t kString = 3;
  if (setup.request_type != 0x80 || setup.request != 6 || setup.value >> 8 != kString)
    return std::nullopt;
  const int index = setup.value & 0xFF;
  if (index == 0) return Bytes{4, kString, 0x09, 0x04};
  const std::string text = index == 1 ? "rig" : gadget_.identity().name;
  Bytes bytes = {static_cast<std::uint8_t>(2 + 2 * text.size()), kString};
  for (const char letter : text) {
    bytes.push_back(static_cast<std::uint8_t>(letter));
    bytes.push_back(0);
  }
  return bytes;
}

void UsbPlug::run_control(Urb& urb) {
  const std::uint8_t* b = urb.buffer->data;
  const auto word = [b](int at) { return static_cast<std::uint16_t>(b[at] | b[at + 1] << 8); };
  const Setup setup{b[0], b[1], word(2), word(4), word(6)};
  const auto room = static_cast<std::size_t>(urb.buffer->data_len) - kSetupBytes;
  auto answer = describe(setup);
  if (!answer) answer = gadget_.control(setup, {b + kSetupBytes, room});
  if (!answer) return finish(urb, -EPIPE, 0);
  const bool reads = (setup.request_type & 0x80) != 0;
  const std::size_t size = reads ? std::min(room, answer->size()) : room;
  if (reads) std::copy_n(answer->begin(), size, urb.buffer->data + kSetupBytes);
  finish(urb, 0, size);
}

void UsbPlug::submit(UMockdevIoctlClient* client, UMockdevIoctlData* data) {
  const usbdevfs_urb& urb = urb_in(data);
  const auto size = static_cast<std::size_t>(urb.buffer_length);
  if (gadget_.unplugged()) {
    if ((urb.endpoint & 0x80) == 0 && urb.type != USBDEVFS_URB_TYPE_CONTROL)
      refuse(resolve(data, offsetof(usbdevfs_urb, buffer), size), size);
    return umockdev_ioctl_client_complete(client, -1, ENODEV);
  }
  Urb taken{data, resolve(data, offsetof(usbdevfs_urb, buffer), size), Clock::now()};
  g_object_ref(data);
  if (urb.type == USBDEVFS_URB_TYPE_CONTROL) {
    run_control(taken);
  } else if ((urb.endpoint & 0x80) != 0) {
    reads_.push_back(taken);
  } else {
    writes_.push_back(taken);
    deliver_writes();
  }
  umockdev_ioctl_client_complete(client, 0, 0);
}

void UsbPlug::deliver_writes() {
  for (; manners.stalled_writes == 0 && !writes_.empty(); writes_.pop_front()) {
    const Urb& urb = writes_.front();
    const auto size = static_cast<std::size_t>(urb.buffer->data_len);
    gadget_.out({urb.buffer->data, size});
    finish(urb, 0, size);
  }
}

void UsbPlug::recover() {
  manners.stalled_writes = 0;
  deliver_writes();
}

void UsbPlug::refuse(UMockdevIoctlData* bytes, std::size_t size) {
  gadget_.refused.emplace_back(bytes->data, bytes->data + size);
  g_object_unref(bytes);
}

/// Reads are answered in order.
void UsbPlug::fill_reads() {
  while (!reads_.empty()) {
    const Urb& urb = reads_.front();
    const auto waited =
        std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - urb.since);
    const auto room = static_cast<std::size_t>(urb.buffer->data_len);
    if (gadget_.unplugged()) {
      finish(urb, -ESHUTDOWN, 0);
    } else if (manners.stalled_writes > 0) {
      return;
    } else if (const auto bytes = gadget_.in(room, waited)) {
      std::copy(bytes->begin(), bytes->end(), urb.buffer->data);
      finish(urb, 0, bytes->size());
    } else {
      return;
    }
    reads_.pop_front();
  }
}

void UsbPlug::reap(UMockdevIoctlClient* client, UMockdevIoctlData* data) {
  if (done_.empty()) fill_reads();
  if (done_.empty()) {
    g_usleep(static_cast<gulong>(kHold.count()));
    return umockdev_ioctl_client_complete(client, -1, EAGAIN);
  }
  const Urb urb = done_.front();
  done_.pop_front();
  umockdev_ioctl_data_set_ptr(data, 0, urb.data);
  umockdev_ioctl_client_complete(client, 0, 0);
  g_object_unref(urb.buffer);
}

void UsbPlug::discard(UMockdevIoctlClient* client) {
  gulong address = 0;
  std::memcpy(&address, umockdev_ioctl_client_get_arg(client)->data, sizeof address);
  for (auto* queue : {&reads_, &writes_}) {
    const auto urb =
        std::ranges::find(*queue, address, [](const Urb& u) { return u.data->client_addr; });
    if (urb == queue->end()) continue;
    finish(*urb, -ENOENT, 0);
    queue->erase(urb);
    return umockdev_ioctl_client_complete(client, 0, 0);
  }
  umockdev_ioctl_client_complete(client, -1, EINVAL);
}

/// The synchronous call, which libraries use for writing only.
void UsbPlug::bulk(UMockdevIoctlClient* client, UMockdevIoctlData* data) {
  const auto& transfer = *reinterpret_cast<usbdevfs_bulktransfer*>(data->data);
  UMockdevIoctlData* bytes = resolve(data, offsetof(usbdevfs_bulktransfer, data), transfer.len);
  if (gadget_.unplugged()) {
    refuse(bytes, transfer.len);
    return umockdev_ioctl_client_complete(client, -1, ENODEV);
  }
  const bool stalled = manners.stalled_writes > 0;
  if (stalled) --manners.stalled_writes;
  deliver_writes();
  if (!stalled) gadget_.out({bytes->data, transfer.len});
  umockdev_ioctl_client_complete(client, stalled ? -1 : static_cast<long>(transfer.len),
                                 stalled ? ETIMEDOUT : 0);
  g_object_unref(bytes);
}

}  // namespace clay::rig
