#pragma once
// The text of a STEP file (ISO 10303-21) as values.

#include "claystack/core/result.hpp"

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace clay::solid::inline formats {

/// "#12", "0.5", ".T.", "'text'", "*", "$"; a list; or a typed value: a keyword with a list. A
/// complex entity is a list of typed values.
struct StepValue {
  std::string word;
  std::vector<StepValue> items;
};

/// By reference, "#12".
using StepEntities = std::unordered_map<std::string, StepValue>;

/// The DATA section. Errors (`bad_input`) name the line.
Result<StepEntities> parse_step(std::string_view text, std::string_view name);

}  // namespace clay::solid::inline formats
