#pragma once
// Where the window as a web page differs.

#include <filesystem>
#include <string>

namespace clay::studio {

/// A web page has neither folders nor cairo, and no picture beside its own.
#ifdef __EMSCRIPTEN__
inline constexpr bool kInPage = true;
#else
inline constexpr bool kInPage = false;
#endif

/// A file as the user knows it. The folders of a page are not visible outside of it.
[[nodiscard]] inline std::string shown_name(const std::filesystem::path& path) {
  return (kInPage ? path.filename() : path).string();
}

}  // namespace clay::studio
