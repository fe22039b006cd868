#pragma once
// Parts of a 3MF beside its mesh: the pot and a picture of it; and the picture for a report.

#include "claystack/engine/clay.hpp"
#include "claystack/export/job.hpp"

#include <future>
#include <string>

namespace clay::cli {

/// A picture of the pot for a page, as PNG; empty without a renderer.
[[nodiscard]] std::string picture_of(const Pot& pot);

/// A PNG that another thread may still be drawing.
using Thumbnail = std::shared_future<std::string>;

/// If a 3MF is among the files, sets the pot file, exact, and begins to draw the thumbnail, which a
/// build without the window lacks: the export waits for it where it packs the 3MF. `thumbnail`
/// keeps the picture of this pot for the next call. It outlives the request, and the pot outlives
/// it.
void pack_pot(const Pot& pot, solid::ExportRequest& request, Thumbnail& thumbnail);

}  // namespace clay::cli
