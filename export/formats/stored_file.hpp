#pragma once
// Files as a store holds them, read again.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace clay::solid::inline formats {

[[nodiscard]] inline std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

[[nodiscard]] inline std::string stage_name(std::string_view verb, MeshFormat format) {
  return std::string(verb).append("_").append(name_of(format));
}

/// For messages.
[[nodiscard]] inline std::string as_written(MeshFormat format) {
  return std::string(name_of(format)) + " as written";
}

/// Part by part, so that a job that is given up need not wait for the disk.
Result<void> write_in_parts(FileStore& store, const std::string& bytes);

/// What the store holds; where that is gone, what was handed to it.
Result<std::string> read_again(const FileStore& store, const std::string& written);

/// The first `bytes` of what was written, read again.
Result<std::string> read_whole(const FileStore& store, std::uint64_t bytes);

}  // namespace clay::solid::inline formats
