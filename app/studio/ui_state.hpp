#pragma once
// User interface state that is neither document nor settings: the open dialog, the banner, marks on
// the pot. Panels read it; apply() and update() change it.

#include "app/history/work.hpp"
#include "app/studio/action.hpp"
#include "app/studio/stored_works.hpp"
#include "app/studio/style.hpp"
#include "app/studio/target.hpp"

#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clay::studio {

class Document;

enum class Grade { note, warning, error };

struct Notice {
  Grade grade = Grade::note;
  std::string text;
  double until_s = 0.0;                      ///< on the host's clock; 0: until the user closes it
  std::string_view command;                  ///< a button runs it; empty: none
  bool (*holds)(const Document&) = nullptr;  ///< closed as soon as this is false
  /// Index in `Dialog` of the dialog in which it appeared; empty: it has just appeared.
  std::optional<std::size_t> dialog{};
};

/// Two banners at most: the answer to the latest action, and a state that lasts, such as that of an
/// arm. Neither hides the other.
class Notices {
 public:
  /// The latest answer replaces the one before.
  void show(Grade grade, std::string text, double until_s = 0.0, std::string_view command = {}) {
    answer_ = Notice{grade, std::move(text), until_s, command};
  }
  /// Closes the answer as soon as `holds` is false.
  void keep_answer_while(bool (*holds)(const Document&)) {
    if (answer_) answer_->holds = holds;
  }
  /// A state, until it is withdrawn. The most severe one is shown.
  void show_state(Grade grade, std::string text, double until_s = 0.0) {
    if (!state_ || grade >= state_->grade) state_ = Notice{grade, std::move(text), until_s, {}};
  }
  void close_answer() { answer_.reset(); }
  void close_state() { state_.reset(); }
  /// Closes the notice of a state that has ended.
  void withdraw_state(const std::string& text) {
    if (state_ && state_->text == text) state_.reset();
  }
  void expire(double now_s, const Document& document) {
    for (std::optional<Notice>* notice : {&answer_, &state_}) {
      if (!*notice) continue;
      const bool late = (*notice)->until_s > 0.0 && now_s > (*notice)->until_s;
      if (late || ((*notice)->holds != nullptr && !(*notice)->holds(document))) notice->reset();
    }
  }
  /// New notices belong to the open dialog.
  void appear_in(std::size_t dialog) {
    for (std::optional<Notice>* notice : {&answer_, &state_})
      if (*notice && !(*notice)->dialog) (*notice)->dialog = dialog;
  }
  [[nodiscard]] const std::optional<Notice>& answer() const noexcept { return answer_; }
  [[nodiscard]] const std::optional<Notice>& state() const noexcept { return state_; }
  /// The answer, or the state if there is none.
  [[nodiscard]] const std::optional<Notice>& shown() const noexcept {
    return answer_ ? answer_ : state_;
  }

 private:
  std::optional<Notice> answer_, state_;
};

// --- Dialogs: one alternative each, with its state. ----------------------------------------------
struct NoDialog {};
struct GalleryDialog {};
struct ShortcutsDialog {};
struct SettingsDialog {};
/// Asks whether to save before `next` replaces the work.
struct UnsavedDialog {
  Action next;
  bool saving = false;                 ///< the user chose to save; `next` follows
  std::optional<ImportCard> import{};  ///< the dialog that `next` came from, for Cancel
};
struct OpenDialog {
  std::string path;
  bool target = false;  ///< the file becomes the target profile
};
/// `next`: the action to run after saving.
struct SaveDialog {
  std::string path;
  std::optional<Action> next;
};
/// Asks whether to replace files.
struct ReplaceDialog {
  std::string question;
  std::optional<SaveDialog> save;  ///< the save that would replace a file; empty: the export
  bool picture = false;            ///< the export is that of a picture
};
/// Asks whether to delete a work: an unsaved one that a crash has left, or a file.
struct DiscardDialog {
  std::string work;
  Action confirmed;  ///< deletes it
  [[nodiscard]] bool is_file() const noexcept {
    return std::holds_alternative<DeleteWork>(confirmed);
  }
};
/// The works in the folder of saved files.
struct WorksDialog {
  std::filesystem::path folder;
  std::vector<StoredWork> works;
};
struct ExportDialog {
  std::optional<ExportChoices> previewed{};  ///< choices of the current preview
  history::SharedPot pot = nullptr;          ///< and its pot
};
/// A picture or a turntable of the pot.
struct PictureDialog {};
/// A drawing, its import settings, and the resulting pot.
using ImportDialog = ImportCard;

using Dialog = std::variant<NoDialog, GalleryDialog, ShortcutsDialog, UnsavedDialog, OpenDialog,
                            SaveDialog, ExportDialog, ImportDialog, SettingsDialog, ReplaceDialog,
                            PictureDialog, DiscardDialog, WorksDialog>;

/// Choices and results of an export. They outlive the dialog, because an export continues after it
/// is closed.
struct ExportState {
  ExportChoices choices;
  std::optional<ExportFigures> preview{};
  std::string problem{};               ///< reason why there is no preview, or no file
  bool refused = false;                ///< the preview has failed, and so would the export
  bool of_other_work = false;          ///< the files in writing: another work is on the wheel now
  std::vector<std::string> written{};  ///< files of the last export
  std::string result{};                ///< outcome as text
  Grade grade = Grade::note;           ///< of the outcome; a warning: a limit failed
};

/// The same of a picture.
struct PictureState {
  PictureFile file;
  std::string written;  ///< path of the last picture
  std::string problem, result;
  bool of_other_work = false;  ///< as in ExportState
};

/// The last report about an arm, in the banner and the log.
struct ArmReport {
  std::string shown;      ///< text of its banner
  bool requests = false;  ///< the banner asks the user to do something
  std::string guard;      ///< last reported state of the force guard
};

/// The banner about a journal that could not be written.
struct JournalWatch {
  std::string shown;     ///< its text; empty: the journal is written
  double retry_s = 0.0;  ///< time of the next attempt, on the host's clock
};

/// Beside the view: the panels for a potter, and a drawer with the rest, which is closed at first.
enum class Column { context, diagnostics };

struct UiState {
  Dialog dialog = GalleryDialog{};
  Notices notices;
  ExportState exporting;
  PictureState pictures;
  ArmReport arm;
  JournalWatch journal;
  std::vector<Mark> marks;    ///< marks on the pot `marked`
  history::SharedPot marked;  ///< pot of the last export or preview
  SharedTarget target;        ///< null: none
  /// Outlines for the timeline, by node of the work, of few rows.
  std::map<history::NodeId, render::PotView> thumbs;
  bool thumbs_missing = false;  ///< more will be made
  std::string reveal;           ///< id of a panel to scroll to in this frame
  Fonts fonts;
  std::optional<std::size_t> open_menu;  ///< index of a menu to open in this frame
  bool restyle = true;                   ///< theme or scale has changed
  bool context_shown = true;             ///< the column of the context has room in this frame
  std::optional<Column> keys_in;         ///< column with the keyboard focus; empty: the view
  bool focus_column = false;             ///< the focus moves there in this frame

  template <class D>
  [[nodiscard]] bool shows() const noexcept {
    return std::holds_alternative<D>(dialog);
  }
};

}  // namespace clay::studio
