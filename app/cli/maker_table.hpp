#pragma once
// The numbers of a maker at the end of `throw` and `export`: size, weight, capacity, wall, verdict.

#include "app/cli/console.hpp"
#include "app/cli/json_output.hpp"
#ifdef CLAYSTACK_EXPORT
#include "claystack/export/job.hpp"
#endif

#include <string>

namespace clay::cli {

#ifdef CLAYSTACK_EXPORT
/// States, balance and the figures of the clay behind them; of a collapsed pot size and weight.
[[nodiscard]] Json maker_json(const solid::ExportReport& report);
#endif

/// `numbers` are those of maker_json, or null: then only the other two rows. An empty row is left
/// out.
void print_maker_table(const Console& console, const Json& numbers, const std::string& wall,
                       const std::string& verdict);

/// "at least 4.97 mm", rounded down.
[[nodiscard]] std::string at_least_mm(double bound_mm, int decimals);

}  // namespace clay::cli
