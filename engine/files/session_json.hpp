#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/tool.hpp"
#include "core/json/located_json.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace clay::files {

inline constexpr std::size_t kMaxBlockValues = 1000;

/// The number of poses that a line announces, in the form of session_block; 0 for any other line.
/// For reserving memory only: reading the line verifies it.
std::size_t announced_poses(std::string_view line);
/// The number of announced poses of a file; an error above kMaxPoses.
Result<std::size_t> count_announced(std::string_view text, std::string_view name);

/// Appends the poses of a block; refuses times that do not increase, and more than `room` poses.
Result<void> append_block(const LocatedJson& line, std::vector<Pose>& poses, std::size_t room);

}  // namespace clay::files
