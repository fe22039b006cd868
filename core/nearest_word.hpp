#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace clay {

/// The candidate that a mistyped word most resembles: the one with the smallest edit distance
/// (insertions, deletions, substitutions, swaps of neighbours), if that is at most a third of its
/// length. Empty: none is near.
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            const std::vector<std::string_view>& candidates);
/// "; did you mean WORD?" for a mistyped word, or an empty text.
[[nodiscard]] std::string suggestion(std::string_view word,
                                     const std::vector<std::string_view>& candidates);

}  // namespace clay
