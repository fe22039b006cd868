#pragma once
// The desktop's file dialog, through zenity or kdialog if one is installed. The window keeps
// running meanwhile.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace clay::studio {

class FileDialog {
 public:
  enum class Kind : std::uint8_t { open, save, folder, process, target };

  FileDialog() = default;
  ~FileDialog();
  FileDialog(const FileDialog&) = delete;
  FileDialog& operator=(const FileDialog&) = delete;

  /// False if neither program is installed, or if a dialog is open already.
  bool begin(Kind kind, const std::filesystem::path& start);
  [[nodiscard]] bool open() const noexcept { return child_ > 0; }
  [[nodiscard]] Kind kind() const noexcept { return kind_; }
  /// The chosen file, once the dialog has closed; empty: none was chosen. Does not wait.
  [[nodiscard]] std::optional<std::string> take();

 private:
  Kind kind_ = Kind::open;
  int child_ = 0;  // process of the dialog
  int pipe_ = -1;  // its output
  std::string chosen_;
};

/// Shows a folder in the desktop's file manager (xdg-open). False if that is not installed.
bool show_folder(const std::filesystem::path& folder);

}  // namespace clay::studio
