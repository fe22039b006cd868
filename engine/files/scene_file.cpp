#include "claystack/engine/files.hpp"

#include "claystack/engine/clay.hpp"
#include "core/json/json_text.hpp"
#include "core/json/object_reader.hpp"
#include "core/json/object_writer.hpp"
#include "core/text.hpp"
#include "engine/files/scene_json.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace clay {
namespace {

using namespace files;

constexpr std::size_t kMaxValues = 100'000;
constexpr Range kToolSizeMm = above(0).to(kMaxRadiusMm);
constexpr std::array<std::string_view, 4> kShapeNames = {"sphere", "ellipse", "rib", "sampled"};
constexpr std::array<std::string_view, 7> kToolModeNames = {"press",  "trim", "pinch",    "smooth",
                                                            "needle", "wire", "trim_foot"};
constexpr std::array<std::string_view, 2> kSwitchNames = {"off", "on"};
constexpr std::array<std::string_view, 2> kWheelTurnNames = {"clockwise", "counterclockwise"};

}  // namespace

// In this namespace, where the writer and the reader look up the tables of their types.

static void describe(auto& io, Is<LumpSpec> auto& lump) {
  io.integer("rings", lump.rings, 1, kMaxRings);
  io.number("ring_height_mm", lump.ring_height_mm, kRingHeightMm);
  io.number("outer_radius_mm", lump.outer_radius_mm, from(kMinRadiusMm).to(kMaxRadiusMm));
  io.number("inner_radius_mm", lump.inner_radius_mm, from(0).below(kMaxRadiusMm));
  io.integer("max_rings", lump.max_rings, 0, kMaxRings);
  io.number("density_g_cm3", lump.density_g_cm3, kDensity);
  io.check([&](ObjectReader& reader) {
    reader.expect(lump.inner_radius_mm < lump.outer_radius_mm, "inner_radius_mm",
                  "less than outer_radius_mm, " + shortest(lump.outer_radius_mm));
    reader.expect(lump.max_rings == 0 || lump.max_rings >= lump.rings, "max_rings",
                  "0 or at least rings, " + std::to_string(lump.rings));
  });
}

static void describe(auto& io, Is<SphereSpec> auto& sphere) {
  io.number("radius_mm", sphere.radius_mm, kToolSizeMm);
}

static void describe(auto& io, Is<EllipseSpec> auto& ellipse) {
  io.number("half_height_mm", ellipse.half_height_mm, kToolSizeMm);
  io.number("half_width_mm", ellipse.half_width_mm, kToolSizeMm);
}

static void describe(auto& io, Is<RibSpec> auto& rib) {
  io.number("height_mm", rib.height_mm, kToolSizeMm);
  io.number("radius_mm", rib.radius_mm, kToolSizeMm);
}

static void describe(auto& io, Is<SampledSpec> auto& sampled) {
  io.require({"t_mm", "f_mm"});
  io.numbers("t_mm", sampled.t_mm, from(-kMaxRadiusMm).to(kMaxRadiusMm));
  io.numbers("f_mm", sampled.f_mm, from(0).to(kMaxRadiusMm));
  io.check([&](ObjectReader& reader) {
    const auto& t = sampled.t_mm;
    reader.expect(t.size() >= 2, "t_mm", "two numbers at least");
    reader.expect(sampled.f_mm.size() == t.size(), "f_mm",
                  "as many numbers as t_mm, " + std::to_string(t.size()));
    for (std::size_t i = 1; i < t.size(); ++i)
      reader.expect_element(t[i] > t[i - 1], "t_mm", i, "more than " + shortest(t[i - 1]));
  });
}

static void describe(auto& io, Is<ToolSpec> auto& tool) {
  io.one_of("shape", tool.shape, kShapeNames);
  io.choice("mode", tool.mode, kToolModeNames);
  io.number("gap_mm", tool.gap_mm, from(1e-3).to(1e3));
  io.check([&](ObjectReader& reader) {
    if (tool.mode == ToolMode::pinch) reader.require({"gap_mm"});
  });
}

static void describe(auto& io, Is<RemovalSpec> auto& removal) {
  io.number("rate_per_s", removal.rate_per_s, from(0).to(1e6));
  io.number("yield_depth_mm", removal.yield_depth_mm, from(1e-3).to(1e3));
  io.number("min_wall_mm", removal.min_wall_mm, from(1e-3).to(1e3));
  io.number("paper_fraction", removal.paper_fraction, from(0).below(1));
}

static void describe(auto& io, Is<FlowSpec> auto& flow) {
  io.number("sigma_mm", flow.sigma_mm, from(0).to(1e9));
  io.number("reach_mm", flow.reach_mm, from(0).to(1e9));
  io.number("inside_share", flow.inside_share, from(0).to(1));
}

static void describe(auto& io, Is<ForceSpec> auto& force) {
  io.number("stiffness_n_per_mm2", force.stiffness_n_per_mm2, from(0).to(1e6));
  io.number("limit_n", force.limit_n, from(0).to(10));
  io.number("friction", force.friction, from(0).to(2));
  io.choice("wheel", force.counterclockwise, kWheelTurnNames);
  io.number("paper_stiffness_n_per_mm", force.paper_stiffness_n_per_mm, from(0).to(1e6));
}

static void describe(auto& io, Is<StabilitySpec> auto& stability) {
  io.number("max_stress_kpa", stability.max_stress_kpa, above(0).to(1e6));
}

static void describe(auto& io, Is<ClaySpec> auto& clay) {
  io.choice("lift", clay.lift, kSwitchNames);
  io.choice("shift", clay.shift, kSwitchNames);
  io.choice("rim", clay.rim, kSwitchNames);
  io.choice("hoop", clay.hoop, kSwitchNames);
  io.choice("heave", clay.heave, kSwitchNames);
  io.choice("smear", clay.smear, kSwitchNames);
  io.number("wheel_rpm", clay.wheel_rpm, from(0).to(1e3));
  io.number("floor_mm", clay.floor_mm, from(0).to(1e6));
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
