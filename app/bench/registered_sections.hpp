#pragma once
// The sections that are built, in the order of the report.

#include "app/bench/section.hpp"
#include "claystack/core/result.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay::bench {

struct RegisteredSection {
  std::string_view id;
  Section (*measure)(const Effort&);
};

[[nodiscard]] std::span<const RegisteredSection> registered_sections();

/// The named sections, in the order of the report; all if none is named. Errors list the names.
Result<std::vector<RegisteredSection>> chosen_sections(const std::vector<std::string>& names);

}  // namespace clay::bench
