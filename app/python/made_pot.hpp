#pragma once
// Pots for Python: played, stacked and imported, with the warnings of the command line.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"

#include <optional>
#include <string>
#include <vector>

namespace clay::python {

struct MadePot {
  Pot pot;
  std::vector<std::string> warnings;
};

/// Plays a session on a scene.
Result<MadePot> throw_pot(const std::string& scene_path, const std::string& session_path);

/// The keywords of claystack.import_pot.
struct ImportSettings {
  std::optional<double> height_mm;
  std::optional<double> wall_mm;  ///< of a drawing
};

/// A drawing, or a mesh that is nearly of revolution; the name of the file decides.
Result<MadePot> import_pot(const std::string& path, const ImportSettings& settings);

/// A pot of given rings, the lowest first; an inner radius of 0 is solid. Refuses rings by their
/// place in the stack, and numbers that no file of a pot may contain.
Result<Pot> stacked(double ring_height_mm, const std::vector<double>& outer_mm,
                    const std::vector<double>& inner_mm, double density_g_cm3);

/// Writes a .pot.json or a .pot.cbor.
Result<void> write_named_pot(const Pot& pot, const std::string& path);

}  // namespace clay::python
