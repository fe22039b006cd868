#pragma once
// Sizes of files and memory for them, before they are written.

#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"

#include <cstddef>
#include <cstdint>

namespace clay::solid::inline job {

/// The size of one file: exact for a binary STL, else an estimate.
[[nodiscard]] std::uint64_t usual_file_bytes(MeshFormat format, const ExportOptions& options,
                                             std::size_t triangles);

/// Estimated peak of the memory [bytes] for writing one file; 0 if it is streamed. The exact test
/// of thin margins is not counted.
[[nodiscard]] std::uint64_t mesh_memory(MeshFormat format, const ExportOptions& options,
                                        std::size_t triangles);

}  // namespace clay::solid::inline job
