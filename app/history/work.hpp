#pragma once
// The history of a work as a tree of strokes: undo, redo, branches, and any earlier moment. A
// stroke is a session on the pot before it, so every pot of the tree can be replayed to the same
// bits; pots are cached only to save time. Not thread-safe.

#include "app/history/journal.hpp"
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
  // Known after its pot has been on the wheel in this run of the program.
  std::optional<double> volume_mm3;
  std::optional<bool> changed;  ///< whether the clay changed; false: the tool stayed in free air
};

/// A stroke that begins. The sink is for the recorder; it keeps the poses and passes them to the
/// journal immediately. The journal's trouble() reports a full disk; the sink fails only if the
/// work would hold more than kMaxPoses.
struct Begun {
  PoseSink* sink;
  Wheel wheel;  ///< with the current pot; the poses are played on it
};

/// The result of adding a stroke.
struct Added {
  NodeId node = 0;          ///< the new current node; of several strokes the last
  std::size_t strokes = 0;  ///< 0: nothing was added, and redo is still possible
};

/// Whether a recording may become several strokes (split.hpp). A press of the mouse is one stroke;
/// an arm is held all the time.
enum class Recording { one_stroke, several_strokes };

/// Default limit on the memory for the pots of a work [bytes].
inline constexpr std::size_t kKeptPotBytes = std::size_t{256} << 20;

class Work {
 public:
  /// Begins with the scene's lump, or with a pot. Errors as for Wheel::build. A collapsed pot may
  /// be the root, but no stroke can follow it.
  static Result<Work> begin(const SceneSpec& scene);
  static Result<Work> begin(const SceneSpec& scene, const Pot& start);
  /// From a file. Checks that the root fits on the wheel; strokes are replayed on request. Pots
  /// that are not needed now stay in memory up to `kept_bytes`.
  static Result<Work> open(WorkRecord record, std::size_t kept_bytes = kKeptPotBytes);
  Work(Work&&) noexcept;
  Work& operator=(Work&&) noexcept;
  ~Work();

  // --- Strokes -------------------------------------------------------------------------------
  /// Begins a stroke on the current pot, until end_stroke. Errors as for Wheel::build, and a full
  /// work.
  Result<Begun> begin_stroke(const SceneSpec& scene);
  /// Call after the recorder has finished. Makes the stroke current. A stroke in which the tool
  /// touched nothing is not added. `thrown`: the pot that these poses, all of them and no others,
  /// made of the wheel of begin_stroke; it is kept without playing them again. Without it the poses
  /// are replayed. Errors as for Wheel::build.
  Result<Added> end_stroke(std::optional<Pot> thrown = std::nullopt,
                           Recording recording = Recording::several_strokes);
  /// Both in one call, for existing poses, which are replayed. Not split.
  Result<Added> add(const SceneSpec& scene, std::vector<Pose> poses);
  [[nodiscard]] bool in_stroke() const noexcept;

  // --- Navigation in the tree; false if there is no such node. Not during a stroke. --------------
  bool undo();
  bool redo();  ///< to the branch last taken
  void go_to(NodeId node);
  [[nodiscard]] bool can_undo() const noexcept;
  [[nodiscard]] bool can_redo() const noexcept;

  // --- Pots ------------------------------------------------------------------------------------
  /// The pot after the strokes up to `node`. From the cache, or replayed from the nearest cached
  /// one. Errors: a stroke of a file that cannot be thrown on the pot before it.
  Result<SharedPot> pot(NodeId node);
  Result<SharedPot> pot() { return pot(at()); }
  /// The pot during a stroke, after the poses up to `seconds`. Moving forward costs only the ticks
  /// between.
  Result<Pot> scrub(NodeId node, double seconds);
  /// Makes the pot shown by `scrub` the current one: a new stroke of the poses up to there, beside
  /// the original stroke, which stays. At a stroke's end it selects that stroke, and before all
  /// poses the pot before it; then nothing is added.
  Result<Added> branch(NodeId node, double seconds);
  /// Replays all remaining strokes, so that every view is complete.
  Result<void> throw_all();

  // --- The tree --------------------------------------------------------------------------------
  [[nodiscard]] NodeId at() const noexcept { return record_.at; }
  [[nodiscard]] std::size_t size() const noexcept { return record_.nodes.size(); }  ///< with root
  [[nodiscard]] NodeView view(NodeId node) const;
  [[nodiscard]] const WorkRecord& record() const noexcept { return record_; }

  // --- Files -----------------------------------------------------------------------------------
  /// Writes the whole tree atomically; then `unsaved` is false.
  Result<void> save(const std::string& path);
  [[nodiscard]] bool unsaved() const noexcept;
  /// From now on events also go to the journal, which already holds the earlier ones.
  void keep(std::unique_ptr<Journal> journal);
  [[nodiscard]] Journal* journal() noexcept { return journal_.get(); }
  [[nodiscard]] const Journal* journal() const noexcept { return journal_.get(); }

 private:
  struct Running;
  struct Scrubbing;
  Work(WorkRecord record, SharedPot root, std::size_t kept_bytes);

  [[nodiscard]] std::size_t room() const noexcept;  ///< poses that it can still hold
  std::size_t index_of(const SceneSpec& scene);
  Result<Added> finish_stroke(Recording recording, std::optional<Pot> thrown);
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

/// A work file, and whether its end was incomplete.
struct Loaded {
  Work work;
  bool torn = false;
};
Result<Loaded> load(const std::string& path);

}  // namespace clay::history
