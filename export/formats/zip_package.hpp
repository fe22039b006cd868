#pragma once
// Zip archives in memory, by libzip, with limits on the size of their unpacked contents.

#include "claystack/core/result.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

struct ZipEntry {
  std::string_view path;
  std::string_view bytes;
  bool compressed = true;  ///< false: stored, for contents that are compressed already
};

/// Equal entries give equal bytes: all dates are 1980-01-01. An error of kind `io`: no memory.
[[nodiscard]] Result<std::string> zipped(const std::vector<ZipEntry>& entries);

/// Lower case without a leading slash: part names of packages ignore case.
[[nodiscard]] std::string part_key(std::string_view path);

/// Reads an archive. Refuses more than kMaxZipEntries entries, two names that differ only in case,
/// and entries of more than kFreeZipBytes that unpack to more than kMaxZipRatio times their size.
class ZipPackage {
 public:
  static constexpr std::uint64_t kMaxZipEntries = 10'000;
  static constexpr std::uint64_t kFreeZipBytes = std::uint64_t{32} << 20, kMaxZipRatio = 100;

  /// `bytes` and `name` outlive it.
  static Result<ZipPackage> open(std::string_view bytes, std::string_view name);
  ZipPackage(ZipPackage&&) noexcept;
  ZipPackage& operator=(ZipPackage&&) noexcept;
  ~ZipPackage();

  /// Ignores case and a leading slash.
  [[nodiscard]] bool has(std::string_view path) const;
  /// The size of the entry after unpacking, as the archive states it; 0 if there is none.
  [[nodiscard]] std::uint64_t bytes_of(std::string_view path) const;
  /// Unpacks piece by piece; `take` gets each piece, and an error that it returns ends the reading.
  /// A checksum that does not match is an error.
  Result<void> read(std::string_view path,
                    const std::function<Result<void>(std::string_view)>& take) const;
  /// The whole entry, of at most `most_bytes`.
  [[nodiscard]] Result<std::string> read(std::string_view path, std::uint64_t most_bytes) const;

 private:
  struct State;
  explicit ZipPackage(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace clay::solid::inline formats
