#include "app/bench/registered_sections.hpp"

#include <algorithm>
#include <iterator>

namespace clay::bench {

std::span<const RegisteredSection> registered_sections() {
  static constexpr RegisteredSection kSections[] = {
#define CLAYSTACK_SECTION(name) {#name, &name##_section},
#include "claystack_sections.inc"
#undef CLAYSTACK_SECTION
  };
  return kSections;
}

Result<std::vector<RegisteredSection>> chosen_sections(const std::vector<std::string>& names) {
  const auto all = registered_sections();
  for (const std::string& name : names)
    if (std::ranges::none_of(all, [&](const RegisteredSection& s) { return s.id == name; })) {
      std::string known;
      for (const RegisteredSection& section : all)
        known.append(known.empty() ? "" : ", ").append(section.id);
      return failure(
          ErrorKind::bad_input,
          std::string("--only: expected some of ").append(known).append(", found ").append(name));
    }
  std::vector<RegisteredSection> chosen;
  std::ranges::copy_if(all, std::back_inserter(chosen), [&](const RegisteredSection& section) {
    return names.empty() || std::ranges::find(names, section.id) != names.end();
  });
  return chosen;
}

}  // namespace clay::bench
