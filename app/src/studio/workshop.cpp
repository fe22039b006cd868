#include "studio/workshop.hpp"

#include "claystack/engine/atomic_file.hpp"
#include "claystack/engine/pot_file.hpp"
#include "claystack/engine/scene_file.hpp"

#include <fmt/format.h>

namespace clay::studio {
namespace {

bool ends_with(const std::filesystem::path& path, std::string_view tail) {
  return path.string().ends_with(tail);
}

}  // namespace

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

void begin_work(Workshop& shop, const SceneSpec& scene) {
  if (auto begun = shop.potter.begin(scene); !begun) return tell(shop, begun.error());
  choose(scene.tool, shop.settings.tool);
  shop.rate_per_s = scene.removal.rate_per_s;
  shop.file.clear();
  shop.notices.close();
  shop.overlay = Overlay::none;
  shop.view.look(shop, Seen::home);
  shop.log("work begun: " + scene.name);
}

void open_file(Workshop& shop, const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return tell(shop, text.error());
  const auto scene = parse_scene(*text, path.string());
  if (!scene) return tell(shop, scene.error());
  begin_work(shop, *scene);
}

bool save_to(Workshop& shop, const std::filesystem::path& path) {
  if (!ends_with(path, ".pot.json") && !ends_with(path, ".pot.cbor")) {
    tell(shop,
         {ErrorKind::bad_input,
          fmt::format("{}: expected a name that ends in .pot.json or .pot.cbor", path.string())});
    return false;
  }
  const PotEncoding encoding = ends_with(path, ".cbor") ? PotEncoding::cbor : PotEncoding::json;
  if (auto done = publish(path, write_pot(shop.potter.pot(), encoding)); !done) {
    tell(shop, done.error());
    return false;
  }
  shop.file = path;
  shop.log("saved: " + path.string());
  if (shop.quit_after_saving) shop.done = true;
  close_overlay(shop);
  return true;
}

}  // namespace clay::studio
