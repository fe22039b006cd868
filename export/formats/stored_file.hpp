#pragma once
// Reads files back from a store.

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

/// The format's name for messages.
[[nodiscard]] inline std::string as_written(MeshFormat format) {
  return std::string(name_of(format)) + " as written";
}

/// Writes in parts, so that a cancelled job does not wait for the disk.
Result<void> write_in_parts(FileStore& store, const std::string& bytes);

/// The bytes in the store; if that cannot be read back, the bytes passed to it.
Result<std::string> read_back(const FileStore& store, const std::string& written);

/// An error if the bytes read back are not those written.
Result<void> expect_stored(const FileStore& store, const std::string& written, MeshFormat format);

/// The first `bytes` bytes of the store, read back.
Result<std::string> read_whole(const FileStore& store, std::uint64_t bytes);

}  // namespace clay::solid::inline formats
