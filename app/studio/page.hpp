#pragma once
// Differences of the window as a web page.

#include <filesystem>
#include <string>

namespace clay::studio {

/// A web page has neither folders nor cairo, and draws no picture except that of its canvas.
#ifdef __EMSCRIPTEN__
inline constexpr bool kInPage = true;
#else
inline constexpr bool kInPage = false;
#endif

/// A file as the user knows it. The folders of a page are not visible outside the page.
[[nodiscard]] inline std::string shown_name(const std::filesystem::path& path) {
  return (kInPage ? path.filename() : path).string();
}

}  // namespace clay::studio
