#include "app/python/made_pot.hpp"

#include "app/cli/mesh_unit.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/session_check.hpp"
#include "app/import/drawing_warnings.hpp"
#include "app/import/drawn_pot.hpp"
#include "app/import/mesh_warnings.hpp"
#include "app/import/pot_ranges.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/solid.hpp"
#include "core/text.hpp"

#include <utility>

namespace clay::python {
namespace {

/// Plays every pose, and adds a warning for poses that were not played.
void play(Wheel& wheel, const Session& session, std::vector<std::string>& warnings) {
  std::size_t refused = 0;
  bool ring_limit = false;
  for (const Pose& pose : session.poses) {
    const auto flags = wheel.step(pose).flags;
    refused += (flags & kRefused) != 0;
    ring_limit = ring_limit || (flags & kRingLimit) != 0;
  }
  for (std::string& warning : cli::replay_warnings(refused, ring_limit))
    warnings.push_back(std::move(warning));
}

/// Of a ring with these radii; empty: none.
std::string problem_with(double outer_mm, double inner_mm) {
  for (const double radius : {outer_mm, inner_mm})
    if (!(radius >= 0.0 && radius <= kMaxRadiusMm))
      return "expected radii from 0 to 5000 mm, found " + number_text(radius);
  if (!(inner_mm < outer_mm))
    return "expected an inner radius below the outer one of " + number_text(outer_mm) +
           " mm, found " + number_text(inner_mm);
  return {};
}

Result<MadePot> pot_of_mesh(const std::string& path, const std::string& bytes,
                            solid::MeshFormat format, const ImportSettings& asked) {
  if (asked.wall_mm)
    return failure(ErrorKind::bad_input, "wall_mm: expected a drawing, found the mesh " + path);
  auto mesh = solid::decode_mesh(bytes, format, path);
  if (!mesh) return tl::make_unexpected(mesh.error());
  const solid::MeshEnclosure enclosure = solid::enclosure_of(*mesh);
  const importing::MeshPotSettings settings{asked.height_mm, {}};
  const auto doubt = cli::doubted_unit(solid::extent_of(*mesh).size(), format);
  auto made = importing::mesh_pot(std::move(*mesh), settings, path);
  if (!made) return failure(made.error().kind, made.error().message + (doubt ? "; " + *doubt : ""));
  std::vector<std::string> warnings = importing::mesh_warnings(*made, enclosure, settings.rings);
  if (!made->parts.empty())
    warnings.push_back("not of revolution, left out: " + counted(made->parts.size(), "part"));
  if (doubt && !settings.height_mm) warnings.push_back(*doubt);
  for (std::string& warning : warnings) warning = path + ": " + warning;
  if (const auto low = importing::low_pot_warning(settings))
    warnings.push_back("height_mm: " + *low);
  return MadePot{std::move(made->pot), std::move(warnings)};
}

Result<MadePot> pot_of_drawing(const std::string& path, const std::string& bytes,
                               const ImportSettings& asked) {
  importing::DrawnPotSettings settings;
  settings.wall_mm = asked.wall_mm;
  importing::HalfSectionSettings section_settings;
  section_settings.height_mm = asked.height_mm;
  auto section = importing::read_half_section(bytes, path, {}, section_settings);
  if (!section) return tl::make_unexpected(section.error());
  auto drawn = importing::drawn_pot(*section, settings, path);
  if (!drawn) return tl::make_unexpected(drawn.error());
  std::vector<std::string> warnings = std::move(section->notes);
  for (std::string& warning : importing::drawing_warnings(*section, *drawn, settings, path))
    warnings.push_back(std::move(warning));
  return MadePot{std::move(drawn->pot), std::move(warnings)};
}

Result<void> expect_within(const char* keyword, const std::optional<double>& mm,
                           const Range& range) {
  if (!mm || range.holds(*mm)) return {};
  return failure(ErrorKind::bad_input, std::string(keyword) + ": expected " + range.text() +
                                           " mm, found " + number_text(*mm) + " mm");
}

}  // namespace

Result<MadePot> throw_pot(const std::string& scene_path, const std::string& session_path) {
  const auto scene = read_file(scene_path).and_then([&](const std::string& text) {
    return parse_scene(text, scene_path);
  });
  if (!scene) return tl::make_unexpected(scene.error());
  const auto session =
      read_file(session_path, kMaxSessionBytes).and_then([&](const std::string& text) {
        return parse_session(text, session_path);
      });
  if (!session) return tl::make_unexpected(session.error());
  const cli::ReplayFiles files{session_path, scene_path, {}};
  if (auto known = cli::check_gaps(*session, *scene, files); !known)
    return tl::make_unexpected(known.error());
  auto wheel = Wheel::build(*scene);
  if (!wheel) return failure(wheel.error().kind, scene_path + ": " + wheel.error().message);
  std::vector<std::string> warnings = cli::session_warnings(*session, *scene, files, false);
  play(*wheel, *session, warnings);
  return MadePot{wheel->pot(), std::move(warnings)};
}

Result<MadePot> import_pot(const std::string& path, const ImportSettings& settings) {
  if (auto within = expect_within("height_mm", settings.height_mm, importing::kPotHeightRange);
      !within)
    return tl::make_unexpected(within.error());
  if (auto within = expect_within("wall_mm", settings.wall_mm, importing::kDrawnWallRange); !within)
    return tl::make_unexpected(within.error());
  const auto format = solid::mesh_format_of(path);
  const auto bytes = read_file(path);
  if (!bytes) return tl::make_unexpected(bytes.error());
  return format ? pot_of_mesh(path, *bytes, *format, settings)
                : pot_of_drawing(path, *bytes, settings);
}

Result<Pot> stacked(double ring_height_mm, const std::vector<double>& outer_mm,
                    const std::vector<double>& inner_mm, double density_g_cm3) {
  if (outer_mm.empty())
    return failure(ErrorKind::bad_input, "outer_mm: expected one ring or more, found none");
  if (outer_mm.size() != inner_mm.size())
    return failure(ErrorKind::bad_input, "inner_mm: expected " + std::to_string(outer_mm.size()) +
                                             " radii, as many as outer_mm, found " +
                                             std::to_string(inner_mm.size()));
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < outer_mm.size(); ++i) {
    if (const std::string problem = problem_with(outer_mm[i], inner_mm[i]); !problem.empty())
      return failure(ErrorKind::bad_input, "ring " + std::to_string(i) + ": " + problem);
    rings.push_back({quanta_from_radius(outer_mm[i]), quanta_from_radius(inner_mm[i])});
  }
  const std::size_t count = rings.size();
  auto stack = ClayStack::from_rings(ring_height_mm, std::move(rings), 0, count);
  if (!stack) return tl::make_unexpected(stack.error());
  const Ledger ledger{.initial = stack->recount()};
  const Pot pot{std::move(*stack), ledger, Model::conserving, density_g_cm3, {}, {}};
  // The reader of pots has the ranges, such as that of the density.
  return parse_pot(write_pot(pot, PotEncoding::cbor), "stack");
}

Result<void> write_named_pot(const Pot& pot, const std::string& path) {
  const auto encoding = cli::pot_encoding_of(path);
  if (!encoding)
    return failure(ErrorKind::bad_input,
                   path + ": expected a name that ends in .pot.json or .pot.cbor");
  return publish(path, write_pot(pot, *encoding));
}

}  // namespace clay::python
