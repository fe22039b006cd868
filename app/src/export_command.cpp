#include "commands.hpp"

#include "claystack/engine/atomic_file.hpp"
#include "claystack/engine/pot_file.hpp"
#include "claystack/export/export_job.hpp"
#include "claystack/export/section_svg.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

namespace clay::app {
namespace {

using solid::ExportReport;
using solid::MeshFormat;

struct ExportCommand {
  std::string pot;
  std::vector<std::string> outputs;
  solid::ExportOptions options;
  std::size_t segments = 0;
  std::string smooth = "fair";
  bool ascii = false;
};

/// What is asked for: meshes go through the job, drawings and pots straight from the pot.
struct Request {
  std::string path;
  std::optional<MeshFormat> mesh;
};

Result<std::vector<Request>> requests_of(const ExportCommand& command) {
  std::vector<Request> requests;
  for (const std::string& path : command.outputs) {
    Request request{path, std::nullopt};
    if (!path.ends_with(".svg")) {
      const auto format = solid::mesh_format_of(path);
      if (!format)
        return failure(ErrorKind::bad_input, format.error().message + "; or .svg for the section");
      request.mesh =
          *format == MeshFormat::stl_binary && command.ascii ? MeshFormat::stl_ascii : *format;
    }
    requests.push_back(std::move(request));
  }
  return requests;
}

Json collapsed_json(const solid::CollapsedSolid& collapsed) {
  return {{"lower_mm3", collapsed.lower_mm3},     {"upper_mm3", collapsed.upper_mm3},
          {"overlap_mm3", collapsed.overlap_mm3}, {"union_mm3", collapsed.union_mm3},
          {"pieces", collapsed.pieces},           {"voids", collapsed.voids},
          {"voids_mm3", collapsed.voids_mm3},     {"pockets", collapsed.pockets},
          {"pockets_mm3", collapsed.pockets_mm3}, {"max_move_mm", collapsed.max_move_mm}};
}

/// What the planar certificate says, and where it ends.
std::string_view proof_of(const ExportReport& report) {
  if (report.collapsed)
    return "each part before the fall: closed and embedded; the whole: no self-intersection by "
           "exact predicates on the mesh as rounded to float32";
  return "closed and embedded: the profile is strictly simple and meets the axis in segments only";
}

Json report_json(const ExportReport& report) {
  Json json = {
      {"triangles", report.mesh.triangles},
      {"segments", report.segments},
      {"smoothing", report.smoothing == solid::Smoothing::fair ? "fair" : "none"},
      {"volume_mm3", report.volume_mm3},
      {"counted_volume_mm3", report.counted_volume_mm3},
      {"volume_error_relative", report.volume_error_relative},
      {"chordal_error_mm", report.chordal_error_mm},
      {"min_wall_mm", report.min_wall_mm},
      {"certificate",
       {{"proved", proof_of(report)},
        {"polygons", report.certificate.polygons},
        {"vertices", report.certificate.vertices},
        {"axis_segments", report.certificate.axis_segments}}},
      {"components", report.mesh.components},
      {"self_intersections", report.mesh.self_intersections},
      {"cavities", Json::array()},
      {"files", Json::array()},
      {"left_out", Json::array()},
      {"stages", Json::array()},
  };
  for (const auto& shape : report.shapes)
    for (const auto& cavity : shape.cavities)
      json["cavities"].push_back({{"bottom_mm", cavity.bottom_mm},
                                  {"top_mm", cavity.top_mm},
                                  {"volume_mm3", cavity.volume_mm3}});
  if (report.collapsed) json["collapsed"] = collapsed_json(*report.collapsed);
  for (const auto& [what, why] : report.left_out)
    json["left_out"].push_back({{"what", what}, {"why", why}});
  for (const auto& [name, seconds] : report.stages)
    json["stages"].push_back({{"name", name}, {"seconds", seconds}});
  return json;
}

Json file_json(const std::string& path, std::string_view format, std::size_t bytes,
               double max_error_mm) {
  return {{"path", path}, {"format", format}, {"bytes", bytes}, {"max_error_mm", max_error_mm}};
}

std::string rounding_of(const Json& file) {
  const double error = file["max_error_mm"].get<double>();
  return error > 0.0 ? fmt::format(", vertices within {:.2g} mm", error) : "";
}

void tell_of_collapse(const Console& console, const Json& collapsed, double counted_mm3) {
  const auto cm3 = [&](const char* key) { return collapsed[key].get<double>() / 1000.0; };
  console.say(fmt::format(
      "collapsed: of {:.3f} cm3 counted, {:.3f} cm3 stand and {:.3f} cm3 fell; they overlap by "
      "{:.3f} cm3, so that the union holds {:.3f} cm3",
      counted_mm3 / 1000.0, cm3("lower_mm3"), cm3("upper_mm3"), cm3("overlap_mm3"),
      cm3("union_mm3")));
  if (const auto pieces = collapsed["pieces"].get<std::size_t>(); pieces > 1)
    console.warn(fmt::format("the file holds {} bodies that do not touch", pieces));
  if (const auto voids = collapsed["voids"].get<std::size_t>(); voids > 0)
    console.warn(fmt::format("{} closed cavities hold {:.3g} cm3: they need drain holes", voids,
                             cm3("voids_mm3")));
}

void tell(const Console& console, const Json& json) {
  const bool collapsed = json.contains("collapsed");
  console.say(fmt::format(
      "proved: {}closed and embedded, from {} profile vertices; checked on the mesh: "
      "{} triangles, {} component(s), {} self-intersections",
      collapsed ? "each part before the fall " : "",
      json["certificate"]["vertices"].get<std::size_t>(), json["triangles"].get<std::size_t>(),
      json["components"].get<std::size_t>(), json["self_intersections"].get<std::size_t>()));
  console.say(fmt::format(
      "volume {:.3f} cm3, {}off the counted clay by {:.1e}; thinnest {:.2f} mm; chordal error "
      "{:.3g} mm",
      json["volume_mm3"].get<double>() / 1000.0, collapsed ? "with the overlap " : "",
      json["volume_error_relative"].get<double>(), json["min_wall_mm"].get<double>(),
      json["chordal_error_mm"].get<double>()));
  if (collapsed)
    tell_of_collapse(console, json["collapsed"], json["counted_volume_mm3"].get<double>());
  for (const Json& cavity : json["cavities"])
    console.warn(
        fmt::format("closed cavity from {:.1f} to {:.1f} mm ({:.1f} cm3): it needs a drain hole",
                    cavity["bottom_mm"].get<double>(), cavity["top_mm"].get<double>(),
                    cavity["volume_mm3"].get<double>() / 1000.0));
  for (const Json& file : json["files"])
    console.say(fmt::format("{}: {}, {} bytes{}", file["path"].get<std::string>(),
                            file["format"].get<std::string>(), file["bytes"].get<std::size_t>(),
                            rounding_of(file)));
}

/// Everything is encoded and verified before the first file is written.
Result<Json> write_all(const Pot& pot, const std::vector<Request>& requests,
                       const ExportCommand& command, const Console& console) {
  std::vector<MeshFormat> formats;
  for (const Request& request : requests)
    if (request.mesh) formats.push_back(*request.mesh);
  Progress progress(console, "exporting", 0);
  const auto result = solid::run_export(pot, formats, command.options,
                                        [&](std::string_view stage) { progress.stage(stage); });
  if (!result) return tl::make_unexpected(result.error());

  Json json = report_json(result->report);
  const auto begin = std::chrono::steady_clock::now();
  auto mesh = result->files.begin();
  for (const Request& request : requests) {
    const std::string drawing = request.mesh ? std::string() : solid::section_svg(pot);
    const std::string& bytes = request.mesh ? mesh->bytes : drawing;
    if (auto written = publish(request.path, bytes); !written)
      return tl::make_unexpected(written.error());
    json["files"].push_back(request.mesh ? file_json(request.path, solid::name_of(mesh->format),
                                                     bytes.size(), mesh->max_error_mm)
                                         : file_json(request.path, "svg", bytes.size(), 0.0));
    if (request.mesh) ++mesh;
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  json["stages"].push_back({{"name", "publish"}, {"seconds", seconds.count()}});
  return json;
}

Result<void> export_pot(ExportCommand& command, const Console& console) {
  if (auto names = check_distinct(command.outputs, {command.pot}); !names) return names;
  const auto requests = requests_of(command);
  if (!requests) return tl::make_unexpected(requests.error());
  const auto pot = read_file(command.pot).and_then([&](const std::string& bytes) {
    return parse_pot(bytes, command.pot);
  });
  if (!pot) return tl::make_unexpected(pot.error());
  command.options.smoothing =
      command.smooth == "fair" ? solid::Smoothing::fair : solid::Smoothing::none;
  if (command.segments > 0) command.options.segments = command.segments;
  command.options.name = std::filesystem::path(command.pot).stem().stem().string();

  // A section needs no solid: any pot can be drawn, a fallen one too.
  const bool only_drawings = std::none_of(requests->begin(), requests->end(),
                                          [](const Request& r) { return r.mesh.has_value(); });
  if (only_drawings) {
    for (const Request& request : *requests) {
      if (auto written = publish(request.path, solid::section_svg(*pot)); !written) return written;
      console.say(request.path + ": section");
    }
    return {};
  }
  const auto json = write_all(*pot, *requests, command, console);
  if (!json) return failure(json.error().kind, command.pot + ": " + json.error().message);
  if (console.json) console.print(*json);
  tell(console, *json);
  return {};
}

}  // namespace

void add_export_command(CLI::App& app, Console& console, int& exit) {
  auto command = std::make_shared<ExportCommand>();
  CLI::App* sub =
      app.add_subcommand("export", "Turn a pot into a solid that prints, proved and checked");
  sub->add_option("pot", command->pot, "NAME.pot.json or .pot.cbor, or - for standard input")
      ->required();
  sub->add_option("out", command->outputs,
                  "Files to write: .stl, .obj, .drc, or .svg for the section")
      ->required();
  sub->add_option("--tolerance", command->options.tolerance_mm,
                  "Largest chordal error, and vertex error in .drc [mm]")
      ->check(in_range(1e-4, 10.0))
      ->capture_default_str();
  sub->add_option("--smooth", command->smooth,
                  "fair: walls as they were meant; none: the steps of the rings")
      ->check(CLI::IsMember({"fair", "none"}))
      ->capture_default_str();
  sub->add_option("--segments", command->segments,
                  "Steps around the axis (default: as the tolerance asks)")
      ->check(CLI::Range(3, 1 << 20));
  sub->add_flag("--ascii", command->ascii, "Write .stl as text");
  sub->add_flag("--pieces", command->options.allow_pieces,
                "Allow pieces that do not touch, all in one file");
  sub->footer(
      "\nExamples:\n  claystack export bowl.pot.json bowl.stl bowl.obj bowl.drc bowl.svg\n"
      "  claystack export bowl.pot.json bowl.stl --tolerance 0.005 --json");
  sub->callback([command, &console, &exit] {
    const auto done = export_pot(*command, console);
    exit = done ? kDone : report(done.error());
  });
}

}  // namespace clay::app
