#include "app/cli/import_mesh.hpp"

#include "app/cli/json_output.hpp"
#include "app/cli/mesh_input.hpp"
#include "app/cli/mesh_unit.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/pot_input.hpp"
#include "app/import/mesh_warnings.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"
#include "core/size_text.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::cli {
namespace {

using namespace importing;

/// Measured: memory of mesh_pot, in addition to that of the mesh.
constexpr std::uint64_t kImportBytesPerTriangle = 100;
constexpr const char* kScaleHint = "; --height MM scales it";

Json vector_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Json summary(const std::string& name, const solid::TriangleMesh& mesh,
             const std::optional<double>& mesh_mm3, const MeshPot& made,
             const std::vector<std::string>& notes, const std::vector<std::string>& warnings) {
  Json parts = Json::array();
  for (const MeshPart& part : made.parts)
    parts.push_back({{"azimuth_deg", {part.from_deg, part.to_deg}},
                     {"height_mm", {part.low_mm, part.high_mm}},
                     {"off_mm", part.off_mm}});
  const ClayStack& stack = made.pot.stack;
  const bool known = made.measured > 0;
  return {{"mesh", name},
          {"triangles", mesh.triangles.size()},
          {"mesh_mm3", mesh_mm3 ? Json(*mesh_mm3) : Json()},
          {"foot_mm", vector_json(made.axis.through)},
          {"axis", vector_json(made.axis.direction)},
          {"rings", stack.size()},
          {"ring_height_mm", stack.ring_height_mm()},
          {"height_mm", stack.height_mm()},
          {"volume_mm3", stack.volume_mm3()},
          {"deviation_mm", known ? Json(made.deviation.mm) : Json()},
          {"deviation_at_mm",
           known ? Json{made.deviation.radius_mm, made.deviation.height_mm} : Json()},
          {"deviation_half_planes", {made.measured, kMeshCuts}},
          {"not_of_revolution", std::move(parts)},
          {"noise_mm", made.noise_mm},
          {"notes", notes},
          {"warnings", warnings}};
}

/// Without the sign of a negative zero.
glm::dvec3 rounded(const glm::dvec3& v, double step) {
  return {rounded_to(v.x, step), rounded_to(v.y, step), rounded_to(v.z, step)};
}

/// A direction about the axis, from 0 to 359 degrees.
int whole_degrees(double degrees) {
  return ((static_cast<int>(std::lround(degrees)) % 360) + 360) % 360;
}

std::string deviation_text(const MeshPot& made) {
  if (made.measured == 0)
    return "deviation from the mesh: not measured, no half-plane through the axis has a complete "
           "wall";
  std::string text = text_of(made.deviation, "mesh");
  if (made.measured < kMeshCuts)
    text += fmt::format(", in {} of {} half-planes through the axis", made.measured, kMeshCuts);
  return text;
}

void print_summary(const Console& console, const MeshPot& made,
                   const std::optional<double>& mesh_mm3) {
  const glm::dvec3 foot = rounded(made.axis.through, 1e-3), up = rounded(made.axis.direction, 1e-5);
  const ClayStack& stack = made.pot.stack;
  console.print(
      fmt::format("axis through ({:.3f}, {:.3f}, {:.3f}) mm along ({:.5f}, {:.5f}, {:.5f})", foot.x,
                  foot.y, foot.z, up.x, up.y, up.z));
  console.print(fmt::format(
      "{} of {:.4g} mm: {} mm high, {} cm3 of clay{}", counted(stack.size(), "ring"),
      stack.ring_height_mm(), size_text(stack.height_mm(), 1),
      size_text(stack.volume_mm3() / 1e3, 1),
      mesh_mm3 ? " (" + size_text(*mesh_mm3 / 1e3, 1) + " cm3 in the mesh)" : std::string()));
  console.print(deviation_text(made));
  for (const MeshPart& part : made.parts)
    console.print(fmt::format(
        "not of revolution, left out: azimuth {} to {} degrees, {:.1f} to {:.1f} mm above the "
        "foot, up to {:.1f} mm off",
        whole_degrees(part.from_deg), whole_degrees(part.to_deg), rounded_to(part.low_mm, 0.1),
        part.high_mm, part.off_mm));
}

/// Each with the file or option that it is about.
std::vector<std::string> all_warnings(const std::string& path, const MeshPotSettings& settings,
                                      const MeshPot& made, const solid::MeshEnclosure& enclosure,
                                      const std::optional<std::string>& doubt) {
  std::vector<std::string> warnings = mesh_warnings(made, enclosure, settings.rings);
  for (std::string& warning : warnings) warning = path + ": " + warning;
  if (const auto low = low_pot_warning(settings))
    warnings.push_back("--height: " + *low);
  else if (doubt && !settings.height_mm)
    warnings.push_back(path + ": " + *doubt + kScaleHint);
  return warnings;
}

}  // namespace

Result<void> import_mesh(const std::string& path, const std::string& pot,
                         const MeshPotSettings& settings, const Console& console) {
  const auto format = solid::mesh_format_of(path);
  if (!format) return tl::make_unexpected(format.error());
  Progress progress(console, "importing", 0);
  progress.stage("reading");
  std::vector<std::string> notes;
  const auto mesh = MeshFile::open(path, *format).and_then([&](MeshFile file) {
    return file.read({"importing", kImportBytesPerTriangle}, {.notes = &notes});
  });
  if (!mesh) return tl::make_unexpected(mesh.error());
  if (carries_pot(path))
    notes.emplace_back(
        "the file also carries its exact pot, before any shrinkage: claystack throw "
        "--from and claystack export read it");
  progress.stage("finding the axis and making rings");
  const auto made = mesh_pot(*mesh, settings, path);
  const auto doubt = doubted_unit(solid::extent_of(*mesh).size(), *format);
  if (!made && doubt)
    return failure(made.error().kind, made.error().message + "; " + *doubt + kScaleHint);
  if (!made) return tl::make_unexpected(made.error());
  const solid::MeshEnclosure enclosure = solid::enclosure_of(*mesh);
  const PotEncoding encoding = pot_encoding_of(pot).value_or(PotEncoding::json);
  if (auto room = expect_room_to_write(made->pot.stack.size(), encoding, pot); !room) return room;
  if (auto done = publish(pot, write_pot(made->pot, encoding)); !done) return done;
  std::optional<double> mesh_mm3 = enclosure.volume_mm3;
  if (mesh_mm3) mesh_mm3 = std::abs(*mesh_mm3) * std::pow(made->scale, 3);
  const auto warnings = all_warnings(path, settings, *made, enclosure, doubt);
  if (console.json) print_json(summary(path, *mesh, mesh_mm3, *made, notes, warnings));
  print_summary(console, *made, mesh_mm3);
  for (const std::string& note : notes) console.print("note: " + note);
  for (const std::string& warning : warnings) console.warn(warning);
  console.print("pot: " + pot);
  return {};
}

}  // namespace clay::cli
