#pragma once
// The document of the window: a work, its file, the pot on screen, and whether it is saved.

#include "app/history/file_lock.hpp"
#include "app/history/work.hpp"
#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace clay::studio {

/// A moment in the middle of a stroke.
struct Moment {
  history::NodeId node = 0;
  double seconds = 0.0;
};

/// Wheel speed at which clay without rules yields at the rate of its scene.
inline constexpr double kNominalRpm = 120.0;

/// Identifies the version of a file that was read or written.
struct FileStamp {
  std::int64_t changed_ns = 0;
  std::uint64_t bytes = 0, inode = 0;  ///< a file that was replaced has another inode
  /// Empty: there is no such file.
  [[nodiscard]] static std::optional<FileStamp> of(const std::filesystem::path& path);
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// Not thread-safe. Functions that read the work or its pot require has_work().
class Document {
 public:
  /// Keeps a journal of every work from now on, so that a crash loses no stroke.
  void keep_journals() noexcept { journals_ = true; }

  // --- A new work replaces the old one, and has no file. -----------------------------------------
  /// Begins with the lump of the scene, or with a pot.
  Result<void> begin(const SceneSpec& scene);
  Result<void> begin(const SceneSpec& scene, const Pot& pot);
  /// Continues a recovered work with its journal.
  void begin(history::Work work);
  /// Reason why a crash would lose strokes; empty: it would lose none, or no journals are kept.
  [[nodiscard]] std::optional<Error> journal_problem() const;
  /// Tries to write the whole work into a new journal. Not during a stroke.
  void renew_journal();
  /// The error of the pot after a work has begun. Returned once.
  [[nodiscard]] std::optional<Error> take_problem() { return std::exchange(problem_, {}); }
  /// The user ends the program: deletes the journal, which is not needed any more.
  void close();

  // --- Files. The extension selects the kind. ----------------------------------------------------
  /// A remark about a file that was read, such as a cut-off last line or its use by another window;
  /// empty: none.
  using Remark = std::string;
  /// Contents of a file of a scene, a pot or a work.
  struct Opened {
    SceneSpec scene;
    history::Work work;
    std::filesystem::path file = {};  ///< of a work
    bool torn = false;                ///< the last line was cut off
  };
  static Result<Opened> read(const std::filesystem::path& path);
  Remark begin(Opened opened);
  /// Reads the file and begins with its contents. On an error the document is unchanged.
  Result<Remark> open(const std::filesystem::path& path);
  /// Writes .work, .pot.json or .pot.cbor. Only a .work saves the document and becomes its file.
  Result<void> save(const std::filesystem::path& path);
  /// Whether a file of that name exists that this document has neither read nor written last:
  /// another one, or its own if another program has changed it or has it open.
  [[nodiscard]] bool replaces_other(const std::filesystem::path& path) const;
  /// Whether the path is that of the document's file, in any spelling.
  [[nodiscard]] bool has_file(const std::filesystem::path& path) const;
  /// Whether another window has the file open.
  [[nodiscard]] bool file_in_use() const noexcept { return lock_ && lock_->in_use(); }
  /// The file of the work; empty: none yet.
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  /// The name of the file, or of the scene.
  [[nodiscard]] std::string name() const;
  /// The same without the kind of the file; "pot" if there is no name.
  [[nodiscard]] std::string title() const;
  [[nodiscard]] bool unsaved() const noexcept {
    return work_ && work_->unsaved() && !changes_discarded_;
  }
  /// The pot on the wheel is in a pot file, which keeps no strokes.
  [[nodiscard]] bool pot_saved() const noexcept { return work_ && pot_saved_at_ == work_->at(); }
  /// The user discards the unsaved changes: the journal is deleted with the work. The next stroke
  /// makes the document unsaved again.
  void discard_changes() noexcept { changes_discarded_ = true; }
  void keep_changes() noexcept { changes_discarded_ = false; }

  // --- The work and its pot. ---------------------------------------------------------------------
  [[nodiscard]] bool has_work() const noexcept { return work_.has_value(); }
  [[nodiscard]] const history::Work& work() const noexcept { return *work_; }
  [[nodiscard]] const Pot& pot() const noexcept { return *pot_; }
  /// The clay has fallen: no stroke is possible on it.
  [[nodiscard]] bool fallen() const noexcept { return work_ && pot_->collapse; }
  /// Null before there is a work. During a stroke: the pot at its start.
  [[nodiscard]] const history::SharedPot& shared_pot() const noexcept { return pot_; }
  /// The pot on screen between strokes: the current pot, or the pot at `moment`.
  [[nodiscard]] const history::SharedPot& shown_pot() const noexcept {
    return moment_ ? moment_pot_ : pot_;
  }
  /// `shown_pot` as the view draws it.
  [[nodiscard]] const render::PotView& view() const noexcept { return view_; }
  /// Moves the fallen part of the pot on screen to this place.
  void show_fall(const render::FallenView& fallen) { view_.fallen = fallen; }

  // --- The next stroke. --------------------------------------------------------------------------
  [[nodiscard]] const SceneSpec& scene() const noexcept { return scene_; }
  /// Speed of the wheel when the work began: that of its clay rules, or kNominalRpm.
  [[nodiscard]] double wheel_rpm() const noexcept { return wheel_rpm_; }
  /// The scene of a stroke with this tool. The wheel's speed scales the removal rate, which the
  /// work has at `wheel_rpm`, and is that of the clay rules.
  [[nodiscard]] SceneSpec scene_with(const ToolSpec& tool, double wheel_rpm) const;
  void set_scene(const SceneSpec& scene) { scene_ = scene; }
  /// Stiffness of the contact [N/mm^2].
  void set_stiffness(double n_per_mm2);
  /// Stiffness of the contact [N/mm^2]; 0 in a scene without force.
  [[nodiscard]] double stiffness() const noexcept;

  /// Begins a stroke on the current pot. The recorder writes to the sink.
  Result<history::Begun> begin_stroke(const SceneSpec& scene);
  /// Call after the recorder has finished. `thrown`: the pot that exactly the recorded poses left
  /// on the wheel; empty: they are replayed. Shows the new pot.
  Result<void> end_stroke(std::optional<Pot> thrown, history::Recording recording);

  // --- The tree of strokes. Not during a stroke. -------------------------------------------------
  [[nodiscard]] bool can_undo() const noexcept { return work_ && work_->can_undo(); }
  [[nodiscard]] bool can_redo() const noexcept { return work_ && work_->can_redo(); }
  Result<void> undo();
  Result<void> redo();
  Result<void> go_to(history::NodeId node);
  /// The pot after a stroke; replays strokes if it is not in memory.
  Result<history::SharedPot> pot_at(history::NodeId node) { return work_->pot(node); }
  /// The next sibling of the nearest ancestor that has siblings; empty: there is no branch.
  [[nodiscard]] std::optional<history::NodeId> other_branch() const;
  /// Shows the pot at a moment in the middle of a stroke until another pot is shown. The work does
  /// not change.
  Result<void> scrub(history::NodeId node, double seconds);
  [[nodiscard]] bool scrubbing() const noexcept { return moment_.has_value(); }
  [[nodiscard]] const std::optional<Moment>& moment() const noexcept { return moment_; }
  /// Ends `scrub` and shows the current pot.
  Result<void> show_present();
  /// Makes the shown moment current, as a branch (history::Work::branch).
  Result<void> branch_here();

 private:
  void replace(const SceneSpec& scene, history::Work work);
  void keep_file(const std::filesystem::path& path);
  Result<void> show_pot();

  bool journals_ = false;
  bool changes_discarded_ = false;
  std::optional<history::NodeId> pot_saved_at_;  ///< the node whose pot is in a pot file
  std::filesystem::path file_;
  FileStamp stamp_;                          ///< of file_, when it was read or written
  std::unique_ptr<history::FileLock> lock_;  ///< on file_, so that other windows see its use
  SceneSpec scene_;
  double rate_per_s_ = 20.0;  ///< of the scene, at wheel_rpm_
  double wheel_rpm_ = kNominalRpm;
  std::optional<history::Work> work_;
  history::SharedPot pot_;
  std::optional<Moment> moment_;
  history::SharedPot moment_pot_;
  render::PotView view_;
  std::optional<Error> problem_, journal_error_;
};

}  // namespace clay::studio
