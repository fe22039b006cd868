#pragma once
// Whether the program can start threads. In a web page it cannot: work that natively has its own
// thread is done by the caller, between frames or in a worker of the page.

#include "claystack/core/result.hpp"

#include <future>
#include <string>
#include <string_view>
#include <system_error>

namespace clay {

#ifdef __EMSCRIPTEN__
inline constexpr bool kThreads = false;
#else
inline constexpr bool kThreads = true;
#endif

/// For std::async: on another thread if that is worth it and the system has one, otherwise when
/// waited for.
[[nodiscard]] constexpr std::launch launch_policy(bool worth_a_thread) noexcept {
  return kThreads && worth_a_thread ? std::launch::async | std::launch::deferred
                                    : std::launch::deferred;
}

/// Calls `start`, which starts threads. The error is of kind io: "could not start the recorder's
/// thread: Resource temporarily unavailable".
template <class Start>
[[nodiscard]] Result<void> with_threads(std::string_view threads, const Start& start) try {
  start();
  return {};
} catch (const std::system_error& error) {
  return failure(ErrorKind::io,
                 "could not start " + std::string(threads) + ": " + error.code().message());
}

}  // namespace clay
