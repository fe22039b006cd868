#include "claystack/engine/files.hpp"

#include "tests/app/history/strokes.hpp"
#include "tests/engine/files/text_edits.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include <string>
#include <string_view>

namespace clay {
namespace {

using test::press_stroke;
using test::small_scene;

/// Two branches, one of them trimmed; the first is current.
WorkRecord sample_record() {
  auto work = history::Work::begin(small_scene()).value();
  (void)work.add(small_scene(), press_stroke(1)).value();
  (void)work.add(small_scene(5.0), press_stroke(2)).value();
  work.undo();
  (void)work.add(small_scene(8.0, ToolMode::trim), press_stroke(3)).value();
  work.go_to(1);
  return work.record();
}

std::string second_file() {
  auto work = history::Work::begin(small_scene()).value();
  (void)work.add(small_scene(), press_stroke(1)).value();
  auto second = history::Work::begin(small_scene(), **work.pot()).value();
  (void)second.add(small_scene(), press_stroke(2)).value();
  return write_work(second.record());
}

bool same(const WorkRecord& a, const WorkRecord& b) {
  return a.scenes == b.scenes && a.start == b.start && a.nodes == b.nodes && a.at == b.at;
}

/// A stroke at rest in free air.
std::vector<Pose> still(std::size_t count) {
  std::vector<Pose> poses(count);
  for (std::size_t i = 0; i < count; ++i) {
    poses[i].time_us = static_cast<std::int64_t>(1000 * i);
    poses[i].position_mm.x = 90.0;
  }
  return poses;
}

TEST(WorkFile, UsesTheMemoryOfPosesAndOneLine) {
  constexpr std::size_t kStroke = 100'000, kOneLine = std::size_t{1} << 18;
  WorkRecord record;
  record.scenes = {small_scene()};
  record.nodes.resize(1);
  for (std::size_t parent = 0; parent < 3; ++parent)
    record.nodes.push_back({parent, 0, still(kStroke), 0});
  const std::string text = write_work(record);
  Result<WorkReading> read;
  const std::size_t bytes = peak_bytes_of([&] { read = parse_work(text, "w"); });
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->work.nodes.back().poses, record.nodes.back().poses);
  EXPECT_LE(bytes, 3 * kStroke * sizeof(Pose) + kOneLine);
}

TEST(WorkFile, RefusesTooManyPosesInAdvance) {
  std::string text = write_work(sample_record());
  const std::size_t blocks = kMaxPoses / kPosesPerBlock;
  for (std::size_t block = 0; block < blocks; ++block)
    text += R"({"n":100,"t_us":0})"
            "\n";
  const auto read = parse_work(text, "w");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message.substr(0, 51),
            "w: expected at most 10000000 poses, found 10000543,")
      << read.error().message;
  const auto salvaged = salvage_work(text, "w");  // the lines before are not lost
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ(salvaged->work.nodes, sample_record().nodes);
}

RC_GTEST_PROP(WorkFile, RoundTrips, ()) {
  const auto work = test::arbitrary_work(*rc::gen::inRange(0, 20));
  const std::string text = write_work(work.record());
  const auto read = parse_work(text, "w");
  RC_ASSERT(read.has_value());
  RC_ASSERT(same(read->work, work.record()));
  RC_ASSERT(!read->torn && !read->running);
  RC_ASSERT(read->sound_bytes == text.size());
  RC_ASSERT(write_work(read->work) == text);
}

/// Begun strokes are present up to their last complete block; nothing else differs.
TEST(WorkFile, TruncatedFileGivesTheCompleteLines) {
  const WorkRecord whole = sample_record();
  const std::string text = write_work(whole);
  const std::size_t root_end = text.find('\n', text.find("{\"node\":0")) + 1;
  for (std::size_t n = 0; n <= text.size(); ++n) {
    const auto read = parse_work(std::string_view(text).substr(0, n), "cut");
    ASSERT_EQ(read.has_value(), n >= root_end) << n;
    if (!read) {
      ASSERT_EQ(read.error().message.substr(0, 4), "cut:") << read.error().message;
      continue;
    }
    ASSERT_EQ(read->torn, text[n - 1] != '\n') << n;
    const auto& nodes = read->work.nodes;
    ASSERT_LE(nodes.size(), whole.nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto &part = nodes[i].poses, &all = whole.nodes[i].poses;
      ASSERT_EQ(nodes[i].parent, whole.nodes[i].parent);
      ASSERT_TRUE(std::equal(part.begin(), part.end(), all.begin()));
      ASSERT_TRUE(part.size() == all.size() || (read->running && i + 1 == nodes.size())) << n;
    }
  }
}

TEST(WorkFile, DetectsEveryFlippedBit) {
  const WorkRecord whole = sample_record();
  for (const std::string& text : {write_work(whole), second_file()}) {
    const WorkRecord expected = parse_work(text, "w").value().work;
    const std::size_t last_line = text.rfind('\n', text.size() - 2) + 1;
    for (std::size_t at = text.find('\n') + 1; at < text.size(); ++at) {
      std::string flipped = text;
      flipped[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1u << (at % 8)));
      const auto read = parse_work(flipped, "flipped");
      if (!read) continue;
      // The program that wrote a scene or a pot is reported, but is not part of it.
      const bool equal = same(read->work, expected);
      ASSERT_TRUE(equal || (at >= last_line && read->torn))
          << "bit " << at % 8 << " of byte " << at;
    }
  }
}

TEST(WorkFile, SplitsAnEndIntoStrokes) {
  const WorkRecord whole = sample_record();
  std::string text = write_work(whole);
  text.resize(text.find("{\"end\":181"));
  const std::vector<std::size_t> splits = {50, 120};
  const auto work =
      parse_work(text + work_end_line(181, splits) + work_at_line(2), "w").value().work;
  ASSERT_EQ(work.nodes.size(), 4u);
  EXPECT_EQ(work.nodes[2].parent, 1u);
  EXPECT_EQ(work.nodes[3].parent, 2u);
  EXPECT_EQ(work.nodes[2].poses.size(), 70u);
  // Whole periods of the clock, 9 ms, earlier.
  EXPECT_EQ(work.nodes[3].poses.front().time_us, whole.nodes[1].poses[120].time_us % 9000);
  EXPECT_EQ(work.nodes[3].poses.front().position_mm, whole.nodes[1].poses[120].position_mm);
  EXPECT_EQ(work.nodes[2].taken, 3u);
  EXPECT_EQ(work.at, 2u);
}

void expect_error(std::string_view from, std::string_view to, const std::string& message) {
  SCOPED_TRACE(to);
  const std::string text = write_work(sample_record());
  const auto read = parse_work(test::replaced(text, from, to), "w");
  ASSERT_FALSE(read) << message;
  EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
  const std::string place = "w:" + std::to_string(test::line_of(text, from)) + ": ";
  EXPECT_EQ(read.error().message.substr(0, place.size() + message.size()), place + message);
}

TEST(WorkFile, ErrorsNameTheLine) {
  test::expect_refused(parse_work("", "w"),
                       "w:1: expected a whole header line, found 0 bytes without a newline");
  test::expect_refused(
      parse_work(write_work(sample_record()).substr(0, write_work(sample_record()).find('\n') + 1),
                 "w"),
      "w:2: expected node 0, found the end of the file");
  expect_error("claystack-work-1", "claystack-work-2", "schema: expected \"claystack-work-1\"");
  expect_error("\"rings\":30", "\"rings\":-30", "lump.rings: expected an integer from 1");
  expect_error("{\"node\":2,", "{\"node\":3,", "node: expected 2, found 3");
  expect_error("{\"node\":2,\"parent\":1", "{\"node\":2,\"parent\":2",
               "parent: expected a node below 2, found 2");
  expect_error("{\"node\":2,\"parent\":1", "{\"node\":2,\"parent\":0", "check: expected ");
  expect_error("\"parent\":1,\"scene\":1", "\"parent\":1,\"scene\":7",
               "scene: expected one of the 3 scenes before, found 7");
  expect_error("{\"end\":181", "{\"end\":180", "end: expected the number of its poses, 181, found");
  expect_error("{\"end\":181", "{\"end\":181,\"splits\":[9,9]",
               "splits: expected increasing integers from 1 to below 181, found [9,9]");
  expect_error("{\"end\":181", "{\"end\":181,\"splits\":181",
               "splits: expected increasing integers from 1 to below 181, found 181");
  expect_error("{\"at\":1", "{\"at\":9", "at: expected a node below 4, found 9");
  expect_error("{\"at\":1", "{\"at\":2", "check: expected ");
  expect_error("{\"at\":1", "{\"in\":1",
               "expected a scene, a pot, a node, poses, an end, a place (at, saved), found a line "
               "that begins with \"in\"");
  expect_error("\"at\":1", "\"at\":1,\"on\":2", "unknown field \"on\"");
}

TEST(WorkFile, ErrorsNameAMisplacedLine) {
  const std::string text = write_work(sample_record());
  const auto refused = [&](const std::string& more, const std::string& message) {
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    test::expect_refused(parse_work(text + more, "w"),
                         "w:" + std::to_string(lines + 1) + ": " + message);
  };
  const std::string end = work_end_line(0, {});
  refused(end, "expected a node before its end, found a line that begins with \"end\"");
  refused("{\"n\":1}\n", "expected a node before its poses, found a line that begins with \"n\"");
  refused("[1]\n",
          "expected a scene, a pot, a node, poses, an end, a place (at, saved), found "
          "another value");
  const std::string node = work_stroke_line(4, 1, 0, small_scene());
  const auto unended = parse_work(text + node + work_at_line(1), "w");
  ASSERT_FALSE(unended);
  EXPECT_NE(unended.error().message.find("expected the poses or the end of node 4, found"),
            std::string::npos);
}

TEST(WorkFile, SalvageStopsAtTheDamage) {
  const std::string text = write_work(sample_record());
  const auto read =
      salvage_work(test::replaced(text, "{\"node\":2,\"parent\":1", "{\"node\":2,\"parent\":0"),
                   "w")
          .value();
  ASSERT_TRUE(read.damage);
  EXPECT_EQ(read.work.nodes.size(), 2u);
  EXPECT_EQ(read.sound_bytes, text.find("{\"node\":2"));
  EXPECT_FALSE(salvage_work(text.substr(0, 200) + "\n" + text, "w"));
}

/// A file with many undos in a long tree is read in time linear in its length.
TEST(WorkFile, ReadsALongFileInOnePass) {
  std::string text = write_work(history::Work::begin(small_scene()).value().record());
  constexpr std::size_t kNodes = 50'000;
  for (std::size_t node = 1; node <= kNodes; ++node)
    text += work_stroke_line(node, node - 1, 0, small_scene()) + work_end_line(0, {}) +
            work_at_line(node % 2 == 0 ? 0 : node);
  const auto read = parse_work(text, "w").value();
  EXPECT_EQ(read.work.nodes.size(), kNodes + 1);
  EXPECT_EQ(read.work.nodes[0].taken, 1u);
}

TEST(WorkSchema, DescribesEveryLine) {
  const test::Json schema = test::load_schema("work");
  const auto conforms = [&](const std::string& line) {
    return test::violation(schema, test::Json::parse(line));
  };
  const std::string text = write_work(sample_record());
  EXPECT_EQ(conforms(text.substr(0, text.find('\n'))), "");
  EXPECT_EQ(conforms(work_stroke_line(3, 1, 2, small_scene())), "");
  const std::vector<std::size_t> none, one = {5}, two = {5, 9};
  for (const auto& splits : {none, one, two}) EXPECT_EQ(conforms(work_end_line(20, splits)), "");
  EXPECT_EQ(conforms(work_at_line(3)), "");
  EXPECT_EQ(conforms(work_saved_line(3, 5)), "");
  EXPECT_NE(conforms("{\"at\":-1,\"check\":\"0123456789abcdef\"}"), "");
  EXPECT_NE(conforms("{\"at\":1,\"check\":\"0123456789abcde\"}"), "");
}

/// The cases in which the schema and the reader could disagree about a single line.
TEST(WorkSchema, AgreesWithTheReader) {
  const test::Json schema = test::load_schema("work");
  const std::string text = write_work(sample_record());
  std::size_t compared = 0;
  for (const std::string& start : {std::string("{\"schema\":\"claystack-work"),
                                   std::string("{\"node\":2"), std::string("{\"end\":181")}) {
    const std::size_t at = text.find(start), end = text.find('\n', at);
    const auto line = test::Json::parse(text.substr(at, end - at));
    for (const auto& [what, edited] : test::edits(schema, line)) {
      if (test::violation(schema, edited).empty()) continue;
      ++compared;
      const std::string edit = text.substr(0, at) + edited.dump() + text.substr(end);
      EXPECT_FALSE(parse_work(edit, "w")) << what;
    }
  }
  EXPECT_GT(compared, 20u);
}

}  // namespace
}  // namespace clay
