#pragma once
// Names of temporary files and their removal: by the owner, by a signal handler, or by the next
// writer of the same file.

#include <filesystem>
#include <functional>
#include <utility>

namespace clay {

/// The name ".NAME.claystack-K" beside the file NAME, with a small K (long names are cut). It is
/// removed with this object, and by `remove_temporary_files` in a signal handler.
///
/// A writer holds a lock (flock) on its file. The next writer of NAME removes files without a lock:
/// a killed process left them. On a file system without locks such a file stays.
class TemporaryName {
 public:
  /// Creates a file under the name; returning -1 with `errno` EEXIST requests another name.
  using Make = std::function<int(const char* name)>;

  TemporaryName() = default;
  TemporaryName(TemporaryName&& other) noexcept { *this = std::move(other); }
  TemporaryName& operator=(TemporaryName&& other) noexcept;
  ~TemporaryName() { remove(); }

  /// The result of `make` under the first free name; if that is -1, the name is empty and `errno`
  /// holds the reason.
  static std::pair<int, TemporaryName> take(const std::filesystem::path& target, const Make& make);

  [[nodiscard]] bool empty() const noexcept { return path_.empty(); }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// Locks the file, for one that no writer has open. Where that fails, the name stays unlocked.
  void lock() noexcept;
  /// Call when the file has lost this name, or will keep it.
  void release() noexcept;
  void remove() noexcept;

 private:
  explicit TemporaryName(std::filesystem::path path);

  std::filesystem::path path_;
  int slot_ = -1;    ///< index in the list that the signal handler reads
  int locked_ = -1;  ///< descriptor of the locked file
};

/// Opens a new file under a temporary name for reading and writing, and locks it.
std::pair<int, TemporaryName> open_temporary(const std::filesystem::path& target);

/// Copies a file; on failure the name is empty and `errno` holds the reason.
TemporaryName copy_beside(const std::filesystem::path& path);

/// Removes temporary files left by killed writers of this file.
void remove_litter(const std::filesystem::path& target);

}  // namespace clay
