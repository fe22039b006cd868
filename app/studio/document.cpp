#include "app/studio/document.hpp"

#include "app/cli/pot_copy.hpp"
#include "app/cli/pot_input.hpp"
#include "app/history/pot_scene.hpp"
#include "app/render/pot_view.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/export/formats.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace clay::studio {
namespace {

bool is_pot(const std::string& name) { return cli::pot_encoding_of(name).has_value(); }

bool is_work(const std::string& name) { return ends_ignoring_case(name, ".work"); }

/// A scene, where no file of another kind was recognised.
Result<SceneSpec> scene_in(const std::string& text, const std::string& name) {
  constexpr const char* kOpened =
      "a scene (.scene.json), a pot (.pot.json, .pot.cbor), a work (.work), a 3MF with its pot, or "
      "a drawing (.svg, .dxf, .csv)";
  if (solid::mesh_format_of(name))
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected {}, found a mesh. The window does not open meshes; "
                               "`claystack import` in a terminal makes a pot from a mesh",
                               name, kOpened));
  const std::string_view begun = without_byte_order_mark(text);
  const std::size_t first = begun.find_first_not_of(" \t\r\n");
  const bool object = first != std::string_view::npos && begun[first] == '{';
  if (!object && known_kind(text).empty())
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected {}, found {}", name, kOpened, kind_of_file(text)));
  return parse_scene(text, name).map_error([&](Error error) {
    return kind_error(std::move(error), text, name, kOpened);
  });
}

SceneSpec current_scene(const WorkRecord& record) {
  return record.scenes.at(record.nodes.at(record.at).scene);
}

}  // namespace

std::optional<FileStamp> FileStamp::of(const std::filesystem::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  return FileStamp{status.st_mtim.tv_sec * kNsPerS + status.st_mtim.tv_nsec,
                   static_cast<std::uint64_t>(status.st_size), status.st_ino};
}

Result<void> Document::begin(const SceneSpec& scene) {
  return history::Work::begin(scene).map(
      [&](history::Work&& work) { replace(scene, std::move(work)); });
}

Result<void> Document::begin(const SceneSpec& scene, const Pot& pot) {
  return history::Work::begin(scene, pot).map([&](history::Work&& work) {
    replace(scene, std::move(work));
  });
}

void Document::begin(history::Work work) {
  const SceneSpec scene = current_scene(work.record());
  replace(scene, std::move(work));
}

void Document::replace(const SceneSpec& scene, history::Work work) {
  if (work_ && !unsaved() && work_->journal() != nullptr) work_->journal()->discard();
  changes_discarded_ = false;
  file_.clear();
  lock_.reset();
  pot_saved_at_.reset();
  scene_ = scene;
  rate_per_s_ = scene.removal.rate_per_s;
  wheel_rpm_ = scene.clay && scene.clay->wheel_rpm > 0.0 ? scene.clay->wheel_rpm : kNominalRpm;
  work_.emplace(std::move(work));
  if (auto shown = show_pot(); !shown) problem_ = shown.error();
  journal_error_.reset();
  if (journals_ && work_->journal() == nullptr) renew_journal();
}

std::optional<Error> Document::journal_problem() const {
  if (!journals_ || !work_) return std::nullopt;
  return work_->journal() != nullptr ? work_->journal()->trouble() : journal_error_;
}

void Document::renew_journal() {
  auto journal = history::Journal::begin(work_->record());
  if (!journal) {
    journal_error_ = journal.error();
    return;
  }
  if (work_->journal() != nullptr) work_->journal()->discard();
  work_->keep(std::move(*journal));
}

void Document::close() {
  if (work_ && work_->journal() != nullptr) work_->journal()->discard();
}

Document::Remark Document::begin(Opened opened) {
  replace(opened.scene, std::move(opened.work));
  if (opened.file.empty()) return {};
  keep_file(opened.file);
  const std::string name = opened.file.string();
  if (opened.torn)
    return fmt::format("{}: the last line was cut off; all lines before it were read", name);
  if (file_in_use())
    return fmt::format("{} is open in another window. Save under another name to keep both works",
                       name);
  return {};
}

Result<Document::Opened> Document::read(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (is_work(name))
    return history::load(name).map([&](history::Loaded&& loaded) {
      SceneSpec scene = current_scene(loaded.work.record());
      return Opened{std::move(scene), std::move(loaded.work), path, loaded.torn};
    });
  const auto text = read_file(path);
  if (!text) return tl::make_unexpected(text.error());
  if (is_pot(name) || cli::is_3mf(name))
    return cli::pot_from(*text, name).and_then([&](Pot&& pot) {
      const SceneSpec scene = history::scene_for(pot, name_of_file(name));
      return history::Work::begin(scene, pot).map([&](history::Work&& work) {
        return Opened{scene, std::move(work)};
      });
    });
  return scene_in(*text, name).and_then([](SceneSpec&& scene) {
    return history::Work::begin(scene).map([&](history::Work&& work) {
      return Opened{std::move(scene), std::move(work)};
    });
  });
}

Result<Document::Remark> Document::open(const std::filesystem::path& path) {
  return read(path).map([&](Opened&& opened) { return begin(std::move(opened)); });
}

Result<void> Document::save(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (is_work(name)) return work_->save(name).map([&] { keep_file(path); });
  const auto encoding = cli::pot_encoding_of(name);
  if (!encoding)
    return failure(
        ErrorKind::bad_input,
        fmt::format("{}: expected a name that ends in .work, .pot.json or .pot.cbor", name));
  return cli::expect_room_to_write(pot_->stack.size(), *encoding, name)
      .and_then([&] { return publish(path, write_pot(*pot_, *encoding)); })
      .map([&] { pot_saved_at_ = work_->at(); });
}

void Document::keep_file(const std::filesystem::path& path) {
  file_ = path;
  lock_.reset();
  lock_ = std::make_unique<history::FileLock>(path, history::FileLock::Kind::exclusive);
  stamp_ = FileStamp::of(path).value_or(FileStamp{});
}

bool Document::replaces_other(const std::filesystem::path& path) const {
  const auto found = FileStamp::of(path);
  return found && (!has_file(path) || *found != stamp_ || file_in_use());
}

bool Document::has_file(const std::filesystem::path& path) const {
  std::error_code ignored;
  return !file_.empty() && (path == file_ || std::filesystem::equivalent(path, file_, ignored));
}

std::string Document::name() const {
  return file_.empty() ? scene_.name : file_.filename().string();
}

std::string Document::title() const {
  if (!file_.empty()) return name_of_file(file_.string());
  return scene_.name.empty() ? "pot" : scene_.name;
}

SceneSpec Document::scene_with(const ToolSpec& tool, double wheel_rpm) const {
  SceneSpec scene = scene_;
  scene.tool = tool;
  scene.removal.rate_per_s = rate_per_s_ * wheel_rpm / wheel_rpm_;
  if (scene.clay) scene.clay->wheel_rpm = wheel_rpm;
  return scene;
}

void Document::set_stiffness(double n_per_mm2) {
  if (scene_.force) scene_.force->stiffness_n_per_mm2 = n_per_mm2;
}

double Document::stiffness() const noexcept {
  return work_ && scene_.force ? scene_.force->stiffness_n_per_mm2 : 0.0;
}

Result<void> Document::show_pot() {
  moment_.reset();
  moment_pot_.reset();
  auto pot = work_->pot();
  if (!pot) return tl::make_unexpected(pot.error());
  pot_ = std::move(*pot);
  view_ = render::view_of(*pot_);
  return {};
}

Result<history::Begun> Document::begin_stroke(const SceneSpec& scene) {
  auto begun = work_->begin_stroke(scene);
  if (begun) changes_discarded_ = false;
  return begun;
}

Result<void> Document::end_stroke(std::optional<Pot> thrown, history::Recording recording) {
  const auto added = work_->end_stroke(std::move(thrown), recording);
  auto shown = show_pot();
  if (!added) return tl::make_unexpected(added.error());
  return shown;
}

Result<void> Document::undo() { return work_->undo() ? show_pot() : Result<void>(); }

Result<void> Document::redo() { return work_->redo() ? show_pot() : Result<void>(); }

Result<void> Document::go_to(history::NodeId node) {
  if (node != work_->at()) work_->go_to(node);
  return show_pot();
}

std::optional<history::NodeId> Document::other_branch() const {
  if (!work_) return std::nullopt;
  for (history::NodeId node = work_->at(); node != 0; node = work_->view(node).parent) {
    const auto siblings = work_->view(work_->view(node).parent).children;
    if (siblings.size() < 2) continue;
    const auto here = std::ranges::find(siblings, node);
    return here + 1 == siblings.end() ? siblings.front() : *(here + 1);
  }
  return std::nullopt;
}

Result<void> Document::scrub(history::NodeId node, double seconds) {
  auto pot = work_->scrub(node, seconds);
  if (!pot) return tl::make_unexpected(pot.error());
  moment_pot_ = std::make_shared<const Pot>(std::move(*pot));
  view_ = render::view_of(*moment_pot_);
  moment_ = Moment{node, seconds};
  return {};
}

Result<void> Document::show_present() { return moment_ ? show_pot() : Result<void>(); }

Result<void> Document::branch_here() {
  if (!moment_) return {};
  const auto added = work_->branch(moment_->node, moment_->seconds);
  auto shown = show_pot();
  if (!added) return tl::make_unexpected(added.error());
  return shown;
}

}  // namespace clay::studio
