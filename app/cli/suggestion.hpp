#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace clay::cli {

/// The candidate that a mistyped word most resembles: the one with the smallest edit distance
/// (insertions, deletions, substitutions, swaps of neighbours), if that is at most a third of its
/// length. Empty: none is near.
[[nodiscard]] std::string nearest_word(std::string_view word,
                                       const std::vector<std::string>& candidates);

/// "; did you mean WORD?", or an empty text.
[[nodiscard]] std::string suggestion(std::string_view word,
                                     const std::vector<std::string>& candidates);

}  // namespace clay::cli
