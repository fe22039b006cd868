#pragma once
#include "claystack/engine/pose.hpp"
#include "claystack/engine/result.hpp"
#include "files/located_json.hpp"

#include <cstddef>
#include <vector>

namespace clay::files {

inline constexpr std::size_t kMaxBlockValues = 1000;

/// The poses of a block, behind those that there are; refuses times that are not later.
Result<void> append_block(const LocatedJson& line, std::vector<Pose>& poses);

}  // namespace clay::files
