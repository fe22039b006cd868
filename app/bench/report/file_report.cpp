#include "app/bench/report/report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clay::bench {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field.append(c == '"' ? "\"\"" : std::string(1, c));
  return field + "\"";
}

/// The shortest digits that read back as the same number.
std::string digits(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

struct ToField {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(bool verdict) const { return verdict ? "true" : "false"; }
  std::string operator()(std::int64_t count) const { return std::to_string(count); }
  std::string operator()(double number) const { return digits(number); }
  std::string operator()(const std::string& words) const { return quoted(words); }
};

std::string csv_of(const Table& table) {
  std::string csv;
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    csv.append(k > 0 ? "," : "").append(quoted(table.columns[k].name));
  csv += "\r\n";
  for (const auto& cells : table.rows) {
    for (std::size_t k = 0; k < cells.size(); ++k)
      csv.append(k > 0 ? "," : "").append(std::visit(ToField{}, cells[k]));
    csv += "\r\n";
  }
  return csv;
}

std::string csv_of(const std::vector<Value>& values) {
  std::string csv = "name,median,iqr\r\n";
  for (const Value& value : values)
    csv += fmt::format("{},{},{}\r\n", quoted(value.name), digits(value.median),
                       value.spread == 0.0 ? "" : digits(value.spread));
  return csv;
}

std::string csv_of(const std::vector<Curve>& curves) {
  const auto at = [](const std::vector<double>& values, std::size_t k) {
    return k < values.size() ? digits(values[k]) : std::string();
  };
  std::string csv = "curve,x,y,low,high,x_low,x_high,label\r\n";
  for (const Curve& curve : curves)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      csv += fmt::format("{},{},{},{},{},{},{},{}\r\n", quoted(curve.name), at(curve.x, k),
                         at(curve.y, k), at(curve.low, k), at(curve.high, k), at(curve.x_low, k),
                         at(curve.x_high, k),
                         k < curve.labels.size() ? quoted(curve.labels[k]) : std::string());
  return csv;
}

std::string csv_of(const Map& map) {
  std::string csv = "x,y,cell\r\n";
  for (std::size_t row = 0; row < map.cells.size(); ++row)
    for (std::size_t k = 0; k < map.cells[row].size(); ++k)
      csv += fmt::format("{},{},{}\r\n", digits(map.x_values[k]), digits(map.y_values[row]),
                         digits(map.cells[row][k]));
  return csv;
}

/// Replaces characters so that the file stays in the folder.
std::string file_name(const std::string& id, const char* ending) {
  std::string name;
  for (const char c : id) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_';
    name += plain ? c : '_';
  }
  return name + ending;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> csv_files(const Report& report) {
  std::vector<std::pair<std::string, std::string>> files;
  const auto add = [&](const std::string& id, std::string csv) {
    files.emplace_back(file_name(id, ".csv"), std::move(csv));
  };
  for (const Section& section : report.sections) {
    if (!section.values.empty()) add(section.id + "_values", csv_of(section.values));
    for (const Table& table : section.tables) add(table.id, csv_of(table));
    for (const Plot& plot : section.plots) add(plot.id, csv_of(plot.curves));
    for (const Map& map : section.maps) {
      add(map.id, csv_of(map));
      if (!map.curves.empty()) add(map.id + "_curves", csv_of(map.curves));
    }
  }
  return files;
}

std::vector<std::pair<std::string, std::string>> svg_files(const Report& report) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const Section& section : report.sections) {
    for (const Plot& plot : section.plots)
      files.emplace_back(file_name(plot.id, ".svg"), svg_of(plot, chart::Place::alone));
    for (const Map& map : section.maps)
      files.emplace_back(file_name(map.id, ".svg"), svg_of(map, chart::Place::alone));
  }
  return files;
}

}  // namespace clay::bench
