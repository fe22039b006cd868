#include "app/bench/section.hpp"

#include "app/bench/report/report.hpp"

#include <fmt/format.h>

#include <utility>

namespace clay::bench {
namespace {

void add_bounded(Section& section, std::string name, const Spread& measured, bool holds,
                 const std::string& bound, std::string_view about) {
  section.require(holds, fmt::format("{}: required {}, measured {}", name, bound,
                                     short_number(measured.median)));
  section.values.push_back({std::move(name), measured.median, measured.range(),
                            fmt::format("{}; required: {}", about, bound)});
}

}  // namespace

void Section::require(bool holds, std::string missing) {
  if (!holds) missed.push_back(std::move(missing));
}

void add_at_most(Section& section, std::string name, const Spread& measured, double limit,
                 std::string_view about) {
  add_bounded(section, std::move(name), measured, measured.low <= limit,
              fmt::format("at most {}", short_number(limit)), about);
}

void add_at_least(Section& section, std::string name, const Spread& measured, double limit,
                  std::string_view about) {
  add_bounded(section, std::move(name), measured, measured.high >= limit,
              fmt::format("at least {}", short_number(limit)), about);
}

}  // namespace clay::bench
