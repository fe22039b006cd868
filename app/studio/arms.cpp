// Arms and controllers at the window: they come, throw, need something, and go.

#include "app/servo/words.hpp"
#include "app/studio/actions.hpp"
#include "app/studio/app_state.hpp"

#include <utility>

namespace clay::studio {
namespace {

constexpr double kGreetingS = 6.0;
// A device that is homed says so with its first frames.
constexpr std::uint64_t kTicksToKnow = 250;

/// What nobody but the potter can do; empty: nothing.
std::string request_of(const AppState& shop) {
  if (!shop.potter.throwing() || !shop.potter.has_motors()) return {};
  const servo::LiveStatus& status = shop.potter.status();
  const bool homes =
      status.device == falcon::DeviceState::needs_homing && status.ticks > kTicksToKnow;
  return homes || servo::waits_for_rearm(status) ? words_of_hand(shop) : std::string();
}

/// In place of what was said of the arm before, as far as that still stands.
void say_of_hand(AppState& shop, Grade grade, const std::string& text, double until_s = 0.0) {
  shop.notices.take_back(std::exchange(shop.hand_told, text));
  if (!text.empty()) shop.notices.say(grade, text, until_s);
}

void greet(AppState& shop, const falcon::DeviceInfo& info) {
  shop.log("device: " + info.name);
  say_of_hand(shop, Grade::note, info.name + " is here and throws now",
              1e-9 * static_cast<double>(shop.host.frame_ns()) + kGreetingS);
}

}  // namespace

void look_at_devices(AppState& shop) {
  if (!shop.devices) return;
  if (const std::string problem = shop.devices->take_problem(); !problem.empty())
    tell(shop, {ErrorKind::bad_input, problem + "; the mouse throws meanwhile"});
  if (shop.potter.throwing() && !shop.potter.has_device()) return;  // two hands, one pot
  auto device = shop.devices->take();
  if (!device) {
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left))  // a slider is let go first
      shop.potter.hold(tool_of(shop.settings.tool), clay_rate_per_s(shop));
    return;
  }
  servo::LiveSettings settings;
  settings.buttons = device->info().can_push ? servo::kFalconButtons : servo::kTwoButtons;
  greet(shop, device->info());
  shop.potter.take(std::move(device), settings);
}

void lose_arm(AppState& shop, const Error& why) {
  if (shop.devices) shop.devices->look_again();
  const Error error{why.kind, why.message + "; the mouse throws meanwhile"};
  say_of_hand(shop, Grade::fault, {});
  shop.hand_told = error.message;
  tell(shop, error);
}

std::string words_of_hand(const AppState& shop) {
  if (!shop.potter.throwing() || !shop.potter.has_motors()) return {};
  return servo::words_of(shop.potter.status(), text_of(find_action("wheel.rearm")->chord));
}

bool waits_for_rearm(const AppState& shop) {
  return shop.potter.throwing() && shop.potter.has_motors() &&
         servo::waits_for_rearm(shop.potter.status());
}

void look_at_hand(AppState& shop) {
  const bool pushed = shop.potter.throwing() && shop.potter.has_motors();
  const std::string is = pushed ? servo::name_of(shop.potter.status().guard) : "";
  if (is != shop.hand_is) {
    if (!is.empty()) shop.log("force: " + is);
    shop.hand_is = is;
  }
  if (!pushed) return;
  const std::string request = request_of(shop);
  const bool asked = shop.hand_asks;
  shop.hand_asks = !request.empty();
  if (shop.hand_asks ? request != shop.hand_told : asked)
    say_of_hand(shop, Grade::warning, request);
}

}  // namespace clay::studio
