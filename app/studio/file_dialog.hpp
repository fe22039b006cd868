#pragma once
// The desktop's own dialog for files, through zenity or kdialog where one is installed; the window
// goes on meanwhile.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace clay::studio {

class FileDialog {
 public:
  enum class Kind : std::uint8_t { open, save, folder, process };

  FileDialog() = default;
  ~FileDialog();
  FileDialog(const FileDialog&) = delete;
  FileDialog& operator=(const FileDialog&) = delete;

  /// False where neither program is there, or one dialog is open already.
  bool begin(Kind kind, const std::filesystem::path& start);
  [[nodiscard]] bool open() const noexcept { return child_ > 0; }
  [[nodiscard]] Kind kind() const noexcept { return kind_; }
  /// What was chosen, once the dialog has closed; empty: nothing was. Does not wait.
  [[nodiscard]] std::optional<std::string> take();

 private:
  Kind kind_ = Kind::open;
  int child_ = 0;  // its process
  int pipe_ = -1;  // what it prints
  std::string chosen_;
};

/// Shows a folder in the desktop's file manager (xdg-open); false where that is not installed.
bool show_folder(const std::filesystem::path& folder);

}  // namespace clay::studio
