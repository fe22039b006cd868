#pragma once
#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"

namespace clay::solid::inline job {

/// What files say about a pot beside its surface: name, process, shrinkage, pot, picture. Views of
/// `options`, which outlive it.
[[nodiscard]] FileContents solid_contents(const ExportOptions& options);

}  // namespace clay::solid::inline job
