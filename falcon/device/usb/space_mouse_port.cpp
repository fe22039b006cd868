#include "claystack/falcon/usb.hpp"
#include "falcon/device/usb/hid_node.hpp"

#include <utility>

namespace clay::falcon::inline device {
namespace {

class NodePort final : public ReportPort {
 public:
  DeviceResult<void> open(const std::string& place) override {
    return node_.open(place, HidNode::Use::shared);
  }
  int read(std::span<std::uint8_t> report) noexcept override { return node_.read(report, 0); }
  void write(std::span<const std::uint8_t> report) noexcept override {
    if (node_.is_open()) node_.write(report);
  }

 private:
  HidNode node_;
};

}  // namespace

std::unique_ptr<HapticDevice> make_space_mouse(std::string name, std::string place,
                                               const SpaceMouseSettings& settings) {
  return make_space_mouse(std::move(name), std::move(place), settings,
                          std::make_unique<NodePort>());
}

}  // namespace clay::falcon::inline device
