#include "app/bench/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clay::bench {
namespace {

template <class... Calls>
struct Overloaded : Calls... {
  using Calls::operator()...;
};
template <class... Calls>
Overloaded(Calls...) -> Overloaded<Calls...>;

}  // namespace

bool Report::sound() const {
  return std::ranges::all_of(sections, [](const Section& section) { return section.sound(); });
}

std::string short_number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "–" : value > 0 ? "∞" : "−∞";
  const double size = std::abs(value);
  // Whole numbers below a million are printed in full; %g would round them.
  if (size >= 1e3 && size < 1e6) return fmt::format("{:.0f}", value);
  return fmt::format("{:.4g}", value == 0.0 ? 0.0 : value);
}

std::string short_text(const Cell& cell) {
  return std::visit(Overloaded{[](std::monostate) { return std::string("–"); },
                               [](bool verdict) { return std::string(verdict ? "yes" : "no"); },
                               [](std::int64_t count) { return std::to_string(count); },
                               [](double number) { return short_number(number); },
                               [](const std::string& words) { return words; }},
                    cell);
}

bool is_number(const Cell& cell) {
  return std::holds_alternative<double>(cell) || std::holds_alternative<std::int64_t>(cell);
}

bool numeric(const Table& table, std::size_t column) {
  return std::ranges::any_of(table.rows, [&](const std::vector<Cell>& row) {
    return column < row.size() && is_number(row[column]);
  });
}

}  // namespace clay::bench
