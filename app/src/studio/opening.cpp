// Files that the studio opens and saves, told by the endings of their names.

#include "claystack/engine/atomic_file.hpp"
#include "claystack/engine/pot_file.hpp"
#include "claystack/engine/scene_file.hpp"
#include "claystack/engine/work_file.hpp"
#include "studio/workshop.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::studio {
namespace {

bool is_pot(const std::string& name) {
  return name.ends_with(".pot.json") || name.ends_with(".pot.cbor");
}

/// A pot tells its clay, and not how it was thrown: the rest is in proportion to it.
SceneSpec scene_for(const Pot& pot, const std::string& name) {
  const double height_mm = std::max(1.0, pot.stack.height_mm());
  double widest_mm = 1.0;
  for (const Ring& ring : pot.stack.rings()) widest_mm = std::max(widest_mm, ring.outer_mm());
  SceneSpec scene;
  scene.name = name;
  scene.model = pot.model;
  scene.lump = {.rings = pot.stack.size(),
                .ring_height_mm = pot.stack.ring_height_mm(),
                .outer_radius_mm = widest_mm,
                .inner_radius_mm = 0.0,
                .max_rings = 0,
                .density_g_cm3 = pot.density_g_cm3};
  scene.removal.min_wall_mm = 3.0;
  scene.flow = {.sigma_mm = 0.12 * height_mm, .reach_mm = 0.5 * height_mm, .inside_share = 0.25};
  scene.force->stiffness_n_per_mm2 = 0.02;
  scene.force->friction = 0.2;
  return scene;
}

Result<void> open_text(Workshop& shop, const std::string& text, const std::filesystem::path& path) {
  const std::string name = path.string();
  if (name.ends_with(".work"))
    return parse_work(text, name).and_then([&](WorkReading&& read) {
      if (read.torn)
        shop.notices.say(Grade::warning, fmt::format("{}: the last line was cut off; all before "
                                                     "it is here",
                                                     name));
      return shop.potter.begin(std::move(read.work));
    });
  if (is_pot(name))
    return parse_pot(text, name).and_then([&](Pot&& pot) {
      return shop.potter.begin(scene_for(pot, path.stem().stem().string()), pot);
    });
  return parse_scene(text, name).and_then([&](SceneSpec&& scene) {
    return shop.potter.begin(scene);
  });
}

}  // namespace

void open_file(Workshop& shop, const std::filesystem::path& path) {
  shop.potter.release();
  shop.notices.close();
  auto opened =
      read_file(path).and_then([&](std::string&& text) { return open_text(shop, text, path); });
  if (!opened) return tell(shop, opened.error());
  shop.file = path.string().ends_with(".work") ? path : std::filesystem::path();
  shop.settings.folder = path.parent_path().string();
  show_work(shop);
  shop.log("opened: " + path.string());
}

bool save_to(Workshop& shop, const std::filesystem::path& path) {
  shop.potter.release();
  const std::string name = path.string();
  Result<void> saved;
  if (name.ends_with(".work")) {
    saved = shop.potter.save(name);
    if (saved) shop.file = path;
  } else if (is_pot(name)) {
    const auto encoding = name.ends_with(".cbor") ? PotEncoding::cbor : PotEncoding::json;
    saved = publish(path, write_pot(shop.potter.pot(), encoding));
  } else {
    saved = failure(
        ErrorKind::bad_input,
        fmt::format("{}: expected a name that ends in .work, .pot.json or .pot.cbor", name));
  }
  if (!saved) {
    tell(shop, saved.error());
    return false;
  }
  shop.settings.folder = path.parent_path().string();
  shop.log("saved: " + name);
  shop.notices.say(Grade::note, "Saved " + name,
                   1e-9 * static_cast<double>(shop.host.frame_ns()) + 4.0);
  if (shop.quit_after_saving) shop.done = true;
  close_overlay(shop);
  return true;
}

}  // namespace clay::studio
