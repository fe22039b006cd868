// Drawings that crashed or hung an earlier reader, and parts of DXF that it ignored.
#include "tests/app/import/solids.hpp"
#include "tests/fuzz/drawing_promise.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace clay::importing {
namespace {

using samples::dxf_of;
using testing::HasSubstr;
constexpr double kPi = std::numbers::pi;

std::string drawing_of(const std::string& entities, const std::string& before = "") {
  return dxf_of(before + "0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF");
}

/// A rectangle from the axis, as one polyline; on a layer.
std::string box(double width, double height, const std::string& layer = "0") {
  return fmt::format("0 LWPOLYLINE 8 {} 90 4 70 1 10 0 20 0 10 {} 20 0 10 {} 20 {} 10 0 20 {}",
                     layer, width, width, height, height);
}

double volume(const std::string& bytes) {
  const auto section = section_of(bytes, "pot.dxf", {AxisRule::left, 0.0, {}});
  EXPECT_TRUE(section) << refusal_of(section);
  return section ? section->volume_mm3() : 0.0;
}

std::string problem(const std::string& bytes) {
  return refusal_of(section_of(bytes, "pot.dxf", {AxisRule::left, 0.0, {}}));
}

TEST(DxfFaults, CountsThatDisagreeWithTheirVerticesDoNotMatter) {
  const std::string spline =
      " 0 SPLINE 71 1 72 4 73 2 40 0 40 0 40 1 40 1 10 0 20 0 10 30 20 0 73 9 72 99 74 7";
  for (const std::string& entities :
       {box(30, 60) + " 90 2", box(30, 60) + " 90 999999999 90 0", box(30, 60) + " 90 -5",
        "0 LINE 10 30 20 0 11 30 21 60 0 LINE 10 30 20 60 11 0 21 60" + spline})
    EXPECT_NEAR(volume(drawing_of(entities)), kPi * 900.0 * 60.0, 1e-6) << entities;
}

TEST(DxfFaults, OtherEntitiesDrawNothing) {
  for (const char* other :
       {"0 LEADER 76 9 10 1 20 2", "0 LEADER", "0 HATCH 10 1 20 2", "0 XLINE 10 1 20 2 11 3 21 4",
        "0 DIMENSION 10 5 20 5 13 1 23 1", "0 TEXT 1 words 10 3 20 4", "0 SPLIN 10 x", "0 3DFACE"})
    EXPECT_NEAR(volume(drawing_of(box(30, 60) + " " + other)), kPi * 900.0 * 60.0, 1e-6) << other;
}

TEST(DxfFaults, NamesOutlinesThatAreNotRead) {
  const auto notes = [](const std::string& entities) {
    return section_of(drawing_of(box(30, 60) + entities), "pot.dxf", {AxisRule::left, 0.0, {}})
        .value()
        .notes;
  };
  EXPECT_EQ(notes(" 0 REGION 0 MLINE 0 REGION"),
            std::vector<std::string>{"pot.dxf: expected lines, polylines, arcs, circles, ellipses "
                                     "and splines, found MLINE, REGION too, which is not read"});
  EXPECT_TRUE(notes(" 0 TEXT 1 words 0 DIMENSION 0 REGION 60 1").empty());
  EXPECT_THAT(problem(drawing_of("0 REGION")), HasSubstr("found REGION alone; explode"));
  EXPECT_THAT(problem(drawing_of("0 SPLINE 71 3 74 2 11 0 21 0 11 30 21 60")),
              HasSubstr("expected control points, found fit points alone"));
}

TEST(DxfFaults, ReadsRepeatedLinesOnce) {
  const std::string wall = " 0 LINE 10 30 20 0 11 30 21 60", foot = "0 LINE 10 0 20 0 11 30 21 0",
                    lid = " 0 LINE 10 0 20 60 11 30 21 60", axis = " 0 LINE 10 0 20 0 11 0 21 60",
                    back = " 0 LINE 10 30 20 60 11 30 21 0";
  for (const std::string& twice : {foot + wall + lid + axis + wall, foot + back + wall + lid + axis,
                                   foot + wall + lid + axis + " " + box(30, 60)}) {
    const auto section = section_of(drawing_of(twice), "pot.dxf", {AxisRule::left, 0.0, {}});
    ASSERT_TRUE(section) << refusal_of(section);
    EXPECT_NEAR(section->volume_mm3(), kPi * 900.0 * 60.0, 1e-6) << twice;
    EXPECT_EQ(section->notes,
              std::vector<std::string>{"pot.dxf: expected every line once, found 1 drawn again: "
                                       "each is read once"});
  }
}

TEST(DxfFaults, LinesMayHaveAnyLength) {
  const std::string text(5'000'000, 'a');
  EXPECT_NEAR(volume(dxf_of("999 " + text + " 0 SECTION 2 ENTITIES 0 TEXT 1 " + text + " " +
                            box(30, 60) + " 0 ENDSEC 0 EOF")),
              kPi * 900.0 * 60.0, 1e-6);
}

TEST(DxfFaults, RefusesOtherBytes) {
  EXPECT_THAT(problem("AutoCAD Binary DXF\r\n\x1a"), HasSubstr("save it as ASCII DXF"));
  EXPECT_THAT(problem(std::string(100, '\0')), HasSubstr("found binary data"));
  std::mt19937 random(7);
  for (int run = 0; run < 200; ++run) {
    std::string bytes;
    for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(random());
    EXPECT_THAT(problem(bytes), HasSubstr("pot.dxf"));
  }
  EXPECT_THAT(problem(dxf_of("0 SECTION 2 ENTITIES " + box(3, 6))), HasSubstr("end of the file"));
  EXPECT_THAT(problem(drawing_of("0 LINE 10 1 20 2 11 x 21 4")),
              HasSubstr("pot.dxf:12: expected a number, found \"x\""));
  EXPECT_THAT(problem(drawing_of("0 LINE 10 1 20 2 11 3")),
              HasSubstr("pot.dxf:5: LINE: expected a group 21, found none"));
}

TEST(DxfFaults, LimitsTurnsAndCounts) {
  EXPECT_THAT(problem(drawing_of("0 ARC 10 0 20 0 40 5 50 0 51 100000000000")),
              HasSubstr("expected angles of at most 10 turns"));
  EXPECT_THAT(problem(drawing_of("0 ELLIPSE 10 0 20 0 11 5 21 0 40 1 41 0 42 1e11")),
              HasSubstr("expected parameters of at most 10 turns"));
  EXPECT_THAT(problem(drawing_of("0 INSERT 2 a 70 32767 71 32767",
                                 "0 SECTION 2 BLOCKS 0 BLOCK 2 a 0 ENDBLK 0 ENDSEC ")),
              HasSubstr("insertions, found 32767 x 32767"));
  // Each block inserts the one before it ten times.
  std::string blocks = "0 SECTION 2 BLOCKS 0 BLOCK 2 b0 " + box(3, 6) + " 0 ENDBLK";
  for (int i = 1; i < 12; ++i) {
    blocks += fmt::format(" 0 BLOCK 2 b{}", i);
    for (int k = 0; k < 10; ++k) blocks += fmt::format(" 0 INSERT 2 b{}", i - 1);
    blocks += " 0 ENDBLK";
  }
  EXPECT_THAT(problem(drawing_of("0 INSERT 2 b11", blocks + " 0 ENDSEC ")),
              HasSubstr("expected at most"));
  EXPECT_THAT(problem(drawing_of("0 INSERT 2 a",
                                 "0 SECTION 2 BLOCKS 0 BLOCK 2 a 0 INSERT 2 a 0 "
                                 "ENDBLK 0 ENDSEC ")),
              HasSubstr("blocks at most 16 deep"));
}

// 400 x 500 places, each with a block of 400 x 500 places of an empty block: 4e10 insertions.
TEST(DxfFaults, CountsInsertionsOfEmptyBlocks) {
  const std::string grid = " 70 400 71 500 44 1 45 1";
  EXPECT_THAT(
      problem(drawing_of("0 INSERT 2 b" + grid,
                         "0 SECTION 2 BLOCKS 0 BLOCK 2 a 0 ENDBLK 0 BLOCK 2 b 0 INSERT 2 a" + grid +
                             " 0 ENDBLK 0 ENDSEC ")),
      HasSubstr("expected at most 1000000 entities and insertions, found more"));
}

// Each of 63 x 63 places reads the 20,000 groups of its block again: 140 KB took half a minute.
TEST(DxfFaults, CountsTheGroupsOfInsertedBlocks) {
  const auto inserted = [](int groups, const std::string& grid) {
    std::string block = "0 SECTION 2 BLOCKS 0 BLOCK 2 a 0 TEXT";
    for (int i = 0; i < groups; ++i) block += " 1000 x";
    return drawing_of(box(30, 60) + " 0 INSERT 2 a" + grid, block + " 0 ENDBLK 0 ENDSEC ");
  };
  EXPECT_THAT(problem(inserted(20'000, " 70 63 71 63 44 1 45 1")),
              HasSubstr("INSERT: expected blocks of at most 20000000 groups with all insertions, "
                        "found more"));
  EXPECT_NEAR(volume(inserted(20'000, " 70 3 71 3 44 1 45 1")), kPi * 900.0 * 60.0, 1e-6);
}

TEST(DxfFaults, CountsTheVerticesOfInsertedPolylines) {
  std::string block = "0 SECTION 2 BLOCKS 0 BLOCK 2 a 0 POLYLINE 70 64";
  for (int i = 0; i < 20'000; ++i) block += " 0 VERTEX 10 1 20 2";
  EXPECT_THAT(problem(drawing_of("0 INSERT 2 a 70 63 71 63 44 1 45 1",
                                 block + " 0 SEQEND 0 ENDBLK 0 ENDSEC ")),
              HasSubstr("groups with all insertions, found more"));
}

TEST(DxfFaults, JoinsFiftyThousandLines) {
  std::string entities = "0 LINE 10 0 20 0 11 30 21 0";
  constexpr int kCount = 50'000;
  for (int i = 0; i < kCount; ++i) {
    const int k = static_cast<int>((static_cast<long>(i) * 7919) % kCount);  // in no order
    entities += fmt::format(" 0 LINE 10 30 20 {} 11 30 21 {}", k * 0.02, (k + 1) * 0.02);
  }
  EXPECT_NEAR(volume(drawing_of(entities)), kPi * 900.0 * 1000.0, 1.0);
}

TEST(DxfFaults, InsertsBlocks) {
  const std::string before =
      "0 SECTION 2 BLOCKS 0 BLOCK 2 Foot 10 5 20 7 0 LINE 10 5 20 7 11 20 "
      "21 7 0 ENDBLK 0 ENDSEC ";
  // Twice as wide, once mirrored and turned by half a turn.
  for (const char* insert : {"0 INSERT 2 FOOT 10 0 20 0 41 2 42 1", "0 INSERT 2 foot 41 -2 50 180",
                             "0 INSERT 2 foot 41 -2 230 -1 210 0 220 0"})
    EXPECT_NEAR(volume(drawing_of(std::string(insert) + " 0 LINE 10 30 20 0 11 30 21 60", before)),
                kPi * 900.0 * 60.0, 1e-6)
        << insert;
  EXPECT_THAT(problem(drawing_of("0 INSERT 2 leg")), HasSubstr("name of a block"));
}

TEST(DxfFaults, MirroredArcsRunTheOtherWay) {
  // A quarter circle about (-30, 0) seen from below, from (0, 0) up to (30, 30), mirrored: the foot
  // of a cup whose wall is a circle about (30, 0)... in the drawing.
  const std::string arc = "0 ARC 10 0 20 30 40 30 50 90 51 270 210 0 220 0 230 -1";
  EXPECT_NEAR(volume(drawing_of(arc)), 4.0 / 3.0 * kPi * 27000.0, kFlatMm * 4.0 * kPi * 900.0);
}

TEST(DxfFaults, IgnoresLayersThatAreNotDrawn) {
  const std::string table =
      "0 SECTION 2 TABLES 0 TABLE 2 LAYER 0 LAYER 2 Frozen 70 1 62 7 0 LAYER 2 Off 70 0 62 -7 0 "
      "LAYER 2 NoPlot 70 0 290 0 0 LAYER 2 Aid 70 0 1001 LibreCad 1070 1 0 LAYER 2 Shown 70 0 62 3 "
      "0 "
      "ENDTAB 0 ENDSEC ";
  for (const char* layer : {"Frozen", "OFF", "noplot", "Aid", "Defpoints"})
    EXPECT_NEAR(volume(drawing_of(box(30, 60, "Shown") + " " + box(90, 70, layer), table)),
                kPi * 900.0 * 60.0, 1e-6)
        << layer;
  EXPECT_NEAR(volume(drawing_of(box(30, 60) + " 0 LINE 8 0 60 1 10 3 20 3 11 4 21 4", table)),
              kPi * 900.0 * 60.0, 1e-6);
}

}  // namespace
}  // namespace clay::importing
