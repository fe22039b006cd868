#include "claystack/engine/files.hpp"

#include "claystack/engine/clay.hpp"
#include "core/json/json_text.hpp"
#include "core/json/object_reader.hpp"
#include "core/json/object_writer.hpp"
#include "core/text.hpp"
#include "engine/files/scene_json.hpp"
#include "engine/files/scene_tables.hpp"

#include <string_view>
#include <utility>

namespace clay {
namespace {

using namespace files;

constexpr std::size_t kMaxValues = 100'000;

}  // namespace

// In this namespace, where the writer and the reader look up the tables of their types.

static void describe(auto& io, Is<LumpSpec> auto& lump) {
  io.integer("rings", lump.rings, 1, kMaxRings);
  io.number("ring_height_mm", lump.ring_height_mm, ranges::kRingHeightMm);
  io.number("outer_radius_mm", lump.outer_radius_mm, from(kMinRadiusMm).to(kMaxRadiusMm));
  io.number("inner_radius_mm", lump.inner_radius_mm, from(0).below(kMaxRadiusMm));
  io.integer("max_rings", lump.max_rings, 0, kMaxRings);
  io.number("density_g_cm3", lump.density_g_cm3, ranges::kDensity);
  io.check([&](ObjectReader& reader) {
    reader.expect(lump.inner_radius_mm < lump.outer_radius_mm, "inner_radius_mm",
                  "less than outer_radius_mm, " + number_text(lump.outer_radius_mm));
    reader.expect(lump.max_rings == 0 || lump.max_rings >= lump.rings, "max_rings",
                  "0 or at least rings, " + std::to_string(lump.rings));
  });
}

static void describe(auto& io, Is<SceneSpec> auto& scene) {
  io.require({"schema", "lump", "tool"});
  io.constant("schema", "claystack-scene-1");
  io.written_by();
  io.text("name", scene.name);
  io.choice("model", scene.model, kModelNames);
  io.part("lump", scene.lump);
  io.part("tool", scene.tool);
  io.part("removal", scene.removal);
  io.part("flow", scene.flow);
  io.part("force", scene.force);
  io.part("stability", scene.stability);
  io.part("clay", scene.clay);
}

Json files::scene_json(const SceneSpec& scene) { return ObjectWriter::write(scene); }

Result<SceneSpec> files::scene_of(const LocatedJson& document) {
  SceneSpec defaults;
  defaults.force.reset();
  return ObjectReader::read(document, std::move(defaults));
}

Result<SceneSpec> parse_scene(std::string_view text, std::string_view name) {
  return LocatedJson::from_json(text, name, kMaxValues)
      .and_then(scene_of)
      .map_error([&](Error error) {
        return kind_error(std::move(error), text, name, "a scene (.scene.json)");
      });
}

std::string write_scene(const SceneSpec& scene) { return json_text(scene_json(scene)); }

}  // namespace clay
