#pragma once
// Writers of the results. They write no date, so the same figures give the same bytes.

#include "app/bench/machine.hpp"
#include "app/bench/section.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace clay::bench {

struct Report {
  Machine machine;
  std::string command;  ///< as typed
  std::vector<Section> sections;

  [[nodiscard]] bool sound() const;  ///< every section is sound
};

/// "machine", "compiler", "version", "command", "sound" and "sections" (of each: description,
/// values with their required bounds, parts, units); then each part under its id:
///
/// - a section's values as {"NAME": median, "NAME_iqr": interquartile range where timed}. If a
///   table has the section's name, they are under "ID_values".
/// - a table as an array of {"COLUMN": cell};
/// - a plot as {"x", "y", "curves": [{"name", "x", "y"}]}, and in a curve, where it has them, the
///   quartiles "low" and "high" of y, "x_low" and "x_high" of x, and the "labels" of its points;
/// - a map as {"x", "y", "x_values", "y_values", "cells", "curves"}.
///
/// Values that are not finite are null.
[[nodiscard]] nlohmann::ordered_json json_of(const Report& report);

/// Name and contents of a file for each set of values, table, plot and map: RFC 4180, first line
/// the column names, numbers with all digits, empty if missing.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> csv_files(const Report& report);

/// Name and content of a drawing for each plot and map.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> svg_files(const Report& report);

/// One page without other files, network or scripts; also well-formed XML.
[[nodiscard]] std::string html_of(const Report& report);

/// For a terminal.
[[nodiscard]] std::string text_of(const Section& section);

/// A readable number: four significant digits.
[[nodiscard]] std::string short_number(double value);
/// A readable cell; a dash if empty.
[[nodiscard]] std::string short_text(const Cell& cell);
/// Whether the cell is right-aligned.
[[nodiscard]] bool is_number(const Cell& cell);
/// Whether a column has a number: then its heading is right-aligned too.
[[nodiscard]] bool numeric(const Table& table, std::size_t column);

}  // namespace clay::bench
