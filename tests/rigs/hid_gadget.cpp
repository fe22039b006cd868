#include "tests/rigs/hid_gadget.hpp"

#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace clay::rig {
namespace {

constexpr double kFrameS = 1e-3;
constexpr std::size_t kReport = 64;

// Usage page FF00, one collection: 64 bytes in, 64 bytes out, no report numbers.
const Bytes kBridgeDescriptor = {0x06, 0x00, 0xFF, 0x09, 0x46, 0xA1, 0x01, 0x15, 0x00,
                                 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x40, 0x09, 0x01,
                                 0x81, 0x02, 0x09, 0x02, 0x91, 0x02, 0xC0};
// Generic desktop, multi-axis controller: three axes in report 1, the LED in report 4.
const Bytes kSpaceMouseDescriptor = {
    0x05, 0x01, 0x09, 0x08, 0xA1, 0x01, 0x85, 0x01, 0x16, 0xA2, 0xFE, 0x26, 0x5E, 0x01, 0x75,
    0x10, 0x95, 0x03, 0x09, 0x30, 0x09, 0x31, 0x09, 0x32, 0x81, 0x02, 0x85, 0x04, 0x05, 0x08,
    0x09, 0x4B, 0x15, 0x00, 0x25, 0x01, 0x75, 0x08, 0x95, 0x01, 0x91, 0x02, 0xC0};

std::string four_digits(std::uint16_t number) {
  char digits[5];
  std::snprintf(digits, sizeof digits, "%04X", number);
  return digits;
}

std::string hid_id_of(const UsbIdentity& id) {
  return "0003:0000" + four_digits(id.vendor) + ":0000" + four_digits(id.product);
}

/// USB device, interface, HID device and node, each inside the one before, as in sysfs.
std::string sysfs_of(const UsbIdentity& id, const Bytes& descriptor, int number) {
  const std::string n = std::to_string(number), port = std::to_string(id.port);
  const std::string usb = "/devices/pci0000:00/0000:00:14.0/usb1/1-" + port;
  const std::string interface = usb + "/1-" + port + ":1.0";
  const std::string vendor = four_digits(id.vendor), product = four_digits(id.product);
  const std::string hid = interface + "/0003:" + vendor + ":" + product + ".000" + n;
  return "P: " + usb + "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nA: idVendor=" + vendor +
         "\nA: idProduct=" + product + "\nA: product=" + id.name +
         "\nA: manufacturer=rig\nA: bcdDevice=0100\n\nP: " + interface +
         "\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\nA: bInterfaceNumber=00\n\nP: " + hid +
         "\nE: SUBSYSTEM=hid\nE: HID_ID=" + hid_id_of(id) + "\nE: HID_NAME=" + id.name +
         "\nE: HID_UNIQ=\nH: report_descriptor=" + hexadecimal(descriptor) + "\n\nP: " + hid +
         "/hidraw/hidraw" + n + "\nN: hidraw" + n + "\nE: DEVNAME=/dev/hidraw" + n +
         "\nE: MAJOR=240\nE: MINOR=" + n + "\nE: SUBSYSTEM=hidraw\nL: device=../../../" +
         hid.substr(hid.rfind('/') + 1) + "\n\n";
}

UsbIdentity hid_identity(std::uint16_t vendor, std::uint16_t product, std::string name,
                         const Bytes& report_descriptor, int port) {
  return {vendor, product, std::move(name), 3, 0x81, 0x01, true, report_descriptor, port};
}

}  // namespace

std::optional<Bytes> HidGadget::in(std::size_t, std::chrono::microseconds) {
  if (reports.empty()) return std::nullopt;
  Bytes report = std::move(reports.front());
  reports.pop_front();
  return report;
}

BridgeGadget::BridgeGadget(const falcon::FalconModelSettings& settings, Trajectory hand, int port)
    : device(settings, std::move(hand)) {
  identity_ = hid_identity(0x1209, 0x0001, "Falcon HID bridge (rig)", kBridgeDescriptor, port);
  device.model.set_baud(1'500'000);
}

void BridgeGadget::out(std::span<const std::uint8_t> report) {
  if (report.size() != kReport || report[0] == 0 || report[0] >= kReport) {
    ++bad_reports;
    return;
  }
  bytes += report[0];
  const falcon::Answer answer = device.model.receive(report.subspan(1, report[0]), kFrameS);
  auto left = answer.span();
  while (!left.empty()) {
    const std::size_t size = std::min(left.size(), kReport - 1);
    Bytes next(kReport, 0xEE);  // bytes after the counted ones have no meaning
    next[0] = static_cast<std::uint8_t>(size);
    std::copy_n(left.begin(), size, next.begin() + 1);
    reports.push_back(std::move(next));
    left = left.subspan(size);
  }
}

SpaceMouseGadget::SpaceMouseGadget() {
  identity_ = hid_identity(0x256f, 0xc635, "SpaceMouse Compact", kSpaceMouseDescriptor, 3);
}

HidrawNode::HidrawNode(UMockdevTestbed* testbed, HidGadget& gadget, int number)
    : gadget_(gadget), testbed_(testbed), node_("/dev/hidraw" + std::to_string(number)) {
  const std::string text = sysfs_of(gadget.identity(), gadget.identity().report_descriptor, number);
  const auto hid = text.rfind("P: ", text.find("E: HID_ID")) + 3;
  hid_path_ = "/sys" + text.substr(hid, text.find('\n', hid) - hid);
  base_ = umockdev_ioctl_base_new();
  g_signal_connect(base_, "handle-ioctl", G_CALLBACK(&HidrawNode::on_ioctl), this);
  g_signal_connect(base_, "handle-read", G_CALLBACK(&HidrawNode::on_read), this);
  g_signal_connect(base_, "handle-write", G_CALLBACK(&HidrawNode::on_write), this);
  GError* error = nullptr;
  if (!umockdev_testbed_add_from_string(testbed, text.c_str(), &error) ||
      !umockdev_testbed_attach_ioctl(testbed, node_.c_str(), base_, &error)) {
    std::fprintf(stderr, "umockdev: %s\n", error->message);
    std::abort();
  }
  terminal_ = umockdev_testbed_get_dev_fd(testbed, node_.c_str());
  gchar* root = umockdev_testbed_get_root_dir(testbed);
  path_ = root + node_;
  g_free(root);
}

HidrawNode::~HidrawNode() {
  g_signal_handlers_disconnect_by_data(base_, this);
  g_object_unref(base_);
}

void HidrawNode::show(bool there) {
  const std::string hidden = path_ + ".gone";
  std::filesystem::rename(there ? hidden : path_, there ? path_ : hidden);
}

void HidrawNode::become(const UsbIdentity& other) {
  umockdev_testbed_set_property(testbed_, hid_path_.c_str(), "HID_ID", hid_id_of(other).c_str());
}

void HidrawNode::pump() {
  if (waiting_ || (gadget_.reports.empty() && !gadget_.unplugged())) return;
  // A dummy byte wakes a reader that waits on a removed device.
  const Bytes report = gadget_.in(kReport, {}).value_or(Bytes{0});
  // Not by write(), which umockdev would attribute to the program.
  waiting_ = syscall(SYS_write, terminal_, report.data(), report.size()) > 0;
}

gboolean HidrawNode::on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  auto& node = *static_cast<HidrawNode*>(self);
  const std::scoped_lock held(node.gadget_.lock);
  const bool known = umockdev_ioctl_client_get_request(client) == HIDIOCGRDESCSIZE;
  if (known) {
    UMockdevIoctlData* data =
        umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(int), nullptr);
    const int size = static_cast<int>(node.gadget_.identity().report_descriptor.size());
    std::memcpy(data->data, &size, sizeof size);
    g_object_unref(data);
  }
  umockdev_ioctl_client_complete(client, known ? 0 : -1, known ? 0 : ENOTTY);
  return TRUE;
}

gboolean HidrawNode::on_read(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  auto& node = *static_cast<HidrawNode*>(self);
  const std::scoped_lock held(node.gadget_.lock);
  if (node.gadget_.unplugged()) {
    umockdev_ioctl_client_complete(client, -1, EIO);
    return TRUE;
  }
  int error = 0;
  const int size = umockdev_ioctl_client_execute(client, &error, nullptr);
  umockdev_ioctl_client_complete(client, size, error);
  node.waiting_ = false;
  node.pump();
  return TRUE;
}

gboolean HidrawNode::on_write(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  auto& node = *static_cast<HidrawNode*>(self);
  const std::scoped_lock held(node.gadget_.lock);
  const UMockdevIoctlData* data = umockdev_ioctl_client_get_arg(client);
  const std::span<const std::uint8_t> bytes(data->data, static_cast<std::size_t>(data->data_len));
  const bool gone = node.gadget_.unplugged();
  // The kernel removes the report's number if reports have none.
  if (!gone) node.gadget_.out(bytes[0] == 0 ? bytes.subspan(1) : bytes);
  umockdev_ioctl_client_complete(client, gone ? -1 : data->data_len, gone ? ENODEV : 0);
  node.pump();
  return TRUE;
}

}  // namespace clay::rig
