#include "studio/workshop.hpp"

namespace clay::studio {
double clay_rate_per_s(const Workshop& shop) {
  return shop.rate_per_s * shop.settings.wheel_rpm / kNominalRpm;
}

void tell(Workshop& shop, const Error& error) {
  shop.log("error: " + error.message);
  shop.notices.say(error.kind == ErrorKind::bad_input ? Grade::warning : Grade::fault,
                   error.message);
}

void close_overlay(Workshop& shop) {
  shop.overlay = shop.potter.has_work() ? Overlay::none : Overlay::gallery;
  shop.quit_after_saving = false;
}

void show_work(Workshop& shop) {
  choose(shop.potter.scene().tool, shop.settings.tool);
  shop.rate_per_s = shop.potter.scene().removal.rate_per_s;
  shop.overlay = Overlay::none;
  shop.view.look(shop, Seen::home);
  shop.log("work begun: " + shop.potter.scene().name);
}

void begin_work(Workshop& shop, const SceneSpec& scene) {
  if (auto begun = shop.potter.begin(scene); !begun) return tell(shop, begun.error());
  shop.file.clear();
  shop.notices.close();
  show_work(shop);
}

}  // namespace clay::studio
