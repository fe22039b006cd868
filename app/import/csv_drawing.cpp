#include "app/import/csv_columns.hpp"
#include "app/import/readers.hpp"

#include "core/number_parsing.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

namespace clay::importing {
namespace {

/// The whole field as a number. A comma is a decimal comma: it separates nothing here.
std::optional<double> number_of(std::string field) {
  std::replace(field.begin(), field.end(), ',', '.');
  std::string_view text = field;
  if (text.starts_with('+')) text.remove_prefix(1);
  return parse_number<double>(text);
}

/// The first row that Excel writes to name its separator, such as "sep=;".
bool names_separator(std::string_view row) {
  row = trimmed(row);
  return row.size() == 5 && (row.starts_with("sep=") || row.starts_with("SEP="));
}

/// Reads a table row by row.
class Table {
 public:
  Table(const std::string& name, double scale) : name_(name), scale_(scale) {}

  Result<void> row(std::string_view text, std::size_t number) {
    text = text.substr(0, text.find('#'));
    constexpr std::string_view kOfEmptyCells = " \t\r;,\"";  // as spreadsheets write an empty row
    if (trimmed(text, kOfEmptyCells).empty()) {
      open_ = false;
      return {};
    }
    std::vector<std::string> fields = csv_fields(text);
    const auto is_number = [](const std::string& field) { return number_of(field).has_value(); };
    if (!began_ && std::ranges::none_of(fields, is_number)) {
      began_ = true;
      shorten(fields, 0);
      const auto columns = csv_columns(fields);
      if (!columns) return refusal(number, columns.error().message);
      columns_ = *columns;
      return {};
    }
    began_ = true;
    shorten(fields, columns_.count);
    const auto radius = value(fields, columns_.radius), height = value(fields, columns_.height);
    if (fields.size() != columns_.count || !radius || !height)
      return refusal(number, fmt::format("expected a radius and a height in mm, or the columns of "
                                         "the first row, found \"{}\"",
                                         shown(trimmed(text))));
    const auto inner = columns_.inner ? value(fields, *columns_.inner) : std::nullopt;
    if (columns_.inner && !inner)
      return refusal(number, fmt::format("expected an inner radius, found \"{}\"",
                                         shown(fields[columns_.inner->index])));
    const std::string problem = add(*radius, inner, *height);
    return problem.empty() ? Result<void>() : refusal(number, problem);
  }

  Drawing take() {
    close_bore();
    return std::move(drawing_);
  }

 private:
  /// Without the empty fields at its end that exceed the count: some programs end rows with a mark.
  static void shorten(std::vector<std::string>& fields, std::size_t count) {
    while (fields.size() > count && fields.back().empty()) fields.pop_back();
  }

  /// Continues the line. Returns the fault of the point; empty: none.
  std::string add(double radius, std::optional<double> inner, double height) {
    if (const double least = std::min(radius, inner.value_or(radius)); least < 0.0)
      return fmt::format("expected a radius of 0 mm or more, found {:g}", least);
    if (inner && !(*inner <= radius))
      return fmt::format("expected an inner radius up to the outer one of {:g} mm, found {:g}",
                         radius, *inner);
    const std::array<glm::dvec2, 2> points{{{radius, height}, {inner.value_or(0.0), height}}};
    const std::span<const glm::dvec2> used(points.data(), inner ? 2 : 1);
    if (std::string problem = limits_.problem_with(used); !problem.empty()) return problem;
    if (!open_) {
      close_bore();
      drawing_.lines.emplace_back();
    }
    open_ = true;
    drawing_.lines.back().points_mm.push_back(points[0]);
    if (inner) bore_.push_back(points[1]);
    return {};
  }

  /// The last outline goes back along its inner radii.
  void close_bore() {
    if (bore_.empty()) return;
    Line& line = drawing_.lines.back();
    line.points_mm.insert(line.points_mm.end(), bore_.rbegin(), bore_.rend());
    line.closed = true;
    bore_.clear();
  }

  [[nodiscard]] std::optional<double> value(const std::vector<std::string>& fields,
                                            const CsvColumn& column) const {
    if (column.index >= fields.size()) return std::nullopt;
    const auto number = number_of(fields[column.index]);
    return number ? std::optional(scale_ * (column.mm * *number)) : std::nullopt;
  }

  [[nodiscard]] tl::unexpected<Error> refusal(std::size_t line, const std::string& problem) const {
    return failure(ErrorKind::bad_input, fmt::format("{}:{}: {}", name_, line, problem));
  }

  const std::string& name_;
  double scale_;
  Drawing drawing_{{}, true};
  PointLimits limits_;
  CsvColumns columns_;
  std::vector<glm::dvec2> bore_;  ///< of the last line
  bool began_ = false;            ///< a row of names or numbers has been read
  bool open_ = false;             ///< the last line may continue
};

}  // namespace

Result<Drawing> read_csv(std::string_view text, const std::string& name, double scale) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    return failure(ErrorKind::bad_input,
                   name + ": expected a table in UTF-8, found UTF-16; save it as CSV (UTF-8)");
  text = without_byte_order_mark(text);
  const char end_of_row = text.find('\n') == std::string_view::npos ? '\r' : '\n';
  Table table(name, scale);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find(end_of_row), text.size());
    const std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (number == 1 && names_separator(row)) continue;
    if (auto done = table.row(row, number); !done) return tl::make_unexpected(done.error());
  }
  return table.take();
}

}  // namespace clay::importing
