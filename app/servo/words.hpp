#pragma once
// The servo's state in words for the potter.

#include "app/servo/live_view.hpp"

#include <string>
#include <string_view>

namespace clay::servo {

inline constexpr const char* kHomingAdvice =
    "pull the grip all the way out, then push it all the way in";

/// For scripts: "engaged".
[[nodiscard]] const char* name_of(falcon::GuardState state) noexcept;

/// What the potter should know or do now: "home it: ...", "throwing". `rearm_key` lets force be
/// earned again.
[[nodiscard]] std::string words_of(const LiveStatus& status, std::string_view rearm_key);

/// There is no force, and none comes back before somebody asks for it: CommandKind::rearm.
[[nodiscard]] bool waits_for_rearm(const LiveStatus& status) noexcept;

}  // namespace clay::servo
