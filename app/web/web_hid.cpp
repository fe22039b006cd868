#include "app/web/web_hid.hpp"

#include "claystack/falcon/usb.hpp"

#include <emscripten.h>
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

namespace clay::web {
namespace {

EM_JS(void, page_send_report, (const std::uint8_t* bytes, int size), {
  const data = HEAPU8.slice(bytes + 1, bytes + size);
  Module["page"].sendReport(HEAPU8[bytes], data);
});

/// The page has one controller at a time.
struct Plugged {
  const falcon::SpaceMouseModel* model = nullptr;  // null: none
  bool taken = false;                              // the window has it
  std::deque<std::vector<std::uint8_t>> reports;
};
Plugged plugged;
constexpr std::size_t kMostReports = 1000;  // of some seconds; a hidden page reads none

class PagePort final : public falcon::ReportPort {
 public:
  explicit PagePort(servo::Clock& clock) : clock_(clock) {}
  falcon::DeviceResult<void> open(const std::string&) override { return {}; }
  int read(std::span<std::uint8_t> report) noexcept override {
    if (plugged.model == nullptr) return -1;
    if (plugged.reports.empty()) return 0;
    const std::vector<std::uint8_t>& next = plugged.reports.front();
    const std::size_t size = std::min(next.size(), report.size());
    std::copy_n(next.begin(), size, report.begin());
    plugged.reports.pop_front();
    return static_cast<int>(size);
  }
  void write(std::span<const std::uint8_t> report) noexcept override {
    if (plugged.model != nullptr) page_send_report(report.data(), static_cast<int>(report.size()));
  }
  [[nodiscard]] std::int64_t now_us() const noexcept override { return clock_.now_us(); }

 private:
  servo::Clock& clock_;
};

}  // namespace

studio::LookForDevice look_for_hid(servo::Clock& clock) {
  return [&clock]() -> Result<std::unique_ptr<falcon::HapticDevice>> {
    if (plugged.model == nullptr || plugged.taken) return nullptr;
    plugged.taken = true;
    auto device = falcon::make_space_mouse(std::string(plugged.model->name), "page", {},
                                           std::make_unique<PagePort>(clock));
    if (auto opened = device->open(); !opened) return tl::make_unexpected(opened.error());
    return device;
  };
}

}  // namespace clay::web

using namespace clay;
using namespace clay::web;

extern "C" {
/// The controllers that the program knows, as filters for WebHID: JSON.
EMSCRIPTEN_KEEPALIVE const char* claystack_hid_filters() {
  static std::string text;
  text.clear();
  for (const auto& model : falcon::space_mouse_models())
    text += fmt::format("{}{{\"vendorId\":{},\"productId\":{}}}", text.empty() ? "[" : ",",
                        model.vendor, model.product);
  text += "]";
  return text.c_str();
}
/// False: the program does not know the device.
EMSCRIPTEN_KEEPALIVE bool claystack_hid_plugged(int vendor, int product) {
  const auto models = falcon::space_mouse_models();
  const auto found = std::ranges::find_if(models, [&](const auto& model) {
    return model.vendor == vendor && model.product == product;
  });
  if (found == models.end()) return false;
  plugged = {&*found, false, {}};
  return true;
}
/// `report` begins with its number.
EMSCRIPTEN_KEEPALIVE void claystack_hid_report(const std::uint8_t* report, int size) {
  // The newest ones count: a button must not remain pressed.
  if (plugged.reports.size() == kMostReports) plugged.reports.pop_front();
  plugged.reports.emplace_back(report, report + size);
}
EMSCRIPTEN_KEEPALIVE void claystack_hid_unplugged() { plugged = {}; }
}
