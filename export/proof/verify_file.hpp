#pragma once
// Encoded bytes held against the mesh they were made of.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/solid.hpp"

#include <string_view>

namespace clay::solid::inline proof {

/// What float32 may move a vertex [mm]: half an ulp of each coordinate, 2^-24 of it at most.
[[nodiscard]] double float_rounding_mm(const TriangleMesh& mesh) noexcept;

/// Reads the bytes back and returns the largest move of a vertex [mm]. An error (`unsound`) when
/// triangles are missing, the surface is no closed manifold any more or crosses itself, or a
/// vertex moved farther than allowed.
Result<double> verify_file(std::string_view bytes, MeshFormat format, const TriangleMesh& mesh,
                           double allowed_mm);

/// The whole file, checked as a stranger's would be. Unsound is an error.
Result<MeshReport> check_stored(const FileStore& store, std::uint64_t bytes, MeshFormat format);

}  // namespace clay::solid::inline proof
