#include "app/import/csv_columns.hpp"
#include "app/import/readers.hpp"

#include "core/number_text.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace clay::importing {
namespace {

/// The whole field as a number. A comma is a decimal comma: it separates nothing here.
std::optional<double> number_of(std::string field) {
  std::replace(field.begin(), field.end(), ',', '.');
  std::string_view text = field;
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, problem] = from_chars(text.data(), end, value);
  if (problem != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// Reads a table row by row.
class Table {
 public:
  explicit Table(const std::string& name) : name_(name) {}

  Result<void> row(std::string_view text, std::size_t number) {
    text = trimmed(text.substr(0, text.find('#')));
    if (text.empty()) {
      open_ = false;
      return {};
    }
    const std::vector<std::string> fields = csv_fields(text);
    if (!began_ && !number_of(fields.front())) {
      began_ = true;
      const auto columns = csv_columns(fields);
      if (!columns) return refusal(number, columns.error().message);
      columns_ = *columns;
      return {};
    }
    began_ = true;
    const auto radius = value(fields, columns_.radius), height = value(fields, columns_.height);
    if (fields.size() != columns_.count || !radius || !height)
      return refusal(number, fmt::format("expected a radius and a height in mm, or the columns of "
                                         "the first row, found \"{}\"",
                                         text.substr(0, 40)));
    if (*radius < 0.0)
      return refusal(number, fmt::format("expected a radius of 0 mm or more, found {:g}", *radius));
    const glm::dvec2 point{*radius, *height};
    if (const std::string problem = limits_.problem_with({&point, 1}); !problem.empty())
      return refusal(number, problem);
    if (!open_) drawing_.lines.emplace_back();
    open_ = true;
    drawing_.lines.back().points_mm.push_back(point);
    return {};
  }

  Drawing take() { return std::move(drawing_); }

 private:
  static std::optional<double> value(const std::vector<std::string>& fields,
                                     const CsvColumn& column) {
    if (column.index >= fields.size()) return std::nullopt;
    const auto number = number_of(fields[column.index]);
    return number ? std::optional(column.mm * *number) : std::nullopt;
  }

  [[nodiscard]] tl::unexpected<Error> refusal(std::size_t line, const std::string& problem) const {
    return failure(ErrorKind::bad_input, fmt::format("{}:{}: {}", name_, line, problem));
  }

  const std::string& name_;
  Drawing drawing_{{}, true};
  PointLimits limits_;
  CsvColumns columns_;
  bool began_ = false;  ///< a row of names or numbers has been read
  bool open_ = false;   ///< the last line may continue
};

}  // namespace

Result<Drawing> read_csv(std::string_view text, const std::string& name) {
  text = without_byte_order_mark(text);
  Table table(name);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (auto done = table.row(text.substr(0, end), number); !done)
      return tl::make_unexpected(done.error());
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return table.take();
}

}  // namespace clay::importing
