#pragma once
// The metadata block between the header of a Draco file and its mesh. Draco's reader allocates
// without bound by the counts in a file; this one only walks over the block, and Draco never reads
// it.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace clay::solid::inline formats {

inline constexpr std::size_t kDracoHeaderBytes = 11;

struct DracoMetadata {
  std::size_t end = 0;  ///< start of the mesh
  std::optional<DracoClaims> claims;
};

/// For a file with a complete header: empty if the header announces no metadata. A file with claims
/// is refused if its checksum does not match. Errors begin with `name`.
[[nodiscard]] Result<std::optional<DracoMetadata>> read_draco_metadata(std::string_view bytes,
                                                                       std::string_view name);

/// Adds metadata to a file without any.
[[nodiscard]] std::string with_claims(std::string_view plain, const DracoClaims& claims);

/// Removes the metadata of a file.
[[nodiscard]] std::string without_metadata(std::string_view bytes, const DracoMetadata& metadata);

}  // namespace clay::solid::inline formats
