#pragma once
// Columns of a table: their kind (radius or height) and their unit.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::importing {

struct CsvColumn {
  std::size_t index = 0;
  double mm = 1.0;  ///< of a value 1; of a radius half of it if the column is a diameter
};

struct CsvColumns {
  CsvColumn radius{0, 1.0}, height{1, 1.0};
  std::optional<CsvColumn> inner{};  ///< radius of the bore
  std::size_t count = 2;
};

/// The fields of a row, without blanks and quotes: between semicolons, tabs, commas or blanks, by
/// the first of these that occurs.
[[nodiscard]] std::vector<std::string> csv_fields(std::string_view row);

/// Columns by their names: radius, r, rho, x, halbmesser or diameter, d, durchmesser; height, h, y,
/// z or höhe; each with a unit mm, cm, m or in after _ or a blank or in brackets, by default mm. A
/// radius or diameter may be called outer or inner; an inner one needs an outer one. Others are
/// ignored. Refuses names of which not exactly one is a radius and one a height, and the table of
/// walls that `export` writes, which is no outline. The error is without a place.
Result<CsvColumns> csv_columns(const std::vector<std::string>& names);

}  // namespace clay::importing
