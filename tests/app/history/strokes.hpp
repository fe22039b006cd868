#pragma once
// Strokes for works, and their results by plain throwing.

#include "app/history/work.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace clay::test {

inline SceneSpec small_scene(double radius_mm = 8.0, ToolMode mode = ToolMode::press) {
  SceneSpec scene;
  scene.name = "small";
  scene.lump = {.rings = 30,
                .ring_height_mm = 1.0,
                .outer_radius_mm = 30.0,
                .inner_radius_mm = 0.0,
                .max_rings = 0,
                .density_g_cm3 = 1.9};
  scene.tool.shape = SphereSpec{radius_mm};
  scene.tool.mode = mode;
  scene.removal.rate_per_s = 60.0;
  scene.flow = {.sigma_mm = 3.0, .reach_mm = 10.0, .inside_share = 0.27};
  return scene;
}

/// From the side into the clay, upward, and out again; `seed` sets the place. About 180 poses.
inline std::vector<Pose> press_stroke(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  const double y = uniform(3.0, 30.0), deep = uniform(24.0, 36.0), up = uniform(-6.0, 6.0);
  std::vector<Pose> poses;
  for (int i = 0; i <= 180; ++i) {
    const double t = i / 180.0, in = std::sin(3.14159265 * t);
    poses.push_back(
        quantized({1000 * i, {60.0 + (deep - 60.0) * in, y + up * t, 0.0}, false, 0.0}));
  }
  return poses;
}

/// As a recorder does, in blocks.
inline void record(const std::vector<Pose>& poses, PoseSink& sink, bool touching = true) {
  std::array<bool, kPosesPerBlock> contact{};
  contact.fill(touching);
  for (std::size_t at = 0; at < poses.size(); at += kPosesPerBlock) {
    const auto block = std::span(poses).subspan(at, std::min(kPosesPerBlock, poses.size() - at));
    ASSERT_TRUE(sink.append({block, std::span(contact).first(block.size())}));
  }
  ASSERT_TRUE(sink.finish());
}

inline Pot plainly_thrown(const SceneSpec& scene, const Pot& before,
                          const std::vector<Pose>& poses) {
  Wheel wheel = Wheel::build(scene, before).value();
  for (const Pose& pose : poses) wheel.step(pose);
  return wheel.pot();
}

/// The pot of a node, replayed without any cache.
inline Pot plainly_thrown(const WorkRecord& record, std::size_t node) {
  const SceneSpec& first = record.scenes[record.nodes[0].scene];
  Pot pot = record.start ? *record.start : Wheel::build(first).value().pot();
  for (const std::size_t at : way_to(record.nodes, node))
    if (at > 0)
      pot = plainly_thrown(record.scenes[record.nodes[at].scene], pot, record.nodes[at].poses);
  return pot;
}

/// Some strokes, with undo and redo between them.
inline history::Work arbitrary_work(int actions) {
  auto work = history::Work::begin(small_scene()).value();
  const std::vector<SceneSpec> tools = {small_scene(), small_scene(5.0),
                                        small_scene(8.0, ToolMode::trim)};
  for (int i = 0; i < actions; ++i) {
    const int what = *rc::gen::inRange(0, 10);
    if (what < 5)
      (void)work.add(*rc::gen::elementOf(tools), press_stroke(*rc::gen::inRange(0u, 1000u)))
          .value();
    else if (what < 7)
      work.undo();
    else if (what < 8)
      work.redo();
    else
      work.go_to(*rc::gen::inRange<std::size_t>(0, work.size()));
  }
  return work;
}

}  // namespace clay::test
