#pragma once
// Reading whole files and publishing new ones: after any fault the old file or the
// new one is there, never a part.

#include "claystack/engine/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace clay {

/// The whole file; "-" is standard input. Refuses more than `max_bytes` before it allocates.
Result<std::string> read_file(const std::filesystem::path& path,
                              std::size_t max_bytes = std::size_t{1} << 30);

/// A file under construction: unnamed in the target's folder until `commit`, which syncs it,
/// gives it its name in one step and syncs the folder. Destroyed before that, it leaves no trace.
/// A symbolic link stays a link; the mode of an existing file is kept; the umask is respected.
/// Where the file system has no unnamed files, a temporary name stands in for one.
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

  Result<void> write(std::span<const std::byte> bytes);
  Result<void> write(std::string_view text) { return write(std::as_bytes(std::span(text))); }
  /// Fills `bytes` with what was written from `offset` on, before `commit`. Any number of threads
  /// may read at once. An error where the file ends before that, and where `rereadable()` is false.
  Result<void> read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
  /// Not so for pipes, devices and standard output.
  [[nodiscard]] bool rereadable() const noexcept { return !in_place_; }
  Result<void> commit();

 private:
  AtomicFile(std::filesystem::path target, int descriptor, std::filesystem::path temporary,
             bool in_place);
  Result<void> give_up(const std::string& what);
  void discard() noexcept;
  void begin_writeback() noexcept;

  std::filesystem::path target_;
  int descriptor_ = -1;              ///< -1 once committed or discarded
  std::filesystem::path temporary_;  ///< empty while the file has no name
  bool in_place_ = false;            ///< a pipe or a device
  std::uint64_t written_ = 0;
  std::uint64_t on_its_way_ = 0;  ///< so much of it is being written to the disk
};

/// So that the names in it are on the disk too.
Result<void> sync_folder(const std::filesystem::path& folder);

/// create, write, commit; "-" is standard output.
Result<void> publish(const std::filesystem::path& target, std::string_view bytes);

}  // namespace clay
