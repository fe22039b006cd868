#pragma once
// What a 3MF carries beside its mesh: the pot and a picture of it.

#include "claystack/engine/clay.hpp"
#include "claystack/export/job.hpp"

namespace clay::cli {

/// If a 3MF is among the files, sets the pot file, exact, and the thumbnail. Without a renderer (a
/// build without one, or no OpenGL on this machine) there is no thumbnail.
void pack_pot(const Pot& pot, solid::ExportRequest& request);

}  // namespace clay::cli
