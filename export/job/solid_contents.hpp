#pragma once
#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"

namespace clay::solid::inline job {

/// Statements of files about a pot beside its surface: name, process, shrinkage, pot. Views of
/// `options`, which outlive it.
[[nodiscard]] FileContents solid_contents(const ExportOptions& options);

/// The picture that a 3MF carries; empty for other formats.
[[nodiscard]] std::string thumbnail_for(MeshFormat format, const ExportOptions& options);

}  // namespace clay::solid::inline job
