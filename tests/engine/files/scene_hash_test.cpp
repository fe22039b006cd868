#include "claystack/engine/files.hpp"
#include "tests/engine/files/arbitrary.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <string_view>

namespace clay {
namespace {

std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

TEST(SceneHash, IgnoresTheWritingVersion) {
  ASSERT_EQ(fnv1a("foobar"), 0x85944171f73967e8u);  // test vector of the FNV authors
  const SceneSpec scene;
  std::string text = write_scene(scene);
  const auto stamp = text.find("  \"written_by\"");
  ASSERT_NE(stamp, std::string::npos);
  text.erase(stamp, text.find('\n', stamp) + 1 - stamp);
  EXPECT_EQ(hash_of(scene), fnv1a(text));
}

/// Sessions name the hash of their scene, and many were recorded before there were these settings.
TEST(SceneHash, OmitsAWallAndARimThatStay) {
  SceneSpec scene;
  scene.clay = ClaySpec{};
  EXPECT_EQ(write_scene(scene).find("finger"), std::string::npos);
  EXPECT_EQ(write_scene(scene).find("thin_wall"), std::string::npos);
  EXPECT_EQ(write_scene(scene).find("pressed_rim"), std::string::npos);
  EXPECT_EQ(write_scene(scene).find("narrow_rim"), std::string::npos);
  EXPECT_EQ(write_scene(scene).find("lifted_wall"), std::string::npos);
  EXPECT_EQ(write_scene(scene).find("pushed_wall"), std::string::npos);
  EXPECT_EQ(write_scene(scene).find("heave_slope"), std::string::npos);
  for (const char* name : {"sponge", "pressed_lump", "thin_rim"})
    EXPECT_EQ(write_scene(scene).find(name), std::string::npos) << name;
  scene.clay->thin_wall_yields = scene.clay->rim_sinks = true;
  scene.clay->narrow_rim_closes = scene.clay->lifted_wall_stretches = true;
  scene.clay->pushed_wall_bends = true;
  scene.clay->sponge_follows = scene.clay->pressed_lump_stretches = true;
  scene.clay->thin_rim_rises = true;
  for (const char* name : {"sponge", "pressed_lump", "thin_rim"})
    EXPECT_NE(write_scene(scene).find(name), std::string::npos) << name;
  EXPECT_NE(write_scene(scene).find("thin_wall"), std::string::npos);
  EXPECT_NE(write_scene(scene).find("pressed_rim"), std::string::npos);
  EXPECT_NE(write_scene(scene).find("narrow_rim"), std::string::npos);
  EXPECT_NE(write_scene(scene).find("lifted_wall"), std::string::npos);
  EXPECT_NE(write_scene(scene).find("pushed_wall"), std::string::npos);
}

RC_GTEST_PROP(SceneHash, DistinguishesScenes, ()) {
  const SceneSpec a = test::arbitrary_scene();
  const SceneSpec b = test::arbitrary_scene();
  RC_ASSERT((hash_of(a) == hash_of(b)) == (a == b));
}

}  // namespace
}  // namespace clay
