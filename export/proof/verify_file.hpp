#pragma once
// Compares encoded bytes with the mesh they were made from.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/solid.hpp"

#include <string_view>

namespace clay::solid::inline proof {

/// Maximum displacement of a vertex by float32 [mm]: half an ulp per coordinate, at most 2^-24 of
/// it.
[[nodiscard]] double float_rounding_mm(const TriangleMesh& mesh) noexcept;

/// Reads the bytes back and returns the largest displacement of a vertex [mm]. An error (`unsound`)
/// if triangles are missing, the surface is no longer a closed manifold or intersects itself, or a
/// vertex moved farther than allowed.
Result<double> verify_file(std::string_view bytes, MeshFormat format, const TriangleMesh& mesh,
                           double allowed_mm);

/// Checks the whole file like a foreign one. An unsound file is an error.
Result<MeshReport> check_stored(const FileStore& store, std::uint64_t bytes, MeshFormat format);

}  // namespace clay::solid::inline proof
