#pragma once
// The options that the messages of the library name in words.

#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"
#include "claystack/export/repair.hpp"
#include "claystack/export/solid.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace clay::cli {

/// "thickening gives it one" as "--thicken MM gives it one". `begin`: the length of a file name in
/// front, which may contain such words too.
[[nodiscard]] inline std::string with_options(std::string text, std::size_t begin = 0) {
  constexpr std::array kOptions{
      std::pair{std::string_view(solid::kThickening), "--thicken MM"},
      std::pair{std::string_view(solid::kCapping), "--cap"},
      std::pair{std::string_view(solid::kWrapping), "--wrap MM"},
      std::pair{std::string_view(solid::kByRepair), "check --repair"},
      std::pair{std::string_view(solid::kPermitPieces), "use --pieces"},
      std::pair{std::string_view(solid::kLinesAreExact), "--step lines is exact"}};
  for (const auto& [words, option] : kOptions)
    if (const std::size_t at = text.find(words, begin); at != std::string::npos)
      text.replace(at, words.size(), option);
  return text;
}

}  // namespace clay::cli
