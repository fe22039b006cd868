#pragma once
// The block of metadata between the header of a Draco file and its mesh. Draco's own reader of it
// allocates without bound on what a file states; ours walks over it, and Draco never sees it.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace clay::solid::inline formats {

inline constexpr std::size_t kDracoHeaderBytes = 11;

struct DracoMetadata {
  std::size_t end = 0;  ///< where the mesh begins
  std::optional<DracoClaims> claims;
};

/// Of a file with a whole header: nothing where the header announces no metadata. Claims come with
/// a checksum that holds, or the file is refused. Errors begin with `name`.
[[nodiscard]] Result<std::optional<DracoMetadata>> read_draco_metadata(std::string_view bytes,
                                                                       std::string_view name);

/// A file without metadata, with them.
[[nodiscard]] std::string with_claims(std::string_view plain, const DracoClaims& claims);

/// A file with metadata, without them.
[[nodiscard]] std::string without_metadata(std::string_view bytes, const DracoMetadata& metadata);

}  // namespace clay::solid::inline formats
