#include "claystack/engine/files.hpp"

#include "engine/files/session_json.hpp"
#include "tests/engine/files/arbitrary.hpp"
#include "tests/engine/files/text_edits.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>

namespace clay {
namespace {

using test::Json;

constexpr double kQuantumMm = 1.0 / 65536.0;

Pose pose_of(std::int64_t time_us, glm::dvec3 counts, bool trim = false, double gap = 0.0) {
  return {time_us, counts * kQuantumMm, trim, gap * kQuantumMm};
}

/// A moving hand with occasional button presses that pinches after the first block.
std::vector<Pose> wandering(std::size_t count) {
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const auto t = static_cast<double>(i);
    poses.push_back(quantized({static_cast<std::int64_t>(i * 1000 + i % 7),
                               {60.0 - 0.01 * t, 40.0 + 20.0 * std::sin(0.01 * t), 0.0},
                               i % 40 > 30,
                               i < 120 ? 0.0 : 5.0 + std::sin(0.02 * t)}));
  }
  return poses;
}

std::string text_of(const std::vector<Pose>& poses) {
  return write_session({"vase", 0x0123456789abcdef, poses, false});
}

bool is_prefix(const std::vector<Pose>& part, const std::vector<Pose>& whole) {
  return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
}

constexpr std::string_view kHeader =
    R"({"schema":"claystack-session-1","written_by":"claystack 0.1.0","scene":"vase",)"
    R"("scene_hash":"0123456789abcdef","position_quantum_mm":"2^-16"})"
    "\n";
// The checksums were computed by a program in another language.
constexpr std::string_view kThreePoses =
    R"({"n":3,"t_us":1000,"dt_us":[1000,1500],"x":[65536,1,2],"y":-3,"z":[0,10,-10],)"
    R"("trim":[0,0,1],"check":"dafff0894e3655ed"})"
    "\n";
constexpr std::string_view kThreeGaps =
    R"({"n":3,"t_us":1000,"dt_us":[1000,1500],"x":[65536,1,2],"y":-3,"z":[0,10,-10],)"
    R"("trim":[0,0,1],"gap":[0,327680,-327700],"check":"a4493f83007c9f49"})"
    "\n";
constexpr std::string_view kOnePose =
    R"({"n":1,"t_us":0,"x":0,"y":0,"z":0,"trim":1,"check":"21dbd703e6071224"})"
    "\n";

const std::vector<Pose> kThree = {pose_of(1000, {65536, -3, 0}), pose_of(2000, {65537, -3, 10}),
                                  pose_of(3500, {65540, -3, 10}, true)};

const std::vector<Pose> kThreePinched = {pose_of(1000, {65536, -3, 0}),
                                         pose_of(2000, {65537, -3, 10}, false, 327'680),
                                         pose_of(3500, {65540, -3, 10}, true, 327'660)};

TEST(SessionFile, WritesTheDocumentedFormat) {
  EXPECT_EQ(session_block(kThree), kThreePoses);
  EXPECT_EQ(session_block(std::vector{pose_of(0, {0, 0, 0}, true)}), kOnePose);
  EXPECT_EQ(session_block(kThreePinched), kThreeGaps);
  EXPECT_EQ(session_block({}), "");
  const Json header = Json::parse(session_header("vase", 0x0123456789abcdef));
  EXPECT_EQ(header["written_by"].get<std::string>().substr(0, 10), "claystack ");
  Json expected = Json::parse(kHeader);
  expected["written_by"] = header["written_by"];
  EXPECT_EQ(header.dump(), expected.dump());
}

TEST(SessionFile, ReadsTheDocumentedFormat) {
  const auto session =
      parse_session(std::string(kHeader).append(kOnePose).append(kThreePoses), "s.session");
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_EQ(session->scene_name, "vase");
  EXPECT_EQ(session->scene_hash, 0x0123456789abcdef);
  EXPECT_FALSE(session->torn);
  ASSERT_EQ(session->poses.size(), 4u);
  EXPECT_EQ(session->poses[0], pose_of(0, {0, 0, 0}, true));
  EXPECT_TRUE(std::equal(kThree.begin(), kThree.end(), session->poses.begin() + 1));
  EXPECT_EQ(parse_session(std::string(kHeader).append(kThreeGaps), "s.session").value().poses,
            kThreePinched);
}

TEST(SessionFile, StoresAConstantGapAsOneNumber) {
  auto poses = kThreePinched;
  for (Pose& pose : poses) pose.gap_mm = 5.0;
  EXPECT_EQ(Json::parse(session_block(poses))["gap"], 327'680);
}

TEST(SessionFile, IsCompact) {
  const std::size_t poses = 20'000;
  EXPECT_LT(text_of(wandering(poses)).size(), 20 * poses);
}

RC_GTEST_PROP(SessionFile, RoundTrips, ()) {
  Session session;
  session.scene_name = *test::arbitrary_text();
  session.scene_hash = *rc::gen::arbitrary<std::uint64_t>();
  const auto count = *rc::gen::inRange<std::size_t>(0, 350);
  const auto reach = *rc::gen::element(0.0, 1e-4, 1.0, 1e6);
  const auto step_us = *rc::gen::element<std::int64_t>(2, 1000, std::int64_t{1} << 40);
  const bool pinches = *rc::gen::arbitrary<bool>();
  std::int64_t time_us = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto coordinate = [&] { return *test::number_in(-reach, reach); };
    session.poses.push_back(quantized({time_us,
                                       {coordinate(), coordinate(), coordinate()},
                                       *rc::gen::arbitrary<bool>(),
                                       pinches ? *test::number_in(0, reach) : 0.0}));
    time_us += *rc::gen::inRange<std::int64_t>(1, step_us);
  }
  const auto read = parse_session(write_session(session), "written");
  RC_ASSERT(read.has_value());
  RC_ASSERT(read->scene_name == session.scene_name);
  RC_ASSERT(read->scene_hash == session.scene_hash);
  RC_ASSERT(read->poses == session.poses);
  RC_ASSERT(!read->torn);
}

TEST(SessionFile, TruncatedFileGivesTheCompleteBlocks) {
  const auto poses = wandering(250);
  const std::string text = text_of(poses);
  const auto header_end = text.find('\n') + 1;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const auto session = parse_session(std::string_view(text).substr(0, n), "cut");
    ASSERT_EQ(session.has_value(), n >= header_end) << n;
    if (!session) continue;
    const bool at_line_end = text[n - 1] == '\n';
    EXPECT_EQ(session->torn, !at_line_end) << n;
    EXPECT_EQ(session->poses.size(), n < text.size() ? session->poses.size() / 100 * 100 : 250u);
    EXPECT_TRUE(is_prefix(session->poses, poses));
  }
}

TEST(SessionFile, ReportsATruncatedLineWithANewlineAsTorn) {
  const auto poses = wandering(150);
  const std::string text = text_of(poses);
  const auto last_line = text.rfind('\n', text.size() - 2) + 1;
  for (std::size_t n = last_line + 1; n < text.size() - 1; ++n) {
    const auto session = parse_session(text.substr(0, n) + "\n", "cut");
    ASSERT_TRUE(session) << n << session.error().message;
    EXPECT_TRUE(session->torn);
    EXPECT_EQ(session->poses.size(), 100u);
  }
}

TEST(SessionFile, DetectsEveryFlippedBit) {
  const auto poses = wandering(210);
  const std::string text = text_of(poses);
  const auto first_block = text.find('\n') + 1;
  const auto last_block = text.rfind('\n', text.size() - 2) + 1;
  for (std::size_t at = first_block; at < text.size(); ++at)
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string flipped = text;
      flipped[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1u << bit));
      const auto session = parse_session(flipped, "flipped");
      if (!session) continue;
      // Only an end that looks truncated may be accepted; then the reader drops the whole block.
      EXPECT_GE(at, last_block) << "bit " << bit << " of byte " << at;
      EXPECT_TRUE(session->torn);
      EXPECT_EQ(session->poses.size(), 200u);
      EXPECT_TRUE(is_prefix(session->poses, poses));
    }
}

/// Replaces `from` by `to` in a session of a header and two blocks.
void expect_session_error(std::string_view from, std::string_view to, std::size_t line,
                          const std::string& message) {
  SCOPED_TRACE(to);
  const auto text = std::string(kHeader).append(kOnePose).append(kThreePoses);
  test::expect_refused(parse_session(test::replaced(text, from, to), "s"),
                       "s:" + std::to_string(line) + ": " + message);
}

TEST(SessionFile, ErrorsNameTheLineOfTheHeader) {
  test::expect_refused(parse_session("", "s"),
                       "s:1: expected a whole header line, found 0 bytes without a newline");
  expect_session_error("session-1", "session-9", 1,
                       "schema: expected \"claystack-session-1\", found \"claystack-session-9\"");
  expect_session_error(
      "0123456789abcdef", "0123456789ABCDEF", 1,
      "scene_hash: expected 16 lower-case hexadecimal digits, found \"0123456789ABCDEF\"");
  expect_session_error("\"scene\":\"vase\",", "", 1, "expected a field \"scene\", found none");
  expect_session_error("2^-16", "2^-17", 1,
                       "position_quantum_mm: expected \"2^-16\", found \"2^-17\"");
}

TEST(SessionFile, ErrorsNameTheLineOfABlock) {
  expect_session_error("\"n\":1", "\"n\":0", 2, "n: expected an integer from 1 to 100, found 0");
  expect_session_error("\"n\":3", "\"n\":101", 3,
                       "n: expected an integer from 1 to 100, found 101");
  expect_session_error("\"n\":3", "\"n\":4", 3,
                       "dt_us: expected one integer or an array of 3, found an array of 2");
  expect_session_error("\"dt_us\":[1000,1500],", "", 3, "expected a field \"dt_us\", found none");
  expect_session_error("[1000,1500]", "[1000,0]", 3,
                       "dt_us[1]: expected an integer from 1 to 9007199254740992, found 0");
  expect_session_error("[1000,1500]", "9007199254740992", 3,
                       "dt_us: expected times up to 9007199254740992, found later ones");
  expect_session_error("[65536,1,2]", "[65536,1]", 3,
                       "x: expected one integer or an array of 3, found an array of 2");
  expect_session_error("[65536,1,2]", "[65536000001,0,0]", 3,
                       "x: expected positions within 1e6 mm of the origin, found one beyond");
  expect_session_error("[65536,1,2]", "[65536000000,1,0]", 3,
                       "x: expected positions within 1e6 mm of the origin, found one beyond");
  expect_session_error("\"y\":-3", "\"y\":-65536000001", 3,
                       "y: expected positions within 1e6 mm of the origin, found one beyond");
  expect_session_error("[65536,1,2]", "[65536,1,2.5]", 3,
                       "x[2]: expected an integer from -262144000000 to 262144000000, found 2.5");
  // 2^64 - 3: as a signed integer it would be -3.
  expect_session_error("\"y\":-3", "\"y\":18446744073709551613", 3,
                       "y: expected an integer from -262144000000 to 262144000000, found "
                       "18446744073709551613");
  expect_session_error("[0,0,1]", "[0,0,2]", 3,
                       "trim[2]: expected an integer from 0 to 1, found 2");
  expect_session_error(
      "\"y\":-3", "\"y\":-4", 3,
      "check: expected 02eb587a9fadcabc for these poses, found dafff0894e3655ed: the line "
      "is damaged");
  expect_session_error("\"y\":-3", "\"Y\":-3", 3, "expected a field \"y\", found none");
  expect_session_error(
      "\"y\":-3", "\"y\":-3,\"w\":1", 3,
      "unknown field \"w\"; expected one of n, t_us, dt_us, x, y, z, trim, gap, check");
  expect_session_error("\"y\":-3", "\"y\":-3}", 3,
                       "syntax error while parsing value - unexpected ','; expected end of input");
}

TEST(SessionFile, ErrorsNameTheLineOfAGap) {
  const auto refused = [](std::string_view from, std::string_view to, const std::string& message) {
    const auto text = std::string(kHeader).append(kThreeGaps);
    test::expect_refused(parse_session(test::replaced(text, from, to), "s"), "s:2: " + message);
  };
  refused("[0,327680,-327700]", "[0,327680]",
          "gap: expected one integer or an array of 3, found an array of 2");
  refused("[0,327680,-327700]", "-1", "gap: expected gaps from 0 to 1e6 mm, found one outside");
  refused("[0,327680,-327700]", "[65536000000,1,0]",
          "gap: expected gaps from 0 to 1e6 mm, found one outside");
  refused("[0,327680,-327700]", "[0,327680,true]",
          "gap[2]: expected an integer from -262144000000 to 262144000000, found true");
  refused("\"gap\":[0,327680,-327700],", "",
          "check: expected dafff0894e3655ed for these poses, found a4493f83007c9f49: the line is "
          "damaged");
}

TEST(SessionFile, RefusesTimesThatDecreaseBetweenBlocks) {
  const auto text = std::string(kHeader).append(kThreePoses).append(kOnePose);
  test::expect_refused(parse_session(text, "s"), "s:3: t_us: expected a time after 3500, found 0");
}

/// A header and blocks of poses at rest, which gives the most poses per byte.
std::string still_session(std::size_t blocks) {
  std::string text(kHeader);
  std::vector<Pose> poses(kPosesPerBlock);
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t i = 0; i < poses.size(); ++i)
      poses[i].time_us = static_cast<std::int64_t>(1000 * (block * kPosesPerBlock + i));
    text += session_block(poses);
  }
  return text;
}

TEST(SessionFile, UsesTheMemoryOfPosesAndOneBlock) {
  constexpr std::size_t kBlocks = 5001, kOneBlock = std::size_t{1} << 18;
  const std::string text = still_session(kBlocks);
  Result<Session> session;
  const std::size_t bytes = peak_bytes_of([&] { session = parse_session(text, "s"); });
  ASSERT_TRUE(session) << session.error().message;
  ASSERT_EQ(session->poses.size(), kBlocks * kPosesPerBlock);
  EXPECT_LE(bytes, session->poses.size() * sizeof(Pose) + kOneBlock);
}

TEST(SessionFile, ReadsTheLargestSessionInOneGibibyte) {
  // Measured on two short sessions, so that the difference is the memory of their poses alone.
  constexpr std::size_t kPoses = 20'000;
  const std::string once = text_of(wandering(kPoses)), twice = text_of(wandering(2 * kPoses));
  const auto peak_bytes = [](const std::string& text) {
    return peak_bytes_of([&] { ASSERT_TRUE(parse_session(text, "s")); });
  };
  const double per_pose =
      static_cast<double>(peak_bytes(twice) - peak_bytes(once)) / double{kPoses};
  EXPECT_LT(per_pose * double{kMaxPoses} + double{kMaxSessionBytes}, 0x1p30) << per_pose;
  EXPECT_GT(kMaxSessionBytes, 2 * (once.size() / kPoses) * kMaxPoses);
}

TEST(SessionFile, RefusesTooManyPosesBeforeReadingThem) {
  std::string text(kHeader);
  for (std::size_t block = 0; block <= kMaxPoses / kPosesPerBlock; ++block)
    text += R"({"n":100,"t_us":0})"
            "\n";
  Result<Session> session;
  const std::size_t bytes = peak_bytes_of([&] { session = parse_session(text, "s"); });
  test::expect_refused(session,
                       "s: expected at most 10000000 poses, found 10000100, which would take 457 "
                       "MiB of memory");
  EXPECT_LT(bytes, std::size_t{1} << 18);
}

TEST(SessionFile, RefusesABlockBeyondTheLimitAtItsLine) {
  const auto line = LocatedJson::from_json(kThreePoses, "s", files::kMaxBlockValues, 7);
  std::vector<Pose> poses;
  test::expect_refused(files::append_block(line.value(), poses, 2),
                       "s:7: n: expected at most 10000000 poses in all, found more");
  EXPECT_TRUE(poses.empty());
  EXPECT_TRUE(files::append_block(line.value(), poses, 3));
  // A block is read even if its layout hides the announced count.
  EXPECT_EQ(files::announced_poses(kThreePoses), 3u);
  EXPECT_EQ(files::announced_poses(" " + std::string(kThreePoses)), 0u);
  EXPECT_EQ(parse_session(std::string(kHeader) + " " + std::string(kThreePoses), "s").value().poses,
            kThree);
}

TEST(SessionSchema, DescribesEveryLine) {
  const Json schema = test::load_schema("session");
  std::string text = text_of(wandering(201));
  std::set<std::string> written;
  for (std::size_t start = 0; start < text.size(); start = text.find('\n', start) + 1) {
    const Json line = Json::parse(text.substr(start, text.find('\n', start) - start));
    EXPECT_EQ(test::violation(schema, line), "");
    const auto paths = test::member_paths(line);
    written.insert(paths.begin(), paths.end());
  }
  std::set<std::string> described;
  for (const char* kind : {"header", "block"})
    for (const auto& path : test::property_paths(schema["$defs"][kind])) described.insert(path);
  EXPECT_EQ(written, described);
}

TEST(SessionSchema, RefusesNothingThatTheReaderAccepts) {
  const Json schema = test::load_schema("session");
  const std::string block(kThreeGaps);
  for (const auto& [what, line] : test::edits(schema, Json::parse(kHeader))) {
    const auto read = parse_session(line.dump() + "\n" + block, "edited");
    EXPECT_EQ(read.has_value(), test::violation(schema, line).empty()) << what;
  }
  for (const auto& [what, line] : test::edits(schema, Json::parse(block))) {
    // The reader refuses every other edit as well, because of the checksum.
    if (test::violation(schema, line).empty()) continue;
    const auto read = parse_session(std::string(kHeader) + line.dump() + "\n", "edited");
    ASSERT_FALSE(read) << what;
    EXPECT_EQ(read.error().message.find("damaged"), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace clay
