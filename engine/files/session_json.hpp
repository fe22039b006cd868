#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/tool.hpp"
#include "core/json/located_json.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace clay::files {

inline constexpr std::size_t kMaxBlockValues = 1000;

/// How many poses a line says it holds, as session_block writes it; 0 for any other line. To make
/// room for them: only reading the line tells whether it is true.
std::size_t announced_poses(std::string_view line);
/// An error where the blocks of a file announce more than kMaxPoses; else their number.
Result<std::size_t> count_announced(std::string_view text, std::string_view name);

/// The poses of a block, behind those that there are; refuses times that are not later, and more
/// than `room` poses.
Result<void> append_block(const LocatedJson& line, std::vector<Pose>& poses, std::size_t room);

}  // namespace clay::files
