#pragma once
// Reading whole files and publishing new ones: after any fault the old file or the
// new one is there, never a part.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace clay {

/// The whole file; "-" is standard input. Refuses more than `max_bytes` before it allocates.
Result<std::string> read_file(const std::filesystem::path& path,
                              std::size_t max_bytes = std::size_t{1} << 30);

class TemporaryName;

/// A file under construction: unnamed in the target's folder until `commit`, which syncs it and
/// gives it its name in one step. Destroyed before that, it leaves no trace.
/// A symbolic link stays a link; the mode of an existing file is kept; the umask is respected.
/// Where the file system has no unnamed files, or /proc is not mounted, a temporary name stands in:
/// ".NAME.claystack-K". After a signal, `remove_temporary_files` removes such files; what a killed
/// program has left, the next `create` for the same target removes.
///
/// Pipes and devices, and "-" for standard output, cannot be replaced: what is written goes
/// straight to them. Errors name the file and the system's reason; after one, the file is
/// discarded and every further call fails.
class AtomicFile {
 public:
  static Result<AtomicFile> create(const std::filesystem::path& target);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// Not after `prepare`.
  Result<void> write(std::span<const std::byte> bytes);
  Result<void> write(std::string_view text) { return write(std::as_bytes(std::span(text))); }
  /// Fills `bytes` with what was written from `offset` on, before `commit`. Any number of threads
  /// may read at once. An error where the file ends before that, and where `rereadable()` is false.
  Result<void> read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
  /// Not so for pipes, devices and standard output.
  [[nodiscard]] bool rereadable() const noexcept { return !in_place_; }
  /// Puts what was written on the disk. `commit` does this where it has not been done; it is what
  /// takes time.
  Result<void> prepare();
  Result<void> commit();

 private:
  AtomicFile(std::filesystem::path target, int descriptor, bool in_place);
  Result<void> name();
  Result<void> keep_old();
  Result<void> replace();
  std::string put_back();
  static Result<void> replace_all(std::span<AtomicFile* const> files);
  friend Result<void> commit_all(std::span<AtomicFile* const> files);
  Result<void> give_up(const std::string& what);
  void discard() noexcept;
  void begin_writeback() noexcept;

  std::filesystem::path target_;
  int descriptor_ = -1;                       ///< -1 once committed or discarded
  std::unique_ptr<TemporaryName> temporary_;  ///< none while the file has no name
  std::unique_ptr<TemporaryName> old_;        ///< of what stood there, while files are replaced
  bool in_place_ = false;                     ///< a pipe or a device
  bool prepared_ = false;
  std::uint64_t written_ = 0;
  std::uint64_t on_its_way_ = 0;  ///< so much of it is being written to the disk
};

/// Publishes all of these files or none: where one cannot get its name, those that have theirs are
/// taken back. Then all are discarded, and the error says what could not be taken back. Pipes,
/// devices and standard output keep what has been written to them.
Result<void> commit_all(std::span<AtomicFile* const> files);

/// So that the names in it are on the disk too, where the system can do that: not for a folder that
/// may not be read, nor in every file system. What is published there counts as written either way.
void sync_folder(const std::filesystem::path& folder) noexcept;

/// For a handler of signals that ends the process (async-signal-safe): removes the temporary files
/// of all files under construction.
void remove_temporary_files() noexcept;

/// A file to write; no path: none. "-" is standard output.
struct NamedBytes {
  std::filesystem::path path;
  std::string bytes;
};

/// create, write, commit.
Result<void> publish(const std::filesystem::path& target, std::string_view bytes);
/// All of them or none, see `commit_all`.
Result<void> publish_all(std::span<const NamedBytes> files);

}  // namespace clay
