#include "claystack/engine/files.hpp"

#include "core/fnv1a.hpp"
#include "core/json/json_text.hpp"
#include "core/json/object_reader.hpp"
#include "core/json/object_writer.hpp"
#include "core/line_reader.hpp"
#include "core/text.hpp"
#include "engine/files/scene_json.hpp"
#include "engine/files/session_json.hpp"
#include "engine/files/text_codes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace clay {
namespace {

using namespace files;

constexpr std::int64_t kMaxCount = 1'000'000 * std::int64_t{65'536};  ///< 1e6 mm
constexpr std::int64_t kMaxTimeUs = std::int64_t{1} << 53;  ///< exact in every JSON reader

constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};

using Series = std::vector<std::int64_t>;

struct Header {
  std::string scene_name;
  std::uint64_t scene_hash = 0;
};

/// A block in the form of its line. Each coordinate is one count for all poses, or the first count,
/// the first difference and the second differences.
struct Block {
  std::size_t count = 0;
  std::int64_t first_us = 0;
  Series steps_us;  ///< one for all, or one for each pose except the first; empty for a single pose
  std::array<Series, 3> coordinates;
  Series trim;  ///< one for all, or one for each pose
  Series gap;   ///< like a coordinate; empty if no pose has a gap
  std::uint64_t check = 0;
};

std::int64_t count_of(double mm) {
  const double count = std::round(mm * kPoseQuantaPerMm);
  constexpr auto kLimit = static_cast<double>(kMaxCount);
  return std::isnan(count) ? 0 : static_cast<std::int64_t>(std::clamp(count, -kLimit, kLimit));
}

double mm_of(std::int64_t count) { return static_cast<double>(count) / kPoseQuantaPerMm; }

bool has_gaps(std::span<const Pose> poses) {
  return std::ranges::any_of(poses, [](const Pose& pose) { return pose.gap_mm != 0.0; });
}

std::uint64_t checksum(std::span<const Pose> poses) {
  const bool gaps = has_gaps(poses);  // without gaps a block has its original form
  Fnv1a hash;
  for (const Pose& pose : poses) {
    hash.add(pose.time_us);
    for (int axis = 0; axis < 3; ++axis) hash.add(count_of(pose.position_mm[axis]));
    hash.add(std::int64_t{pose.trim});
    if (gaps) hash.add(count_of(pose.gap_mm));
  }
  return hash.value();
}

/// One value if all are equal.
Series shortened(Series values) {
  const bool varied =
      std::ranges::adjacent_find(values, std::ranges::not_equal_to{}) != values.end();
  return varied || values.empty() ? values : Series{values.front()};
}

/// [first, first difference, second differences...], or one value if all are equal.
Series differenced(Series values) {
  values = shortened(std::move(values));
  for (const std::size_t first : {std::size_t{1}, std::size_t{2}})
    for (std::size_t i = values.size(); i-- > first;) values[i] -= values[i - 1];
  return values;
}

/// The inverse; empty if a count exceeds its limits. The limits of the terms, checked when they
/// were read, prevent overflow of every sum.
std::optional<Series> summed(const Series& terms, std::size_t count) {
  if (std::abs(terms.front()) > kMaxCount) return std::nullopt;
  if (terms.size() == 1) return Series(count, terms.front());
  Series values = terms;
  std::int64_t slope = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    slope += terms[i];
    values[i] = values[i - 1] + slope;
    if (std::abs(values[i]) > kMaxCount || std::abs(slope) > 2 * kMaxCount) return std::nullopt;
  }
  return values;
}

void describe(auto& io, Is<Header> auto& header) {
  io.require({"schema", "written_by", "scene", "scene_hash", "position_quantum_mm"});
  io.constant("schema", "claystack-session-1");
  io.written_by();
  io.text("scene", header.scene_name);
  io.template coded<HashCode>("scene_hash", header.scene_hash);
  io.constant("position_quantum_mm", "2^-16");
}

void describe(auto& io, Is<Block> auto& block) {
  io.require({"n", "t_us", "x", "y", "z", "trim", "check"});
  io.integer("n", block.count, 1, kPosesPerBlock);
  io.integer("t_us", block.first_us, 0, kMaxTimeUs);
  io.series("dt_us", block.steps_us, 1, kMaxTimeUs);
  for (std::size_t axis = 0; axis < 3; ++axis)
    io.series(kAxes[axis], block.coordinates[axis], -4 * kMaxCount, 4 * kMaxCount);
  io.series("trim", block.trim, 0, 1);
  io.series("gap", block.gap, -4 * kMaxCount, 4 * kMaxCount);
  io.template coded<HashCode>("check", block.check);
  io.check([&](ObjectReader& reader) {
    const auto sized = [&](const Series& series, std::string_view name, std::size_t size) {
      reader.expect(series.size() == 1 || series.size() == size, name,
                    "one integer or an array of " + std::to_string(size));
    };
    if (block.count > 1) reader.require({"dt_us"});
    sized(block.steps_us, "dt_us", block.count - 1);
    for (std::size_t axis = 0; axis < 3; ++axis)
      sized(block.coordinates[axis], kAxes[axis], block.count);
    sized(block.trim, "trim", block.count);
    if (!block.gap.empty()) sized(block.gap, "gap", block.count);
  });
}

Result<std::vector<Pose>> decode(const LocatedJson& line, const Block& block) {
  std::vector<Pose> poses(block.count);
  std::int64_t time_us = block.first_us;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i > 0) time_us += block.steps_us.size() == 1 ? block.steps_us[0] : block.steps_us[i - 1];
    poses[i].time_us = time_us;
    poses[i].trim = (block.trim.size() == 1 ? block.trim[0] : block.trim[i]) != 0;
  }
  if (time_us > kMaxTimeUs)
    return tl::make_unexpected(line.field_error(
        {"dt_us"}, "expected times up to " + std::to_string(kMaxTimeUs) + ", found later ones"));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto counts = summed(block.coordinates[axis], block.count);
    if (!counts)
      return tl::make_unexpected(line.field_error(
          {kAxes[axis]}, "expected positions within 1e6 mm of the origin, found one beyond"));
    for (std::size_t i = 0; i < poses.size(); ++i)
      poses[i].position_mm[static_cast<glm::length_t>(axis)] = mm_of((*counts)[i]);
  }
  if (!block.gap.empty()) {
    const auto counts = summed(block.gap, block.count);
    if (!counts || std::ranges::min(*counts) < 0)
      return tl::make_unexpected(
          line.field_error({"gap"}, "expected gaps from 0 to 1e6 mm, found one outside"));
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i].gap_mm = mm_of((*counts)[i]);
  }
  if (const auto found = checksum(poses); found != block.check)
    return tl::make_unexpected(line.field_error(
        {"check"}, "expected " + HashCode::encode(found) + " for these poses, found " +
                       HashCode::encode(block.check) + ": the line is damaged"));
  return poses;
}

}  // namespace

std::size_t files::announced_poses(std::string_view line) {
  constexpr std::string_view kBegin = R"({"n":)";
  if (!line.starts_with(kBegin)) return 0;
  std::size_t count = 0;
  std::from_chars(line.data() + kBegin.size(), line.data() + line.size(), count);
  return std::min(count, kPosesPerBlock);
}

Result<std::size_t> files::count_announced(std::string_view text, std::string_view name) {
  std::size_t count = 0;
  LineReader lines(text);
  while (const auto line = lines.next()) count += announced_poses(*line);
  if (count <= kMaxPoses) return count;
  return failure(ErrorKind::bad_input,
                 std::string(name) + ": expected at most " + std::to_string(kMaxPoses) +
                     " poses, found " + std::to_string(count) + ", which would take " +
                     std::to_string((count * sizeof(Pose)) >> 20) + " MiB of memory");
}

Result<void> files::append_block(const LocatedJson& line, std::vector<Pose>& poses,
                                 std::size_t room) {
  return ObjectReader::read(line, Block{})
      .and_then([&](const Block& block) -> Result<std::vector<Pose>> {
        if (block.count <= room) return decode(line, block);
        return tl::make_unexpected(line.field_error(
            {"n"}, "expected at most " + std::to_string(kMaxPoses) + " poses in all, found more"));
      })
      .and_then([&](const std::vector<Pose>& more) -> Result<void> {
        if (!poses.empty() && more.front().time_us <= poses.back().time_us)
          return tl::make_unexpected(line.field_error(
              {"t_us"}, "expected a time after " + std::to_string(poses.back().time_us) +
                            ", found " + std::to_string(more.front().time_us)));
        poses.insert(poses.end(), more.begin(), more.end());
        return {};
      });
}

Pose quantized(Pose pose) noexcept {
  for (int axis = 0; axis < 3; ++axis)
    pose.position_mm[axis] = mm_of(count_of(pose.position_mm[axis]));
  pose.gap_mm = std::max(0.0, mm_of(count_of(pose.gap_mm)));
  return pose;
}

std::string session_header(std::string_view scene_name, std::uint64_t scene_hash) {
  return json_line(ObjectWriter::write(Header{std::string(scene_name), scene_hash})) + "\n";
}

std::string session_block(std::span<const Pose> poses) {
  if (poses.empty()) return {};
  Block block;
  block.count = poses.size();
  block.first_us = poses.front().time_us;
  block.check = checksum(poses);
  const bool gaps = has_gaps(poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i > 0) block.steps_us.push_back(poses[i].time_us - poses[i - 1].time_us);
    for (std::size_t axis = 0; axis < 3; ++axis)
      block.coordinates[axis].push_back(
          count_of(poses[i].position_mm[static_cast<glm::length_t>(axis)]));
    block.trim.push_back(poses[i].trim ? 1 : 0);
    if (gaps) block.gap.push_back(count_of(poses[i].gap_mm));
  }
  block.steps_us = shortened(std::move(block.steps_us));
  for (Series& counts : block.coordinates) counts = differenced(std::move(counts));
  block.trim = shortened(std::move(block.trim));
  block.gap = differenced(std::move(block.gap));
  return json_line(ObjectWriter::write(block)) + "\n";
}

std::string session_blocks(std::span<const Pose> poses) {
  std::string text;
  while (!poses.empty()) {
    const auto block = poses.first(std::min(poses.size(), kPosesPerBlock));
    text += session_block(block);
    poses = poses.subspan(block.size());
  }
  return text;
}

std::string write_session(const Session& session) {
  return session_header(session.scene_name, session.scene_hash) + session_blocks(session.poses);
}

Result<Session> parse_session(std::string_view text, std::string_view name) {
  LineReader lines(text);
  const auto document = [&](std::string_view line) {
    return LocatedJson::from_json(line, name, kMaxBlockValues, lines.number());
  };
  const auto refused = [&](const Error& error) {
    return tl::make_unexpected(kind_error(error, text, name, "a session (.session)"));
  };
  const auto first = lines.next();
  if (!first)
    return refused(
        {ErrorKind::bad_input, std::string(name) + ":1: expected a whole header line, found " +
                                   std::to_string(text.size()) + " bytes without a newline"});
  auto header = document(*first).and_then(
      [](const LocatedJson& line) { return ObjectReader::read(line, Header{}); });
  if (!header) return refused(header.error());

  const auto announced = count_announced(lines.rest(), name);
  if (!announced) return tl::make_unexpected(announced.error());
  Session session{std::move(header->scene_name), header->scene_hash, {}, false};
  session.poses.reserve(*announced);
  while (const auto line = lines.next()) {
    // An editor may have ended a torn line with a newline; nothing can follow it.
    if (lines.rest().empty() && is_unfinished_json(*line)) {
      session.torn = true;
      return session;
    }
    const auto appended = document(*line).and_then([&](const LocatedJson& block) {
      return append_block(block, session.poses, kMaxPoses - session.poses.size());
    });
    if (!appended) return tl::make_unexpected(appended.error());
  }
  session.torn = !lines.rest().empty();
  return session;
}

std::uint64_t hash_of(const SceneSpec& scene) {
  // Without the version that wrote it.
  Json json = scene_json(scene);
  json.erase("written_by");
  Fnv1a hash;
  hash.add(json_text(json));
  return hash.value();
}

}  // namespace clay
