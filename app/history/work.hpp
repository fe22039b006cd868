#pragma once
// What was done at the wheel, as a tree of strokes: undo, redo, branches, and any moment again. A
// stroke is a session of its own on the pot before it, so every pot of the tree can be thrown again
// to the same bits; pots are kept only to save that time. For one thread.

#include "app/history/journal.hpp"
#include "app/history/pose_sink.hpp"
#include "app/history/pot_cache.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::history {

using NodeId = std::size_t;  ///< 0: the root, the pot before any stroke
using SharedPot = std::shared_ptr<const Pot>;

/// One stroke in a timeline.
struct NodeView {
  NodeId parent = 0;
  std::vector<NodeId> children;      ///< oldest first
  const SceneSpec* scene = nullptr;  ///< tool, mode, settings; valid until the next stroke
  double seconds = 0.0;
  std::size_t poses = 0;
  // Known once its pot has been on the wheel in this run of the program.
  std::optional<double> volume_mm3;
  std::optional<bool> changed;  ///< the clay; false: the tool was in the air all the time
};

/// What became of a stroke.
struct Added {
  NodeId node = 0;          ///< now the current one; several strokes: the last of them
  std::size_t strokes = 0;  ///< 0: there was no pose, and nothing was added
  bool as_felt = true;      ///< thrown again it gives the pot that was shown while it lasted
};

class Work {
 public:
  /// With the scene's lump, or with a pot. Errors are those of Wheel::build; but a pot that has
  /// fallen may be the root, and then has no strokes.
  static Result<Work> begin(const SceneSpec& scene);
  static Result<Work> begin(const SceneSpec& scene, const Pot& start);
  /// Of a file. Checks that the root can be on the wheel; strokes are thrown when they are asked
  /// for.
  static Result<Work> open(WorkRecord record);
  Work(Work&&) noexcept;
  Work& operator=(Work&&) noexcept;
  ~Work();

  // --- Strokes -------------------------------------------------------------------------------
  /// A stroke begins on the current pot. The sink is the recorder's; it keeps the poses, and the
  /// journal gets them at once. It lasts until end_stroke. The journal's trouble() reports a full
  /// disk; the sink fails only where the work would hold more than kMaxPoses. Errors are
  /// those of Wheel::build, and a work that is full.
  Result<PoseSink*> begin_stroke(const SceneSpec& scene);
  /// The recorder has finished. Throws the stroke again, splits it where the tool was in the air
  /// long enough (split.hpp), and makes it current. `shown`: the pot that the servo left, compared
  /// with what the poses give; the tree keeps the latter. Errors are those of Wheel::build.
  Result<Added> end_stroke(const Pot* shown = nullptr);
  /// Both at once, for poses that are there already. Not split.
  Result<Added> add(const SceneSpec& scene, std::vector<Pose> poses, const Pot* shown = nullptr);
  [[nodiscard]] bool in_stroke() const noexcept;

  // --- Ways through the tree; false where there is none. Not while a stroke lasts. ---------------
  bool undo();
  bool redo();  ///< to the branch that was last taken
  void go_to(NodeId node);
  [[nodiscard]] bool can_undo() const noexcept;
  [[nodiscard]] bool can_redo() const noexcept;

  // --- Pots ------------------------------------------------------------------------------------
  /// As the strokes up to `node` leave it. At once where it is kept, else thrown again from the
  /// nearest one that is. Errors: a file's stroke that cannot be thrown on the pot before it.
  Result<SharedPot> pot(NodeId node);
  Result<SharedPot> pot() { return pot(at()); }
  /// In mid-stroke, after the poses up to `seconds`. Going forward costs the ticks between.
  Result<Pot> scrub(NodeId node, double seconds);
  /// What `scrub` shows becomes the present pot: a stroke of the poses up to there, beside the one
  /// that they are of, which stays. At a stroke's end it is that stroke, before all poses the pot
  /// before it: then nothing is added.
  Result<Added> branch(NodeId node, double seconds);
  /// Throws what has not been thrown yet, so that every view is complete.
  Result<void> throw_all();
  void set_memory_budget(std::size_t bytes);  ///< of kept pots; 256 MiB at first

  // --- The tree --------------------------------------------------------------------------------
  [[nodiscard]] NodeId at() const noexcept { return record_.at; }
  [[nodiscard]] std::size_t size() const noexcept { return record_.nodes.size(); }  ///< with root
  [[nodiscard]] NodeView view(NodeId node) const;
  [[nodiscard]] const WorkRecord& record() const noexcept { return record_; }

  // --- Files -----------------------------------------------------------------------------------
  /// The whole tree, in one step or not at all; `unsaved` is false then.
  Result<void> save(const std::string& path);
  [[nodiscard]] bool unsaved() const noexcept;
  /// What happens from now on goes to the journal too; what has happened is in it already.
  void keep(std::unique_ptr<Journal> journal);
  [[nodiscard]] Journal* journal() noexcept { return journal_.get(); }

 private:
  struct Running;
  struct Scrubbing;
  Work(WorkRecord record, SharedPot root);

  [[nodiscard]] std::size_t room() const noexcept;  ///< poses that it can still hold
  std::size_t index_of(const SceneSpec& scene);
  Result<Added> finish_stroke(bool may_split, const Pot* shown);
  void append(std::size_t scene, std::vector<Pose> poses, Pot pot);
  void learn(NodeId node, const Pot& before, SharedPot pot);
  [[nodiscard]] Error named(NodeId node, const Error& error) const;

  WorkRecord record_;
  struct Known {
    double volume_mm3;
    bool changed;
  };
  std::vector<std::optional<Known>> known_;
  std::vector<std::vector<NodeId>> children_;
  SharedPot root_;
  PotCache pots_;
  std::unique_ptr<Running> running_;
  std::unique_ptr<Scrubbing> scrubbing_;
  std::unique_ptr<Journal> journal_;
};

/// A work file, and whether its end was cut off.
struct Loaded {
  Work work;
  bool torn = false;
};
Result<Loaded> load(const std::string& path);

}  // namespace clay::history
