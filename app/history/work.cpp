#include "app/history/work.hpp"

#include "app/history/replay.hpp"
#include "app/history/split.hpp"
#include "claystack/engine/files.hpp"
#include "core/time_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <span>

namespace clay::history {
namespace {

std::size_t poses_until(const WorkNode& stroke, double seconds) {
  const std::int64_t until_us = in_microseconds(std::clamp(seconds, 0.0, 9e9));
  return static_cast<std::size_t>(std::distance(
      stroke.poses.begin(), std::ranges::upper_bound(stroke.poses, until_us, {}, &Pose::time_us)));
}

Error full() {
  return {ErrorKind::bad_input,
          fmt::format("expected at most {} poses in one work, found more: begin a new work with "
                      "its pot",
                      kMaxPoses)};
}

/// Of a work without strokes.
WorkRecord record_of(const SceneSpec& scene) {
  WorkRecord record;
  record.scenes = {scene};
  record.nodes.resize(1);
  return record;
}

/// A collapsed pot cannot be thrown on, but it can be viewed and exported.
Result<Pot> root_of(const SceneSpec& scene, const std::optional<Pot>& start) {
  if (start && start->collapse)
    return StepPlan::build(scene).map([&](const StepPlan&) { return *start; });
  const auto wheel = start ? Wheel::build(scene, *start) : Wheel::build(scene);
  return wheel.map([](const Wheel& built) { return built.pot(); });
}

}  // namespace

/// The stroke in progress. Poses arrive on the recorder's thread until it has finished.
struct Work::Running final : PoseSink {
  NodeId node = 0;
  std::size_t scene = 0;
  std::size_t room = 0;  // poses that the work can still hold
  std::string begin_line;
  std::vector<Pose> poses;
  std::vector<bool> touching;  // for each of them
  bool touched = false;        // any of them
  Journal* journal = nullptr;
  std::size_t written = 0;  // poses in the journal

  Result<void> append(const PoseBlock& block) override {
    assert(block.contact.size() == block.poses.size());
    if (block.poses.size() > room - poses.size()) return tl::make_unexpected(full());
    poses.insert(poses.end(), block.poses.begin(), block.poses.end());
    touching.insert(touching.end(), block.contact.begin(), block.contact.end());
    touched = touched || std::ranges::find(block.contact, true) != block.contact.end();
    if (touched) write();
    return {};
  }
  Result<void> finish() override { return {}; }

  /// The journal gets the stroke with its first contact: a stroke in free air leaves no line.
  void write() {
    if (journal == nullptr) return;
    if (written == 0) journal->append(begin_line);
    journal->append(session_blocks(std::span(poses).subspan(written)));
    written = poses.size();
  }
};

/// A wheel in the middle of a stroke.
struct Work::Scrubbing {
  NodeId node;
  Wheel wheel;
  std::size_t played = 0;
};

Work::Work(WorkRecord record, SharedPot root, std::size_t kept_bytes)
    : record_(std::move(record)),
      known_(record_.nodes.size()),
      children_(record_.nodes.size()),
      root_(std::move(root)),
      pots_(kept_bytes) {
  for (NodeId node = 1; node < record_.nodes.size(); ++node)
    children_[record_.nodes[node].parent].push_back(node);
  known_[0] = Known{root_->stack.volume_mm3(), false};
}
Work::Work(Work&&) noexcept = default;
Work& Work::operator=(Work&&) noexcept = default;
Work::~Work() = default;

Result<Work> Work::begin(const SceneSpec& scene) { return open(record_of(scene)); }

Result<Work> Work::begin(const SceneSpec& scene, const Pot& start) {
  WorkRecord record = record_of(scene);
  record.start = start;
  return open(std::move(record));
}

Result<Work> Work::open(WorkRecord record, std::size_t kept_bytes) {
  const SceneSpec& scene = record.scenes[record.nodes[0].scene];
  auto root = root_of(scene, record.start);
  if (!root) return tl::make_unexpected(root.error());
  return Work(std::move(record), std::make_shared<const Pot>(std::move(*root)), kept_bytes);
}

std::size_t Work::index_of(const SceneSpec& scene) {
  const auto known = std::ranges::find(record_.scenes, scene);
  const auto index = static_cast<std::size_t>(known - record_.scenes.begin());
  if (known == record_.scenes.end()) {
    record_.scenes.push_back(scene);
    if (journal_) journal_->append(work_scene_line(scene));
  }
  return index;
}

std::size_t Work::room() const noexcept {
  std::size_t held = 0;
  for (const WorkNode& stroke : record_.nodes) held += stroke.poses.size();
  return kMaxPoses - std::min(held, kMaxPoses);
}

Result<Begun> Work::begin_stroke(const SceneSpec& scene) {
  assert(!running_);
  if (room() == 0) return tl::make_unexpected(full());
  const auto before = pot();
  if (!before) return tl::make_unexpected(before.error());
  auto wheel = Wheel::build(scene, **before);
  if (!wheel) return tl::make_unexpected(wheel.error());
  running_ = std::make_unique<Running>();
  running_->node = record_.nodes.size();
  running_->scene = index_of(scene);
  running_->room = room();
  running_->begin_line = work_stroke_line(running_->node, at(), running_->scene, scene);
  running_->journal = journal_.get();
  return Begun{running_.get(), std::move(*wheel)};
}

bool Work::in_stroke() const noexcept { return running_ != nullptr; }

Result<Added> Work::end_stroke(std::optional<Pot> thrown, Recording recording) {
  assert(running_);
  if (running_->touched) return finish_stroke(recording, std::move(thrown));
  running_.reset();
  return Added{at(), 0};
}

Result<Added> Work::add(const SceneSpec& scene, std::vector<Pose> poses) {
  if (poses.size() > room()) return tl::make_unexpected(full());
  auto begun = begin_stroke(scene);
  if (!begun) return tl::make_unexpected(begun.error());
  constexpr std::array<bool, kPosesPerBlock> kUnknown{};  // only a split needs the contacts
  for (std::span<const Pose> rest = poses; !rest.empty();) {
    const auto block = rest.first(std::min(rest.size(), kPosesPerBlock));
    (void)begun->sink->append({block, std::span(kUnknown).first(block.size())});
    rest = rest.subspan(block.size());
  }
  return finish_stroke(Recording::one_stroke, std::nullopt);
}

Result<Added> Work::finish_stroke(Recording recording, std::optional<Pot> thrown) {
  const std::unique_ptr<Running> stroke = std::move(running_);
  if (stroke->poses.empty()) return Added{at(), 0};
  stroke->write();
  const auto before = pot();
  if (!before) return tl::make_unexpected(before.error());
  const SceneSpec scene = record_.scenes[stroke->scene];
  auto whole = thrown ? Result<Thrown>(Thrown{std::move(*thrown), std::move(stroke->touching)})
                      : Wheel::build(scene, **before).map([&](Wheel&& wheel) {
                          return replay(std::move(wheel), stroke->poses);
                        });
  if (!whole) return tl::make_unexpected(whole.error());
  Split parts = recording == Recording::several_strokes
                    ? split(scene, **before, stroke->poses, std::move(*whole))
                    : as_one(std::move(*whole));
  if (stroke->journal != nullptr) {
    stroke->journal->append(work_end_line(stroke->poses.size(), parts.begins));
    stroke->journal->sync_soon();
  }
  std::size_t begin = 0;
  for (std::size_t part = 0; part < parts.pots.size(); ++part) {
    const std::size_t end = part < parts.begins.size() ? parts.begins[part] : stroke->poses.size();
    append(stroke->scene, from_zero(std::span(stroke->poses).subspan(begin, end - begin)),
           std::move(parts.pots[part]));
    begin = end;
  }
  return Added{at(), parts.pots.size()};
}

void Work::append(std::size_t scene, std::vector<Pose> poses, Pot pot_after) {
  const auto before = pot();
  const NodeId node = record_.nodes.size();
  record_.nodes.push_back({at(), scene, std::move(poses), 0});
  children_[at()].push_back(node);
  children_.emplace_back();
  known_.emplace_back();
  learn(node, **before, std::make_shared<const Pot>(std::move(pot_after)));
  clay::go_to(record_, node);
}

void Work::learn(NodeId node, const Pot& before, SharedPot pot_after) {
  known_[node] = Known{pot_after->stack.volume_mm3(),
                       !(pot_after->stack == before.stack && pot_after->ledger == before.ledger)};
  pots_.put(node, std::move(pot_after));
}

bool Work::can_undo() const noexcept { return at() != 0; }
bool Work::can_redo() const noexcept { return record_.nodes[at()].taken != 0; }

bool Work::undo() {
  if (!can_undo()) return false;
  go_to(record_.nodes[at()].parent);
  return true;
}

bool Work::redo() {
  if (!can_redo()) return false;
  go_to(record_.nodes[at()].taken);
  return true;
}

void Work::go_to(NodeId node) {
  assert(!running_ && node < size());
  clay::go_to(record_, node);
  if (journal_) journal_->append(work_at_line(node));
}

Error Work::named(NodeId node, const Error& error) const {
  return {error.kind, fmt::format("node {}: {}", node, error.message)};
}

Result<SharedPot> Work::pot(NodeId node) {
  std::vector<NodeId> missing;
  SharedPot kept;
  for (NodeId at_node = node; !kept; at_node = record_.nodes[at_node].parent) {
    kept = at_node == 0 ? root_ : pots_.find(at_node);
    if (!kept) missing.push_back(at_node);
  }
  for (; !missing.empty(); missing.pop_back()) {
    const NodeId next = missing.back();
    const WorkNode& stroke = record_.nodes[next];
    auto wheel = Wheel::build(record_.scenes[stroke.scene], *kept);
    if (!wheel) return tl::make_unexpected(named(next, wheel.error()));
    for (const Pose& pose : stroke.poses) wheel->step(pose);
    auto thrown = std::make_shared<const Pot>(wheel->pot());
    learn(next, *kept, thrown);
    kept = std::move(thrown);
  }
  return kept;
}

Result<Pot> Work::scrub(NodeId node, double seconds) {
  if (node == 0) return *root_;
  const WorkNode& stroke = record_.nodes[node];
  const std::size_t until = poses_until(stroke, seconds);
  if (!scrubbing_ || scrubbing_->node != node || scrubbing_->played > until) {
    const auto before = pot(stroke.parent);
    if (!before) return tl::make_unexpected(before.error());
    auto wheel = Wheel::build(record_.scenes[stroke.scene], **before);
    if (!wheel) return tl::make_unexpected(named(node, wheel.error()));
    scrubbing_ = std::make_unique<Scrubbing>(Scrubbing{node, std::move(*wheel), 0});
  }
  for (; scrubbing_->played < until; ++scrubbing_->played)
    scrubbing_->wheel.step(stroke.poses[scrubbing_->played]);
  return scrubbing_->wheel.pot();
}

Result<Added> Work::branch(NodeId node, double seconds) {
  assert(!running_);
  const WorkNode& stroke = record_.nodes[node];
  const std::size_t until = poses_until(stroke, seconds);
  const NodeId from = until == stroke.poses.size() ? node : stroke.parent, left = at();
  const SceneSpec scene = record_.scenes[stroke.scene];
  const std::vector<Pose> poses(stroke.poses.begin(),
                                stroke.poses.begin() + static_cast<std::ptrdiff_t>(until));
  go_to(from);
  if (from == node || poses.empty()) return Added{at(), 0};
  auto added = add(scene, poses);
  if (!added) go_to(left);
  return added;
}

Result<void> Work::throw_all() {
  for (NodeId node = 1; node < size(); ++node)
    if (!known_[node])
      if (const auto thrown = pot(node); !thrown) return tl::make_unexpected(thrown.error());
  return {};
}

NodeView Work::view(NodeId node) const {
  const WorkNode& stroke = record_.nodes[node];
  NodeView view;
  view.parent = stroke.parent;
  view.children = children_[node];
  view.scene = &record_.scenes[stroke.scene];
  view.poses = stroke.poses.size();
  if (!stroke.poses.empty()) view.seconds = in_seconds(stroke.poses.back().time_us);
  if (known_[node]) {
    view.volume_mm3 = known_[node]->volume_mm3;
    view.changed = known_[node]->changed;
  }
  return view;
}

}  // namespace clay::history
