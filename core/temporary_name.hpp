#pragma once
// Names of temporary files, and who removes them: their owner, a handler of signals, or the next
// writer of the same file.

#include <filesystem>
#include <functional>
#include <utility>

namespace clay {

/// The name ".NAME.claystack-K" beside the file NAME, with a small K (long names are cut). It is
/// removed with this object, and by `remove_temporary_files` in a handler of signals.
///
/// A writer holds a lock (flock) on its file. The next writer of NAME removes files without a lock:
/// a killed process left them. On a file system without locks such a file stays.
class TemporaryName {
 public:
  /// Puts a file under the name: a result of -1 with `errno` EEXIST asks for another name.
  using Make = std::function<int(const char* name)>;

  TemporaryName() = default;
  TemporaryName(TemporaryName&& other) noexcept { *this = std::move(other); }
  TemporaryName& operator=(TemporaryName&& other) noexcept;
  ~TemporaryName() { remove(); }

  /// The result of `make` under the first free name; where that is -1, the name is empty, and
  /// `errno` says why.
  static std::pair<int, TemporaryName> take(const std::filesystem::path& target, const Make& make);

  [[nodiscard]] bool empty() const noexcept { return path_.empty(); }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// The file has lost this name, or is to keep it.
  void release() noexcept;
  void remove() noexcept;

 private:
  explicit TemporaryName(std::filesystem::path path);

  std::filesystem::path path_;
  int slot_ = -1;  ///< of the list that a handler of signals reads
};

/// Opens a new file under a temporary name for reading and writing, and locks it.
std::pair<int, TemporaryName> open_temporary(const std::filesystem::path& target);

/// A copy of a file; where that fails the name is empty, and `errno` says why.
TemporaryName copy_beside(const std::filesystem::path& path);

/// Removes what killed writers of this file have left.
void remove_litter(const std::filesystem::path& target);

}  // namespace clay
