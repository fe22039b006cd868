#pragma once
// Reads whole files and publishes new ones atomically: after any fault either the old or the new
// file exists, never a part of one.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace clay {

/// Reads the whole file; "-" is standard input. Refuses files above `max_bytes` before allocating.
Result<std::string> read_file(const std::filesystem::path& path,
                              std::size_t max_bytes = std::size_t{1} << 30);

class TemporaryName;

/// A file under construction: unnamed in the target's folder until `commit`, which syncs it, gives
/// it the temporary name ".NAME.claystack-K" and renames it to the target. Where the file system
/// has no unnamed files, or /proc is not mounted, it has this name from the beginning. If it is
/// destroyed before `commit`, nothing remains. After a signal, `remove_temporary_files` removes
/// files with a temporary name; the next `create` for the same target removes those of a killed
/// program. A symbolic link stays a link; the mode of an existing file is kept; the umask is
/// respected.
///
/// Pipes, devices and standard output ("-") cannot be replaced: bytes are written to them directly.
/// Errors name the file and the system's reason; after an error the file is discarded and every
/// further call fails.
class AtomicFile {
 public:
  static Result<AtomicFile> create(const std::filesystem::path& target);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// Not allowed after `prepare`.
  Result<void> write(std::span<const std::byte> bytes);
  Result<void> write(std::string_view text) { return write(std::as_bytes(std::span(text))); }
  /// Fills `bytes` with the bytes written from `offset` on; only before `commit`. Any number of
  /// threads may read at once. Fails at the end of the file, and where `rereadable()` is false.
  Result<void> read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
  /// False for pipes, devices and standard output.
  [[nodiscard]] bool rereadable() const noexcept { return !in_place_; }
  /// Syncs the written bytes to disk, which is the slow part. `commit` calls it if needed.
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
  std::unique_ptr<TemporaryName> temporary_;  ///< null while the file has no name
  std::unique_ptr<TemporaryName> old_;  ///< of the previous file, while several files are replaced
  bool in_place_ = false;               ///< a pipe or a device
  bool prepared_ = false;
  std::uint64_t written_ = 0;
  std::uint64_t on_its_way_ = 0;  ///< the bytes whose writeback has begun
};

/// Publishes all files or none: if one cannot be named, the files already named are restored. Then
/// all are discarded, and the error lists the files that could not be restored. Pipes, devices and
/// standard output keep the bytes written to them.
Result<void> commit_all(std::span<AtomicFile* const> files);

/// Syncs the names in `folder` to disk, where the system supports it: not for a folder without read
/// permission, nor on every file system. A published file counts as written in either case.
void sync_folder(const std::filesystem::path& folder) noexcept;

/// For a signal handler that ends the process (async-signal-safe): removes the temporary files of
/// all files under construction.
void remove_temporary_files() noexcept;

/// Calls create, write, commit.
Result<void> publish(const std::filesystem::path& target, std::string_view bytes);

}  // namespace clay
