// Files that the studio opens and saves; the ending of the name decides the kind.

#include "app/history/work.hpp"
#include "app/studio/app_state.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::studio {
namespace {

bool is_pot(const std::string& name) {
  return name.ends_with(".pot.json") || name.ends_with(".pot.cbor");
}

Result<void> open_work(AppState& shop, const std::string& name) {
  return history::load(name).and_then([&](history::Loaded&& loaded) {
    if (loaded.torn)
      shop.notices.say(Grade::warning,
                       fmt::format("{}: the last line was cut off; all before it is here", name));
    return shop.potter.begin(std::move(loaded.work));
  });
}

Result<void> open_text(AppState& shop, const std::string& text, const std::filesystem::path& path) {
  const std::string name = path.string();
  if (is_pot(name))
    return parse_pot(text, name).and_then([&](Pot&& pot) {
      return shop.potter.begin(scene_for(pot, path.stem().stem().string()), pot);
    });
  return parse_scene(text, name).and_then([&](SceneSpec&& scene) {
    return shop.potter.begin(scene);
  });
}

void open_drawing(AppState& shop, const std::filesystem::path& path) {
  auto bytes = read_file(path);
  if (!bytes) return tell(shop, bytes.error());
  shop.importing = {};
  shop.importing.path = path;
  shop.importing.bytes = std::move(*bytes);
  read_again(shop.importing);
  shop.overlay = Overlay::import_drawing;
  shop.log("drawing: " + path.string());
}

void open_now(AppState& shop, const std::filesystem::path& path) {
  shop.notices.close();
  const std::string name = path.string();
  const bool is_work = name.ends_with(".work");
  auto opened = is_work ? open_work(shop, name) : read_file(path).and_then([&](std::string&& text) {
    return open_text(shop, text, path);
  });
  if (!opened) return tell(shop, opened.error());
  shop.file = is_work ? path : std::filesystem::path();
  remember(shop.settings, path);
  show_work(shop);
  shop.log("opened: " + name);
}

/// Names in the box for files begin here.
std::filesystem::path start_of(const AppState& shop) {
  const std::string& folder = shop.settings.folder;
  return folder.empty() ? std::filesystem::path() : std::filesystem::path(folder) / "";
}

}  // namespace

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
  scene.removal.yield_depth_mm = 2.0;
  scene.removal.min_wall_mm = 3.0;
  scene.flow = {.sigma_mm = 0.12 * height_mm, .reach_mm = 0.5 * height_mm, .inside_share = 0.25};
  scene.force->stiffness_n_per_mm2 = 0.03;
  scene.force->friction = 0.2;
  return scene;
}

void take_process(AppState& shop, const std::filesystem::path& path) {
  if (auto process = solid::read_process(path.string()); !process)
    return tell(shop, process.error());
  remember_process(shop.settings, path);
  if (shop.overlay == Overlay::export_files) shop.exporting.wish.process = shop.settings.process;
  shop.log("process: " + path.string());
}

void open_file(AppState& shop, const std::filesystem::path& path) {
  if (path.string().ends_with(".process.json")) return take_process(shop, path);
  if (is_drawing(path)) return open_drawing(shop, path);
  ask_first(shop, "open", [path](AppState& s) { open_now(s, path); });
}

void take_import(AppState& shop) {
  ask_first(shop, "import", [](AppState& s) {
    if (!s.importing.made) return;
    const std::string name = s.importing.path.stem().string();
    const Pot& pot = s.importing.made->pot;
    if (auto begun = s.potter.begin(scene_for(pot, name), pot); !begun)
      return tell(s, begun.error());
    s.file.clear();
    remember(s.settings, s.importing.path);
    show_work(s);
    s.log("imported: " + s.importing.path.string());
  });
}

bool save_to(AppState& shop, const std::filesystem::path& path) {
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
  remember(shop.settings, path);
  shop.log("saved: " + name);
  shop.notices.say(Grade::note, "Saved " + name,
                   1e-9 * static_cast<double>(shop.host.frame_ns()) + 4.0);
  const auto then = shop.save_first && !shop.potter.unsaved() ? std::move(shop.waiting) : nullptr;
  close_overlay(shop);
  if (then) then(shop);
  return true;
}

void ask_for_open(AppState& shop) {
  const std::filesystem::path start = start_of(shop);
  if (shop.host.real_time() && shop.dialog.begin(FileDialog::Kind::open, start)) return;
  shop.path_box = start.string();
  shop.overlay = Overlay::open_file;
}

void ask_for_save(AppState& shop) {
  const std::filesystem::path path = start_of(shop) / (shop.potter.scene().name + ".work");
  if (shop.host.real_time() && shop.dialog.begin(FileDialog::Kind::save, path)) return;
  shop.path_box = path.string();
  shop.overlay = Overlay::save_file;
}

void ask_for_process(AppState& shop) {
  if (shop.host.real_time() && shop.dialog.begin(FileDialog::Kind::process, start_of(shop))) return;
  shop.notices.say(
      Grade::warning,
      "No file dialog is installed (zenity, kdialog): drop a .process.json file on the "
      "window, or open it by its name (Ctrl+O)",
      1e-9 * static_cast<double>(shop.host.frame_ns()) + 5.0);
}

void look_at_dialog(AppState& shop) {
  const FileDialog::Kind kind = shop.dialog.kind();
  const auto chosen = shop.dialog.take();
  if (!chosen || chosen->empty()) return;
  if (kind == FileDialog::Kind::open) open_file(shop, *chosen);
  if (kind == FileDialog::Kind::save) save_to(shop, *chosen);
  if (kind == FileDialog::Kind::process) take_process(shop, *chosen);
  if (kind == FileDialog::Kind::folder) shop.exporting.wish.folder = *chosen;
}

}  // namespace clay::studio
