#include "commands.hpp"

#include "claystack/engine/atomic_file.hpp"
#include "claystack/engine/pot_file.hpp"
#include "claystack/export/certificate.hpp"
#include "claystack/export/drc_claims.hpp"
#include "claystack/export/mesh_check.hpp"
#include "claystack/export/mesh_formats.hpp"
#include "claystack/export/tessellate.hpp"
#include "claystack/export/wall_thickness.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <optional>

namespace clay::app {
namespace {

// A pot is checked on a mesh of its steps: enough facets to look like the pot, few enough to be
// quick. Whether it is sound does not depend on how many.
constexpr std::size_t kMostSegments = 64;
constexpr std::size_t kFewestSegments = 8;
constexpr std::size_t kQuickTriangles = 1'000'000;

std::size_t check_segments(const solid::Profile& profile) {
  const std::size_t each = std::max<std::size_t>(solid::triangle_count(profile, 1), 1);
  return std::clamp(kQuickTriangles / each, kFewestSegments, kMostSegments);
}

struct CheckCommand {
  std::string file;
  std::optional<double> min_wall_mm;
};

struct Verdict {
  solid::MeshReport mesh;
  bool examined = true;            ///< false: no mesh was made, `mesh` holds only problems
  std::optional<double> wall_mm;   ///< of pots; a mesh is not measured
  std::vector<std::string> notes;  ///< sound, but worth knowing
};

bool is_pot(std::string_view path) { return path.ends_with(".json") || path.ends_with(".cbor"); }

Verdict unsound(std::string what, std::string where) {
  Verdict verdict;
  verdict.examined = false;
  verdict.mesh.problems.push_back({std::move(what), std::move(where), 1});
  return verdict;
}

/// A section that proves a solid, and the mesh that it gives, passing every test.
Verdict check_section(const solid::StackProfile& section, const CheckCommand& command) {
  Verdict verdict;
  if (solid::triangle_count(section.profile, kFewestSegments) <= solid::kMaxTriangles)
    verdict.mesh =
        solid::check_mesh(solid::revolve(section.profile, check_segments(section.profile)));
  else
    verdict.examined = false;
  verdict.wall_mm = solid::min_wall_mm(section.profile);
  for (const solid::PieceShape& shape : section.shapes)
    for (const solid::Cavity& cavity : shape.cavities)
      verdict.notes.push_back(fmt::format(
          "closed cavity from {:.2f} to {:.2f} mm, {:.1f} mm3 trapped: it needs a drain hole",
          cavity.bottom_mm, cavity.top_mm, cavity.volume_mm3));
  if (section.shapes.size() > 1)
    verdict.mesh.problems.push_back(
        {"pieces that do not touch",
         fmt::format("{} pieces; ring {} is the first of the second", section.shapes.size(),
                     section.shapes[1].first_ring),
         section.shapes.size()});
  if (command.min_wall_mm && *verdict.wall_mm < *command.min_wall_mm)
    verdict.mesh.problems.push_back({"thin wall",
                                     fmt::format("{:.3f} mm, expected {:.3f} mm at least",
                                                 *verdict.wall_mm, *command.min_wall_mm),
                                     1});
  return verdict;
}

Result<Verdict> check_pot(std::string_view bytes, const CheckCommand& command) {
  const auto pot = parse_pot(bytes, command.file);
  if (!pot) return tl::make_unexpected(pot.error());
  if (pot->collapse)
    return unsound("collapsed", fmt::format("ring {} yielded at {:.2f} kPa",
                                            pot->collapse->failed_ring, pot->collapse->stress_kpa));
  const auto section = solid::profile_of(pot->stack);
  if (!section) return unsound("no solid", section.error().message);
  if (const auto certificate = solid::certify(section->profile); !certificate)
    return unsound("no certificate", certificate.error().message);
  return check_section(*section, command);
}

/// What a Draco file of ours states of itself; its checksum has been found to hold.
void check_claims(std::string_view bytes, const solid::TriangleMesh& mesh, Verdict& verdict) {
  const auto claims = solid::drc_claims(bytes, {}).value_or(std::nullopt);
  if (!claims) return;
  verdict.notes.push_back("checksum holds");
  for (auto& problem : solid::compare_with_claims(mesh, *claims))
    verdict.mesh.problems.push_back(std::move(problem));
}

Result<Verdict> check_file(const CheckCommand& command) {
  const auto bytes = read_file(command.file);
  if (!bytes) return tl::make_unexpected(bytes.error());
  if (is_pot(command.file)) return check_pot(*bytes, command);
  const auto format = solid::mesh_format_of(command.file);
  if (!format)
    return failure(ErrorKind::bad_input,
                   format.error().message + ", or a pot: .pot.json, .pot.cbor");
  if (command.min_wall_mm)
    return failure(ErrorKind::bad_input,
                   command.file + ": --min-wall is for pots; the wall of a mesh is not measured");
  return solid::decode_mesh(*bytes, *format, command.file)
      .map([&](const solid::TriangleMesh& mesh) {
        Verdict verdict;
        verdict.mesh = solid::check_mesh(mesh);
        if (*format == solid::MeshFormat::drc) check_claims(*bytes, mesh, verdict);
        return verdict;
      });
}

Json verdict_json(const std::string& file, const Verdict& verdict) {
  const solid::MeshReport& mesh = verdict.mesh;
  Json json = {{"file", file},
               {"sound", mesh.sound()},
               {"closed", mesh.closed},
               {"manifold", mesh.manifold},
               {"oriented", mesh.oriented},
               {"self_intersections", mesh.self_intersections},
               {"bounds_volume", mesh.bounds_volume},
               {"components", mesh.components},
               {"degenerate", mesh.degenerate},
               {"triangles", mesh.triangles},
               {"volume_mm3", mesh.volume_mm3},
               {"problems", Json::array()}};
  if (verdict.wall_mm) json["min_wall_mm"] = *verdict.wall_mm;
  json["notes"] = verdict.notes;
  for (const auto& problem : mesh.problems)
    json["problems"].push_back(
        {{"what", problem.what}, {"where", problem.where}, {"count", problem.count}});
  return json;
}

void tell(const Console& console, const std::string& file, const Verdict& verdict) {
  const solid::MeshReport& mesh = verdict.mesh;
  console.say(fmt::format("{}: {}", file, mesh.sound() ? "sound" : "NOT SOUND"));
  const auto yes = [](bool value) { return value ? "yes" : "no"; };
  if (verdict.examined) {
    console.say(fmt::format(
        "  closed {}, manifold {}, oriented {}, bounds a volume {}, self-intersections {}",
        yes(mesh.closed), yes(mesh.manifold), yes(mesh.oriented), yes(mesh.bounds_volume),
        mesh.self_intersections));
    console.say(fmt::format("  {} triangles, {} component(s), {:.3f} cm3", mesh.triangles,
                            mesh.components, mesh.volume_mm3 / 1000.0));
  }
  if (verdict.wall_mm) console.say(fmt::format("  thinnest {:.3f} mm", *verdict.wall_mm));
  for (const std::string& note : verdict.notes) console.say("  note: " + note);
  for (const auto& problem : mesh.problems)
    console.say(fmt::format("  {} ({}): {}", problem.what, problem.count, problem.where));
}

int check(const CheckCommand& command, const Console& console) {
  const auto verdict = check_file(command);
  if (!verdict) {
    if (console.json) {
      console.print(verdict_json(command.file, unsound("unreadable", verdict.error().message)));
    }
    return report(verdict.error());
  }
  if (console.json) console.print(verdict_json(command.file, *verdict));
  tell(console, command.file, *verdict);
  return verdict->mesh.sound() ? kDone : kUnsound;
}

}  // namespace

void add_check_command(CLI::App& app, Console& console, int& exit) {
  auto command = std::make_shared<CheckCommand>();
  CLI::App* sub =
      app.add_subcommand("check", "Say what is wrong with a pot or anyone's mesh, and where");
  sub->add_option("file", command->file, ".stl, .obj, .drc, .pot.json or .pot.cbor")->required();
  sub->add_option("--min-wall", command->min_wall_mm, "Least wall that passes, for pots [mm]")
      ->check(in_range(1e-6, 1e4));
  sub->footer(
      "\nExamples:\n  claystack check bowl.stl\n  claystack check bowl.pot.json --min-wall 3 "
      "--json");
  sub->callback([command, &console, &exit] { exit = check(*command, console); });
}

}  // namespace clay::app
