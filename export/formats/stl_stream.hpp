#pragma once
// Binary STL of a revolve, written and read again in blocks: memory grows with the profile, not
// with the triangles.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "core/content_hash.hpp"
#include "export/solid/revolve_layout.hpp"

#include <cstdint>

namespace clay::solid::inline formats {

struct StreamedFile {
  std::uint64_t bytes = 0;
  ContentHash hash;  ///< of the bytes handed to the store
};

/// The same bytes as `encode_stl_binary(revolve(...))`. Triangles are made while the block before
/// is written. Needs rule.triangles() < 2^32.
Result<StreamedFile> stream_stl(const RevolveLayout& rule, FileStore& store);

/// Reads the file again and holds the corners of every facet against the vertices that the rule
/// puts there, to the last bit. The error (kind `unsound`) names the first facet that differs.
Result<void> verify_stl(const RevolveLayout& rule, const FileStore& store);

}  // namespace clay::solid::inline formats
