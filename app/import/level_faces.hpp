#pragma once
// Floors, foot and rim of a scanned pot: faces so level that the noise of the scan is larger than
// their rise.

#include "app/import/half_section.hpp"

#include <vector>

namespace clay::importing {

/// A slab of the mean section, with the scatter and the clay of the azimuths at its heights.
struct ScannedSlab {
  Slab slab;
  double scatter_mm = 0.0;  ///< of the radii over the azimuths
  double clay_mm2 = 0.0;    ///< outer^2 - inner^2 of all clay of a middle azimuth
};

/// Where the radii scatter or change far more than the noise and the height, the half-planes cut
/// the hills and hollows of a nearly level face, so the radii there are not meaningful. Each such
/// range of heights becomes one level face, at the height that keeps the clay in it, if it is as
/// thin as the noise. Thicker ranges are real slopes and are kept. With a noise of 0 all ranges are
/// kept.
[[nodiscard]] std::vector<Slab> with_level_faces(const std::vector<ScannedSlab>& slabs,
                                                 double noise_mm);

}  // namespace clay::importing
