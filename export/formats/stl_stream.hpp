#pragma once
// Writes and verifies the binary STL of a revolve in blocks: memory grows with the profile, not
// with the number of triangles.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "core/content_hash.hpp"
#include "export/solid/revolve_layout.hpp"

#include <cstdint>

namespace clay::solid::inline formats {

struct StreamedFile {
  std::uint64_t bytes = 0;
  ContentHash hash;  ///< of the bytes passed to the store
};

/// Writes the same bytes as `encode_stl_binary(revolve(...))`. Triangles are made while the
/// previous block is written. Requires rule.triangles() < 2^32.
Result<StreamedFile> stream_stl(const RevolveLayout& rule, FileStore& store);

/// Reads the file back and compares the corners of every facet with the vertices of the layout, to
/// the last bit. The error (kind `unsound`) names the first facet that differs.
Result<void> verify_stl(const RevolveLayout& rule, const FileStore& store);

}  // namespace clay::solid::inline formats
