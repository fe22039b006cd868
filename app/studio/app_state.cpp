#include "app/studio/app_state.hpp"

#include <utility>

namespace clay::studio {

namespace {

/// Free of what was there before.
void begin_anew(AppState& shop, const SceneSpec& scene) {
  if (auto begun = shop.potter.begin(scene); !begun) return tell(shop, begun.error());
  shop.file.clear();
  shop.notices.close();
  show_work(shop);
}

}  // namespace

double clay_rate_per_s(const AppState& shop) {
  return shop.rate_per_s * shop.settings.wheel_rpm / kNominalRpm;
}

void tell(AppState& shop, const Error& error) {
  shop.log("error: " + error.message);
  shop.notices.say(error.kind == ErrorKind::bad_input ? Grade::warning : Grade::fault,
                   error.message);
}

void close_overlay(AppState& shop) {
  shop.overlay = shop.potter.has_work() ? Overlay::none : Overlay::gallery;
  shop.waiting = nullptr;
  shop.save_first = false;
}

void show_work(AppState& shop) {
  choose(shop.potter.scene().tool, shop.settings.tool);
  shop.rate_per_s = shop.potter.scene().removal.rate_per_s;
  shop.overlay = Overlay::none;
  shop.view.look(shop, Seen::home);
  shop.exporting.written.clear();
  shop.log("work begun: " + shop.potter.scene().name);
}

void ask_first(AppState& shop, const char* prompt, std::function<void(AppState&)> then) {
  shop.potter.release();
  if (!shop.potter.unsaved()) return then(shop);
  shop.waiting = std::move(then);
  shop.save_first = false;
  shop.overlay = Overlay::quit_prompt;
  shop.log(std::string("prompt: ").append(prompt));
}

void keep_it(AppState& shop) {
  shop.save_first = true;
  if (shop.file.empty())
    ask_for_save(shop);
  else
    save_to(shop, shop.file);
}

void let_it_go(AppState& shop) {
  const auto then = std::exchange(shop.waiting, nullptr);
  shop.potter.give_up();
  close_overlay(shop);
  if (then) then(shop);
}

void begin_work(AppState& shop, const SceneSpec& scene) {
  ask_first(shop, "new", [scene](AppState& s) { begin_anew(s, scene); });
}

void recover_work(AppState& shop, std::size_t left) {
  const std::filesystem::path path = shop.left.at(left).path;
  if (shop.potter.unsaved())
    return ask_first(shop, "recover", [left](AppState& s) { recover_work(s, left); });
  shop.left.erase(shop.left.begin() + static_cast<std::ptrdiff_t>(left));
  auto begun = history::recover(path).and_then(
      [&](history::Work&& work) { return shop.potter.begin(std::move(work)); });
  if (!begun) return tell(shop, begun.error());
  shop.file.clear();
  show_work(shop);
  shop.log("recovered: " + path.string());
}

void discard_work(AppState& shop, std::size_t left) {
  const std::filesystem::path path = shop.left.at(left).path;
  if (auto gone = history::discard(path); gone)
    shop.log("discarded: " + path.string());
  else
    tell(shop, gone.error());
  shop.left.erase(shop.left.begin() + static_cast<std::ptrdiff_t>(left));
}

}  // namespace clay::studio
