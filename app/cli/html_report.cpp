#include "app/cli/html_report.hpp"

#include "app/cli/export_figures.hpp"
#include "app/cli/maker_table.hpp"
#include "app/cli/wall_map_figure.hpp"
#include "core/base64.hpp"
#include "core/size_text.hpp"
#include "core/svg_writer.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::cli {
namespace {

constexpr std::string_view kStyle = R"css(
@page { size: A4; margin: 14mm; }
body { font: 9pt/1.3 "DejaVu Sans", Helvetica, Arial, sans-serif; color: #222; max-width: 182mm;
  margin: 8mm auto; }
h1 { font-size: 18pt; margin: 0; } h2 { font-size: 12pt; margin: 4mm 0 1mm; break-after: avoid; }
table { border-collapse: collapse; width: 100%; break-inside: avoid; }
th, td { text-align: left; padding: 0.6mm 3mm 0.6mm 0; border-bottom: 0.2mm solid #ccc;
  vertical-align: top; }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; }
.good { color: #22662a; } .bad { color: #a01818; font-weight: bold; }
.pictures { display: flex; gap: 6mm; align-items: flex-start; }
.pictures > * { flex: 1; min-width: 0; } .pictures img { width: 100%; }
.pictures svg { max-height: 80mm; } .drawing svg { max-height: 200mm; }
svg { width: 100%; height: auto; } figure { margin: 0; break-inside: avoid; }
figcaption { font-size: 8.5pt; color: #555; } .long td:first-child { overflow-wrap: anywhere; }
)css";

class Page {
 public:
  Page(const Json& json, const solid::ExportReport& report, const solid::ExportOptions& options,
       const std::string& picture)
      : json_(json), report_(report), options_(options) {
    html_.raw("<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\n");
    html_.element("title", {}, options.name);
    html_.raw("<style>" + std::string(kStyle) + "</style></head>\n<body>\n");
    html_.element("h1", {}, options.name);
    verdict();
    pictures(picture);
    if (!json["maker"].is_null()) maker(json["maker"]);
    assumptions();
    if (report.has_solid()) walls();
    if (report.maker) drawing();
    files();
    left_out_and_times();
    html_.raw("</body></html>\n");
  }

  std::string take() { return html_.take(); }

 private:
  /// Cells from the second on are numbers, and are right-aligned.
  void row(const std::vector<std::string>& cells, std::string_view cell = "td",
           bool numbers = true) {
    html_.open("tr", {});
    for (const std::string& text : cells)
      html_.element(cell, {{"class", numbers && &text != &cells.front() ? "n" : ""}},
                    text.empty() ? " " : text);
    html_.close("tr");
  }
  template <class Rows>
  void table(const std::string& title, Rows rows) {
    html_.element("h2", {}, title);
    html_.open("table", {{"class", "long"}});
    rows();
    html_.close("table");
  }

  void verdict() {
    const auto problems = solid::problems_of(report_);
    const bool limits = report_.walls.limit || report_.process.limits;
    if (report_.collapsed || report_.fallen)
      html_.element("p", {{"class", "bad"}}, "The pot collapsed.");
    if (!report_.has_solid())
      html_.element("p", {}, "No solid was made, so nothing was proved or measured.");
    else if (problems.empty())
      html_.element("p", {{"class", "good"}},
                    std::string("Closed and without self-intersections; ") +
                        (limits ? "all limits met." : "no limits were set."));
    else if (!limits)
      html_.element("p", {}, "No limits were set.");
    for (const solid::Problem& problem : problems)
      html_.element("p", {{"class", problem.fails ? "bad" : ""}}, sentence(problem.text));
  }

  void pictures(const std::string& picture) {
    html_.open("div", {{"class", "pictures"}});
    if (!picture.empty()) {
      html_.open("figure", {});
      html_.element("img", {{"alt", "picture of the pot"},
                            {"src", "data:image/png;base64," + to_base64(picture)}});
      if (report_.section.finish.any())
        html_.element("figcaption", {}, "The pot before it is finished");
      html_.close("figure");
    }
    if (!report_.walls.field.empty()) {
      html_.open("figure", {});
      html_.raw(wall_map_svg(report_.walls.field));
      html_.element("figcaption", {}, "Walls of the section; the colours are fitted to this pot");
      html_.close("figure");
    }
    html_.close("div");
  }

  void maker(const Json& maker) {
    const bool fired = !maker["fired"].is_null(), glazed = !maker["glazed"].is_null();
    table("Size, weight, capacity and surface", [&] {
      std::vector<std::pair<std::string, const Json*>> states;
      for (const auto& [key, name] : {std::pair("thrown", "wet"), std::pair("dry", "dry"),
                                      std::pair("fired", "fired"), std::pair("glazed", "glazed")})
        if (!maker[key].is_null()) states.emplace_back(name, &maker[key]);
      std::vector<std::string> heads{""};
      for (const auto& state : states) heads.push_back(state.first);
      row(heads, "th");
      const auto line = [&](const std::string& name, const char* field, const char* unit,
                            int digits) {
        if (maker["thrown"][field].is_null()) return;
        std::vector<std::string> cells{name};
        for (const auto& state : states)
          cells.push_back(size_text(number_field(*state.second, field), digits) + unit);
        row(cells);
      };
      line("diameter", "diameter_mm", " mm", 1);
      line("height", "height_mm", " mm", 1);
      line("foot", "foot_diameter_mm", " mm", 1);
      line("weight", "weight_g", " g", 0);
      line("capacity to the brim", "capacity_ml", " ml", 0);
      line(fmt::format("capacity to the fill line, {:g} mm below the brim{}",
                       number_field(maker, "fill_line_mm"),
                       glazed  ? " of the glazed pot"
                       : fired ? " of the fired pot"
                               : ""),
           "to_line_ml", " ml", 0);
      line("surface inside", "inside_cm2", " cm2", 0);
      line("surface outside, without the foot", "outside_cm2", " cm2", 0);
    });
    if (maker["empty"].is_null()) return;
    table(fired ? "Balance of the fired pot" : "Balance of the wet pot", [&] {
      row({"", "centre of gravity", "tips at"}, "th");
      for (const auto& [key, name] : {std::pair("empty", "empty"), std::pair("full", "full")})
        if (!maker[key].is_null())
          row({name, fixed(number_field(maker[key], "centre_mm"), 1) + " mm above the foot",
               fixed(number_field(maker[key], "tipping_deg"), 1) + " degrees"});
    });
  }

  /// The assumptions behind the figures above.
  void assumptions() {
    if (json_["maker"].is_null()) return;
    table("Assumptions", [&] {
      if (options_.met_goal)
        row({"goal, to which the pot was scaled", solid::text_of(*options_.met_goal)}, "td", false);
      for (const auto& [name, figure] : solid::assumptions_of(clay_figures()))
        row({name, figure}, "td", false);
    });
  }

  [[nodiscard]] const solid::ClayFigures& clay_figures() const {
    return (report_.maker ? report_.maker : report_.fallen)->clay;
  }

  void walls() {
    table("Walls and process", [&] {
      row({"minimum wall of the files",
           at_least_mm(report_.thinnest_mm(), report_.walls.limit ? 3 : 2) + ", at " +
               thinnest_height(report_)},
          "td", false);
      for (const auto& [part, thickness_mm, at] : report_.walls.parts)
        row({fmt::format("{} of the round section", solid::name_of(part)),
             fmt::format("{}, at a height of {} mm", at_least_mm(thickness_mm, 2),
                         size_text(at.y, 1))},
            "td", false);
      if (const auto& limit = report_.walls.limit)
        row({"required",
             fmt::format("{} mm ({})", size_text(limit->min_wall_mm, 2), limit->asked_by())},
            "td", false);
      if (const auto& fairing = report_.section.smoothed.fairing; fairing.length_mm > 0.0)
        row({"fairing",
             fmt::format(
                 "over {:.3g} mm; moved the walls by at most {:.2f} mm, at a height of {:.1f} "
                 "mm",
                 fairing.length_mm, fairing.moved_mm, fairing.moved_at_mm)},
            "td", false);
      for (const auto& [what, clay] : finish_rows(report_)) row({what, clay}, "td", false);
      if (const auto& overhang = report_.process.overhang)
        row({"steepest overhang",
             fmt::format("{:.0f} degrees from the vertical at a height of {:.1f} mm",
                         overhang->angle_deg, overhang->at.y)},
            "td", false);
      if (const auto& process = report_.process.limits) bed_row(*process);
    });
  }

  void bed_row(const solid::ProcessLimits& process) {
    if (process.size)
      row({"fits " + solid::process_title(process.name),
           json_["process"]["bed"]["fits"].get<bool>() ? "yes" : "no"},
          "td", false);
    else
      row({"size", "not checked: no bed size is known for " + solid::process_title(process.name)},
          "td", false);
  }

  /// On its own page, scaled to it: the file is for printing at 1:1.
  void drawing() {
    html_.element("h2", {}, "Drawing");
    html_.open("figure", {{"class", "drawing"}});
    html_.raw(solid::drawing_svg(report_, options_));
    html_.element("figcaption", {},
                  "Not to scale on this page; export an .svg, .dxf or .pdf for 1:1");
    html_.close("figure");
  }

  void files() {
    table("Files", [&] {
      row({"file", "bytes", "distance from the round solid", "read back"}, "th");
      for (const solid::FileReport& file : report_.files) {
        const double distance = distance_mm(report_, file);
        row({file.path, std::to_string(file.bytes),
             distance > 0.0 ? fmt::format("{:.2g} mm", distance) : "",
             file.read_back ? "yes" : ""});
      }
    });
    if (!report_.has_solid()) return;
    table("Proof", [&] {
      const Json& certificate = json_["certificate"];
      row({"proved", certificate["proved"].get<std::string>()}, "td", false);
      row({"volume", fmt::format("{:.3f} cm3; relative difference to the counted clay {:.1e}",
                                 1e-3 * number_field(json_, "volume_mm3"),
                                 number_field(json_, "volume_error_relative"))},
          "td", false);
      row({"facets", fmt::format("{} triangles, chordal error {:.3g} mm",
                                 json_["triangles"].get<std::size_t>(),
                                 number_field(json_, "chordal_error_mm"))},
          "td", false);
    });
  }

  void left_out_and_times() {
    table("Left out", [&] {
      for (const auto& [what, why, saved] : report_.left_out) row({what, why}, "td", false);
    });
    table("Time", [&] {
      for (const auto& [name, seconds] : report_.stages)
        row({name, fixed(1000.0 * seconds, 2) + " ms"});
    });
  }

  const Json& json_;
  const solid::ExportReport& report_;
  const solid::ExportOptions& options_;
  SvgWriter html_;
};

}  // namespace

std::string html_report(const Json& json, const solid::ExportReport& report,
                        const solid::ExportOptions& options, const std::string& picture) {
  return Page(json, report, options, picture).take();
}

}  // namespace clay::cli
