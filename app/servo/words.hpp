#pragma once
// The servo's state as text for users.

#include "app/servo/live_view.hpp"

#include <string>
#include <string_view>

namespace clay::servo {

inline constexpr const char* kHomingAdvice =
    "pull the grip all the way out, then push it all the way in";

/// For scripts, such as "engaged".
[[nodiscard]] const char* name_of(falcon::GuardState state) noexcept;

/// The current state or the next action of the user: "home it: ...", "throwing". `rearm_key`: name
/// of the key that restores force.
[[nodiscard]] std::string words_of(const LiveStatus& status, std::string_view rearm_key);

/// True if the force is zero until CommandKind::rearm.
[[nodiscard]] bool waits_for_rearm(const LiveStatus& status) noexcept;

}  // namespace clay::servo
