#pragma once
// Makes a pot from a mesh that is nearly a solid of revolution.

#include "app/import/drawn_pot.hpp"
#include "app/import/mesh_axis.hpp"
#include "app/import/mesh_cuts.hpp"

#include <string>
#include <vector>

namespace clay::importing {

/// Something that is not of revolution, such as a handle or a spout.
struct MeshPart {
  double from_deg = 0.0, to_deg = 0.0;  ///< azimuths about the axis, counterclockwise from x
  double low_mm = 0.0, high_mm = 0.0;   ///< heights above the foot
  double off_mm = 0.0;                  ///< its largest distance from the revolved section
};

struct MeshPot {
  Pot pot;
  MeshAxis axis;             ///< through the middle of the foot
  double section_mm3 = 0.0;  ///< volume of the revolved section
  double scale = 1.0;        ///< of lengths in the mesh, from `MeshPotSettings::height_mm`
  /// Of the rings from the mesh in half-planes through the axis, in both directions, at azimuths
  /// without parts and without openings in the mesh.
  Deviation deviation;
  std::size_t measured = 0;  ///< half-planes of kMeshCuts; 0: `deviation` is not known
  double noise_mm = 0.0;     ///< of a scan whose faces were made level within it; 0: none were
  double off_mm = 0.0;       ///< largest deviation of the rings from the revolved section
  double aimed_mm = 0.0;     ///< limit for `off_mm` at which the rings aimed
  std::vector<MeshPart> parts;
};

/// Points farther than this from the revolved section, or a hundredth of the largest radius if that
/// is more, are not of revolution; in small pots, points farther than a tenth of it.
inline constexpr double kPartMm = 0.5;

struct MeshPotSettings {
  std::optional<double> height_mm;  ///< scales the mesh to this height
  DrawnPotSettings rings;           ///< without a wall
};

/// Fits the axis, revolves the mean of the section over all azimuths that agree with the middle
/// one, and makes rings of it. The end with the opening is up. If no rings fit the section, its
/// points are noisy: then faces that are level within the noise become level, and rings aim at
/// twice the noise if that is more than kDrawnDeviationMm. Refuses meshes of which more than half
/// of the azimuths are not of revolution, and everything that drawn_pot refuses.
Result<MeshPot> mesh_pot(solid::TriangleMesh mesh, const MeshPotSettings& settings,
                         const std::string& name);

}  // namespace clay::importing
