#include "app/cli/device_monitor.hpp"

#include "app/cli/json_output.hpp"
#include "core/json/json_text.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <thread>

namespace clay::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kTick = std::chrono::milliseconds(1);
constexpr auto kRedraw = std::chrono::milliseconds(100);

volatile sig_atomic_t interrupted = 0;

/// During its scope, SIGINT and SIGTERM only end the monitor.
class Interrupts {
 public:
  Interrupts() {
    interrupted = 0;
    struct sigaction action {};
    action.sa_handler = [](int) { interrupted = 1; };
    sigaction(SIGINT, &action, &before_int_);
    sigaction(SIGTERM, &action, &before_term_);
  }
  ~Interrupts() {
    sigaction(SIGINT, &before_int_, nullptr);
    sigaction(SIGTERM, &before_term_, nullptr);
  }
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

 private:
  struct sigaction before_int_ {
  }, before_term_{};
};

struct View {
  double time_s = 0.0;
  falcon::DeviceSample sample;
  double rate_hz = 0.0;
  falcon::DeviceCounters counters;
  glm::dvec3 tool_mm{0.0};  // on the wheel
};

Json view_json(const View& view) {
  const glm::dvec3& at = view.sample.position_mm;
  return {{"time_s", view.time_s},
          {"state", name_of(view.sample.state)},
          {"position_mm", {at.x, at.y, at.z}},
          {"tool_mm", {view.tool_mm.x, view.tool_mm.y, view.tool_mm.z}},
          {"buttons", view.sample.buttons},
          {"rate_hz", view.rate_hz},
          {"bytes_discarded", view.counters.bytes_discarded}};
}

std::string view_text(const View& view) {
  const glm::dvec3& at = view.sample.position_mm;
  std::string text = fmt::format(
      "{:<13} x {:7.2f}  y {:7.2f}  z {:7.2f} mm  tool {:6.1f} {:6.1f} {:6.1f}  buttons {:04b}  "
      "{:5.0f} Hz  {} bytes lost",
      name_of(view.sample.state), at.x, at.y, at.z, view.tool_mm.x, view.tool_mm.y, view.tool_mm.z,
      view.sample.buttons, view.rate_hz, view.counters.bytes_discarded);
  if (view.sample.state == falcon::DeviceState::needs_homing) text += "  (pull out, push in)";
  return text;
}

/// False: output failed permanently.
bool show(const View& view, const Console& console, bool terminal) {
  if (console.json) {
    put_out(json_line(view_json(view)) + "\n");
  } else if (!console.quiet && terminal) {
    put_out("\r\033[K" + view_text(view));
  } else {
    console.print(view_text(view));
  }
  return flush_out();
}

}  // namespace

falcon::DeviceResult<void> watch(falcon::HapticDevice& device, double seconds,
                                 const servo::Mapping& mapping, const Console& console) {
  const Interrupts interrupts;
  const bool terminal = isatty(STDOUT_FILENO) == 1;
  const auto start = Clock::now();
  auto next = start, next_view = start + kRedraw;
  std::uint64_t fresh = 0;
  View view;
  while (interrupted == 0 && (seconds == 0.0 || view.time_s < seconds)) {
    device.write({});
    view.sample = device.read(std::chrono::microseconds(kTick).count());
    if (view.sample.state == falcon::DeviceState::fault) break;
    if (view.sample.fresh) ++fresh;
    const auto now = Clock::now();
    view.time_s = std::chrono::duration<double>(now - start).count();
    if (now >= next_view) {
      view.rate_hz = static_cast<double>(fresh) /
                     std::chrono::duration<double>(now - next_view + kRedraw).count();
      view.counters = device.counters();
      view.tool_mm = mapping.to_clay(view.sample.position_mm);
      if (!show(view, console, terminal)) break;
      fresh = 0;
      next_view = now + kRedraw;
    }
    // Missed ticks are not repeated after a pause.
    next = std::max(next + kTick, now);
    std::this_thread::sleep_until(next);
  }
  device.stop();
  if (terminal && !console.json && !console.quiet) put_out("\n");
  if (view.sample.state == falcon::DeviceState::fault) return tl::make_unexpected(device.problem());
  return {};
}

}  // namespace clay::cli
