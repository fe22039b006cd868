#pragma once
// The document of the window: a work with its file, the pot it shows, and whether it is saved.

#include "app/history/work.hpp"
#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace clay::studio {

/// A moment in the middle of a stroke.
struct Moment {
  history::NodeId node = 0;
  double seconds = 0.0;
};

/// A scene in proportion to a pot that comes without one.
[[nodiscard]] SceneSpec scene_for(const Pot& pot, const std::string& name);

/// For one thread. Functions that read the work or its pot require has_work().
class Document {
 public:
  /// From now on every work has a journal, so that a crash loses nothing.
  void keep_journals() noexcept { journals_ = true; }

  // --- A new work replaces the old one, and has no file.
  // ------------------------------------------
  /// With the scene's lump, or with a pot.
  Result<void> begin(const SceneSpec& scene);
  Result<void> begin(const SceneSpec& scene, const Pot& pot);
  /// A recovered work keeps its journal.
  void begin(history::Work work);
  /// What failed after a work had begun: its journal, or its pot. Reported once.
  [[nodiscard]] std::optional<Error> take_problem() { return std::exchange(problem_, {}); }
  /// The end of the program, as the user chose it: the journal is not needed any more.
  void close();

  // --- Files. The ending of a name decides the kind.
  // ------------------------------------------------
  /// What was unusual about a file that was read; empty: nothing.
  using Remark = std::string;
  /// Reads a scene, a pot or a work. On an error the document is unchanged.
  Result<Remark> open(const std::filesystem::path& path);
  /// Writes .work, .pot.json or .pot.cbor. Only a .work saves the document and becomes its file.
  Result<void> save(const std::filesystem::path& path);
  /// Of the work; empty: it has none yet.
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  /// File name, or the name of the scene.
  [[nodiscard]] std::string name() const;
  [[nodiscard]] bool unsaved() const noexcept {
    return work_ && work_->unsaved() && !changes_discarded_;
  }
  /// The user does not want the unsaved changes: the journal ends with the work. The next stroke
  /// makes the document unsaved again.
  void discard_changes() noexcept { changes_discarded_ = true; }
  void keep_changes() noexcept { changes_discarded_ = false; }

  // --- The work and its pot.
  // ------------------------------------------------------------------------
  [[nodiscard]] bool has_work() const noexcept { return work_.has_value(); }
  [[nodiscard]] const history::Work& work() const noexcept { return *work_; }
  [[nodiscard]] const Pot& pot() const noexcept { return *pot_; }
  /// Null before there is a work. During a stroke: the pot at its start.
  [[nodiscard]] const history::SharedPot& shared_pot() const noexcept { return pot_; }
  /// What is on screen at rest: the current pot, or that of `moment`.
  [[nodiscard]] const render::PotView& view() const noexcept { return view_; }
  /// Shows the fallen part of the pot at this place.
  void show_fall(const render::FallenView& fallen) { view_.fallen = fallen; }

  // --- The next stroke.
  // -----------------------------------------------------------------------------
  [[nodiscard]] const SceneSpec& scene() const noexcept { return scene_; }
  void set_tool(const ToolSpec& tool, double removal_rate_per_s);
  /// Stiffness of the contact [N/mm^2].
  void set_stiffness(double n_per_mm2);
  /// Stiffness of the contact [N/mm^2]; 0 in a scene without force.
  [[nodiscard]] double stiffness() const noexcept;
  /// Removal rate that the scene had when the work began [1/s].
  [[nodiscard]] double nominal_rate_per_s() const noexcept { return nominal_rate_per_s_; }

  /// A stroke begins on the current pot.
  Result<history::Begun> begin_stroke(const SceneSpec& scene);
  /// The recorder has finished. `thrown`: the pot that exactly the recorded poses left on the
  /// wheel; empty: they are replayed. Shows the new pot.
  Result<void> end_stroke(std::optional<Pot> thrown);

  // --- The tree of strokes. Not during a stroke.
  // ----------------------------------------------------
  [[nodiscard]] bool can_undo() const noexcept { return work_ && work_->can_undo(); }
  [[nodiscard]] bool can_redo() const noexcept { return work_ && work_->can_redo(); }
  Result<void> undo();
  Result<void> redo();
  Result<void> go_to(history::NodeId node);
  /// The nearest ancestor that has a sibling gives its next sibling; empty: there is no branch.
  [[nodiscard]] std::optional<history::NodeId> other_branch() const;
  /// Shows the pot in the middle of a stroke until another pot is shown. The work stays where it
  /// is.
  Result<void> scrub(history::NodeId node, double seconds);
  [[nodiscard]] bool scrubbing() const noexcept { return moment_.has_value(); }
  [[nodiscard]] const std::optional<Moment>& moment() const noexcept { return moment_; }
  /// Ends `scrub` and shows the current pot.
  Result<void> show_present();
  /// The shown moment becomes current, as a branch (history::Work::branch).
  Result<void> branch_here();

 private:
  void replace(const SceneSpec& scene, history::Work work);
  Result<Remark> open_work(const std::string& name);
  Result<void> show_pot();

  bool journals_ = false;
  bool changes_discarded_ = false;
  std::filesystem::path file_;
  SceneSpec scene_;
  double nominal_rate_per_s_ = 20.0;
  std::optional<history::Work> work_;
  history::SharedPot pot_;
  std::optional<Moment> moment_;
  render::PotView view_;
  std::optional<Error> problem_;
};

}  // namespace clay::studio
