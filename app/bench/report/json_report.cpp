#include "app/bench/report/report.hpp"

#include <algorithm>

namespace clay::bench {
namespace {

using Json = nlohmann::ordered_json;

struct ToJson {
  Json operator()(std::monostate) const { return nullptr; }
  template <class Content>
  Json operator()(const Content& content) const {
    return content;
  }
};

Json json_of(const Table& table) {
  Json rows = Json::array();
  for (const auto& cells : table.rows) {
    Json row = Json::object();
    for (std::size_t k = 0; k < std::min(cells.size(), table.columns.size()); ++k)
      row[table.columns[k].name] = std::visit(ToJson{}, cells[k]);
    rows.push_back(std::move(row));
  }
  return rows;
}

Json json_of(const Axis& axis) {
  return {{"label", axis.label}, {"logarithmic", axis.logarithmic}};
}

Json json_of(const std::vector<Curve>& curves) {
  Json list = Json::array();
  for (const Curve& curve : curves) {
    Json json = {{"name", curve.name}, {"x", curve.x}, {"y", curve.y}};
    const auto add = [&json](const char* key, const auto& values) {
      if (!values.empty()) json[key] = values;
    };
    add("low", curve.low);
    add("high", curve.high);
    add("x_low", curve.x_low);
    add("x_high", curve.x_high);
    add("labels", curve.labels);
    list.push_back(std::move(json));
  }
  return list;
}

Json json_of(const Plot& plot) {
  return {{"x", json_of(plot.x)}, {"y", json_of(plot.y)}, {"curves", json_of(plot.curves)}};
}

Json json_of(const Map& map) {
  return {{"x", json_of(map.x)},      {"y", json_of(map.y)}, {"x_values", map.x_values},
          {"y_values", map.y_values}, {"cells", map.cells},  {"curves", json_of(map.curves)}};
}

Json json_of(const std::vector<Value>& values) {
  Json json = Json::object();
  for (const Value& value : values) {
    json[value.name] = value.median;
    if (value.spread != 0.0) json[value.name + "_iqr"] = value.spread;
  }
  return json;
}

/// The description of parts; the parts themselves are stored elsewhere.
template <class Part>
Json titles_of(const std::vector<Part>& parts) {
  Json list = Json::array();
  for (const Part& part : parts) {
    Json json = {{"id", part.id}, {"title", part.title}, {"note", part.note}};
    if constexpr (std::is_same_v<Part, Table>)
      for (const Column& column : part.columns)
        if (!column.unit.empty()) json["units"][column.name] = column.unit;
    list.push_back(std::move(json));
  }
  return list;
}

/// The description of each value, with its required bound if it has one.
Json abouts_of(const std::vector<Value>& values) {
  Json json = Json::object();
  for (const Value& value : values) json[value.name] = value.about;
  return json;
}

Json description_of(const Section& section) {
  return {{"id", section.id},
          {"title", section.title},
          {"sound", section.sound()},
          {"missed", section.missed},
          {"summary", section.summary},
          {"values", abouts_of(section.values)},
          {"tables", titles_of(section.tables)},
          {"plots", titles_of(section.plots)},
          {"maps", titles_of(section.maps)}};
}

}  // namespace

Json json_of(const Report& report) {
  const Machine& machine = report.machine;
  Json json = {
      {"machine", {{"cpu", machine.cpu}, {"cores", machine.cores}, {"system", machine.system}}},
      {"compiler", {{"name", machine.compiler}, {"flags", machine.flags}}},
      {"version", machine.version},
      {"command", report.command},
      {"sound", report.sound()},
      {"sections", Json::array()}};
  for (const Section& section : report.sections) {
    json["sections"].push_back(description_of(section));
    for (const Table& part : section.tables) json[part.id] = json_of(part);
    for (const Plot& part : section.plots) json[part.id] = json_of(part);
    for (const Map& part : section.maps) json[part.id] = json_of(part);
    if (!section.values.empty())
      json[json.contains(section.id) ? section.id + "_values" : section.id] =
          json_of(section.values);
  }
  return json;
}

}  // namespace clay::bench
