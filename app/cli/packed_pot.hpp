#pragma once
// What a 3MF carries beside its mesh: the pot and a picture of it; and the picture for a report.

#include "claystack/engine/clay.hpp"
#include "claystack/export/job.hpp"

#include <optional>
#include <string>

namespace clay::cli {

/// A picture of the pot for a page, as PNG; empty without a renderer.
[[nodiscard]] std::string picture_of(const Pot& pot);

/// If a 3MF is among the files, sets the pot file, exact, and how to draw the thumbnail, which a
/// build without the window lacks. `thumbnail` keeps the picture of this pot for the next call; it
/// and the pot outlive the request.
void pack_pot(const Pot& pot, solid::ExportRequest& request, std::optional<std::string>& thumbnail);

}  // namespace clay::cli
