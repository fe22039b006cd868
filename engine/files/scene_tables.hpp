#pragma once
// The tables of the parts of a scene that a pot remembers, for the files of both.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool_names.hpp"
#include "core/json/object_reader.hpp"
#include "core/json/object_writer.hpp"
#include "core/text.hpp"
#include "engine/clay/scene_ranges.hpp"

#include <array>
#include <string>
#include <string_view>

namespace clay::files {

inline constexpr Range kToolSizeMm = above(0).to(kMaxRadiusMm);
inline constexpr std::array<std::string_view, 2> kSwitchNames = {"off", "on"};
inline constexpr std::array<std::string_view, 2> kThinWallNames = {"stops", "yields"};
inline constexpr std::array<std::string_view, 2> kPressedRimNames = {"bends", "sinks"};
inline constexpr std::array<std::string_view, 2> kNarrowRimNames = {"rises", "closes"};
inline constexpr std::array<std::string_view, 2> kLiftedWallNames = {"grows", "stretches"};
inline constexpr std::array<std::string_view, 2> kPushedWallNames = {"thins", "bends"};
inline constexpr std::array<std::string_view, 2> kSpongeNames = {"levels", "follows"};
inline constexpr std::array<std::string_view, 2> kPressedLumpNames = {"flares", "stretches"};
inline constexpr std::array<std::string_view, 2> kThinRimNames = {"grows", "rises"};
inline constexpr std::array<std::string_view, 2> kWheelTurnNames = {"clockwise",
                                                                    "counterclockwise"};

}  // namespace clay::files

// In this namespace, where the writer and the reader look up the tables of their types.
namespace clay {

void describe(auto& io, Is<SphereSpec> auto& sphere) {
  io.number("radius_mm", sphere.radius_mm, files::kToolSizeMm);
}

void describe(auto& io, Is<EllipseSpec> auto& ellipse) {
  io.number("half_height_mm", ellipse.half_height_mm, files::kToolSizeMm);
  io.number("half_width_mm", ellipse.half_width_mm, files::kToolSizeMm);
}

void describe(auto& io, Is<RibSpec> auto& rib) {
  io.number("height_mm", rib.height_mm, files::kToolSizeMm);
  io.number("radius_mm", rib.radius_mm, files::kToolSizeMm);
}

void describe(auto& io, Is<SampledSpec> auto& sampled) {
  io.require({"t_mm", "f_mm"});
  io.numbers("t_mm", sampled.t_mm, from(-kMaxRadiusMm).to(kMaxRadiusMm));
  io.numbers("f_mm", sampled.f_mm, from(0).to(kMaxRadiusMm));
  io.check([&](ObjectReader& reader) {
    const auto& t = sampled.t_mm;
    reader.expect(t.size() >= 2, "t_mm", "two numbers at least");
    reader.expect(sampled.f_mm.size() == t.size(), "f_mm",
                  "as many numbers as t_mm, " + std::to_string(t.size()));
    for (std::size_t i = 1; i < t.size(); ++i)
      reader.expect_element(t[i] > t[i - 1], "t_mm", i, "more than " + number_text(t[i - 1]));
  });
}

void describe(auto& io, Is<ToolSpec> auto& tool) {
  io.one_of("shape", tool.shape, kToolShapeNames);
  io.choice("mode", tool.mode, kToolModeNames);
  io.number("gap_mm", tool.gap_mm, ranges::kGapMm);
  io.check([&](ObjectReader& reader) {
    if (tool.mode == ToolMode::pinch) reader.require({"gap_mm"});
  });
}

void describe(auto& io, Is<RemovalSpec> auto& removal) {
  io.number("rate_per_s", removal.rate_per_s, ranges::kRatePerS);
  io.number("yield_depth_mm", removal.yield_depth_mm, ranges::kYieldDepthMm);
  io.number("min_wall_mm", removal.min_wall_mm, ranges::kMinWallMm);
  io.number("paper_fraction", removal.paper_fraction, ranges::kPaperFraction);
}

void describe(auto& io, Is<FlowSpec> auto& flow) {
  io.number("sigma_mm", flow.sigma_mm, ranges::kSigmaMm);
  io.number("reach_mm", flow.reach_mm, ranges::kReachMm);
  io.number("inside_share", flow.inside_share, ranges::kInsideShare);
}

void describe(auto& io, Is<ForceSpec> auto& force) {
  io.number("stiffness_n_per_mm2", force.stiffness_n_per_mm2, ranges::kStiffness);
  io.number("limit_n", force.limit_n, ranges::kForceLimitN);
  io.number("friction", force.friction, ranges::kFriction);
  io.choice("wheel", force.counterclockwise, files::kWheelTurnNames);
  io.number("paper_stiffness_n_per_mm", force.paper_stiffness_n_per_mm, ranges::kPaperStiffness);
}

void describe(auto& io, Is<StabilitySpec> auto& stability) {
  io.number("max_stress_kpa", stability.max_stress_kpa, ranges::kMaxStressKpa);
}

void describe(auto& io, Is<ClaySpec> auto& clay) {
  io.choice("lift", clay.lift, files::kSwitchNames);
  io.choice("shift", clay.shift, files::kSwitchNames);
  io.choice("rim", clay.rim, files::kSwitchNames);
  io.choice("hoop", clay.hoop, files::kSwitchNames);
  io.choice("heave", clay.heave, files::kSwitchNames);
  io.choice("smear", clay.smear, files::kSwitchNames);
  io.number("wheel_rpm", clay.wheel_rpm, ranges::kWheelRpm);
  io.number("floor_mm", clay.floor_mm, ranges::kFloorMm);
  io.number("finger_mm", clay.finger_mm, ranges::kFingerMm);
  io.number("finger_behind", clay.finger_behind, ranges::kFingerBehind);
  io.number("heave_slope", clay.heave_slope, ranges::kHeaveSlope);
  io.choice_unless(false, "thin_wall", clay.thin_wall_yields, files::kThinWallNames);
  io.choice_unless(false, "pressed_rim", clay.rim_sinks, files::kPressedRimNames);
  io.choice_unless(false, "narrow_rim", clay.narrow_rim_closes, files::kNarrowRimNames);
  io.choice_unless(false, "lifted_wall", clay.lifted_wall_stretches, files::kLiftedWallNames);
  io.choice_unless(false, "pushed_wall", clay.pushed_wall_bends, files::kPushedWallNames);
  io.choice_unless(false, "sponge", clay.sponge_follows, files::kSpongeNames);
  io.choice_unless(false, "pressed_lump", clay.pressed_lump_stretches, files::kPressedLumpNames);
  io.choice_unless(false, "thin_rim", clay.thin_rim_rises, files::kThinRimNames);
}

void describe(auto& io, Is<ThrowSettings> auto& settings) {
  io.require({"tool"});
  io.part("tool", settings.tool);
  io.part("removal", settings.removal);
  io.part("flow", settings.flow);
  io.part("force", settings.force);
  io.part("stability", settings.stability);
  io.part("clay", settings.clay);
}

}  // namespace clay
