#include "app/bench/report/html_style.hpp"
#include "app/bench/report/report.hpp"
#include "core/svg_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::bench {
namespace {

constexpr std::size_t kManyColumns = 9;

std::string note_of(const std::string& note) {
  return note.empty() ? "" : fmt::format("<p class=\"note\">{}</p>\n", escaped(note));
}

std::string verdict_of(bool sound) {
  return fmt::format("<span class=\"verdict {}\">{}</span>", sound ? "yes" : "no",
                     sound ? "all requirements met" : "a requirement is not met");
}

std::string cell_of(const Cell& cell) {
  const char* style = is_number(cell) ? "number" : "";
  if (const bool* verdict = std::get_if<bool>(&cell)) style = *verdict ? "yes" : "no";
  return fmt::format("<td class=\"{}\">{}</td>", style, escaped(short_text(cell)));
}

/// Converts a key to text: without underscores, and without the unit, which follows.
std::string heading(const Table& table, std::size_t column) {
  std::string name = table.columns[column].name;
  const std::string& unit = table.columns[column].unit;
  if (!unit.empty() && name.ends_with(std::string("_").append(unit)))
    name.resize(name.size() - unit.size() - 1);
  std::ranges::replace(name, '_', ' ');
  return fmt::format("<th class=\"{}\">{}{}</th>", numeric(table, column) ? "number" : "",
                     escaped(name),
                     unit.empty() ? "" : fmt::format("<small>{}</small>", escaped(unit)));
}

std::string html_of(const Table& table) {
  std::string html = fmt::format(
      "<h3 id=\"{}\">{}</h3>\n<div class=\"scroll\"><table class=\"{}\">\n<tr>", escaped(table.id),
      escaped(table.title), table.columns.size() > kManyColumns ? "wide" : "");
  for (std::size_t k = 0; k < table.columns.size(); ++k) html += heading(table, k);
  html += "</tr>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (const Cell& cell : row) html += cell_of(cell);
    html += "</tr>\n";
  }
  return html + "</table></div>\n" + note_of(table.note);
}

std::string html_of(const std::vector<Value>& values) {
  if (values.empty()) return {};
  const bool timed =
      std::ranges::any_of(values, [](const Value& value) { return value.spread != 0.0; });
  std::string html = fmt::format(
      "<div class=\"scroll\"><table>\n<tr><th>figure</th><th class=\"number\">{}</th>{}"
      "<th></th></tr>\n",
      timed ? "median" : "value",
      timed ? "<th class=\"number\">spread<small>interquartile</small></th>" : "");
  for (const Value& value : values) {
    const std::string spread = value.spread == 0.0 ? "" : short_number(value.spread);
    html +=
        fmt::format("<tr><td><code>{}</code></td><td class=\"number\">{}</td>{}<td>{}</td></tr>\n",
                    escaped(value.name), short_number(value.median),
                    timed ? fmt::format("<td class=\"number spread\">{}</td>", spread) : "",
                    escaped(value.about));
  }
  return html + "</table></div>\n";
}

template <class Drawing>
std::string figure_of(const Drawing& drawing) {
  return fmt::format("<figure id=\"{}\"><figcaption>{}</figcaption>\n{}{}</figure>\n",
                     escaped(drawing.id), escaped(drawing.title),
                     svg_of(drawing, chart::Place::page), note_of(drawing.note));
}

std::string html_of(const Section& section) {
  std::string html =
      fmt::format("<section>\n<h2 id=\"section-{}\">{}{}</h2>\n<p>{}</p>\n", escaped(section.id),
                  escaped(section.title), verdict_of(section.sound()), escaped(section.summary));
  for (const std::string& missed : section.missed)
    html += fmt::format("<p class=\"verdict no\">Not met: {}</p>\n", escaped(missed));
  html += html_of(section.values);
  for (const Plot& plot : section.plots) html += figure_of(plot);
  for (const Map& map : section.maps) html += figure_of(map);
  for (const Table& table : section.tables) html += html_of(table);
  return html + "</section>\n";
}

std::string header_of(const Report& report) {
  const Machine& m = report.machine;
  std::string html = fmt::format(
      "<header>\n<h1>Claystack benchmark</h1>\n<dl>\n<dt>command</dt><dd><code>{}</code></dd>\n"
      "<dt>machine</dt><dd>{}, {} cores, {}</dd>\n<dt>compiler</dt><dd>{}; <code>{}</code></dd>\n"
      "<dt>version</dt><dd>{}</dd>\n</dl>\n"
      "<p class=\"note\">Times are medians of repetitions, run alternately in a varying order; "
      "the spread is the interquartile range, the middle half of them. Ratios are computed round "
      "by round. Ticks are measured in CPU time, jumps and exports in wall-clock time. A "
      "requirement on a time is missed if three quarters of the rounds miss it.</p>\n"
      "<nav>",
      escaped(report.command), escaped(m.cpu), m.cores, escaped(m.system), escaped(m.compiler),
      escaped(m.flags), escaped(m.version));
  for (const Section& section : report.sections)
    html += fmt::format("<a href=\"#section-{}\">{}</a>\n", escaped(section.id),
                        escaped(section.title));
  return html + "</nav>\n</header>\n";
}

}  // namespace

std::string html_of(const Report& report) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<title>Claystack benchmark</title>\n<style>";
  html.append(kPageStyle).append(chart::style()).append("</style>\n</head>\n<body>\n");
  html += header_of(report);
  for (const Section& section : report.sections) html += html_of(section);
  return html + "</body>\n</html>\n";
}

}  // namespace clay::bench
