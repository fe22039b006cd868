#pragma once
// The text of a STEP file (ISO 10303-21) as values.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

/// "#12", "0.5", ".T.", "'text'", "*", "$"; a list; or a typed value: a keyword with a list. A
/// complex entity is a list of typed values.
struct StepValue {
  std::string_view word;            ///< part of the text of the file
  std::size_t first = 0, size = 0;  ///< the list, in `StepFile::lists`
};

/// The DATA section. The text must outlive it.
struct StepFile {
  std::vector<StepValue> entities;  ///< #1, #2, ...
  std::vector<StepValue> lists;     ///< the items of every list, one list after the other

  [[nodiscard]] std::span<const StepValue> items(const StepValue& value) const noexcept {
    return std::span(lists).subspan(value.first, value.size);
  }
};

/// The number of a reference, 12 of "#12"; 0 if the word is not a reference.
[[nodiscard]] std::size_t step_number(std::string_view word) noexcept;

/// Reads files that number their entities from 1, one after the other, and have no comments, as
/// `encode_step` writes them. Errors (`bad_input`) name the line.
Result<StepFile> parse_step(std::string_view text, std::string_view name);

}  // namespace clay::solid::inline formats
