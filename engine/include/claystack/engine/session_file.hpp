#pragma once
// `*.session`: one JSON value a line, described by samples/schema/session.schema.json.
// The first line is the header (schema, version, name and hash of the scene); every further
// line is a block of at most 100 poses, second differences of counts of 2^-16 mm, with a
// checksum; gaps are in it only where a pose has one. A recorder appends whole lines, so a killed
// one loses at most its last block.

#include "claystack/engine/pose.hpp"
#include "claystack/engine/result.hpp"
#include "claystack/engine/scene.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay {

/// Positions in a session are counted: 2^-16 mm, far below any device's step. A recorder
/// plays the pose it writes, not the one it measured, so that a replay gives the same bits.
/// `quantized` takes the nearest count, at most 1e6 mm from the origin, and 0 for a NaN; of a gap
/// likewise, and 0 for a negative one.
inline constexpr double kPoseQuantaPerMm = 65536.0;
[[nodiscard]] Pose quantized(Pose pose) noexcept;

struct Session {
  std::string scene_name;        ///< of the scene it was played on
  std::uint64_t scene_hash = 0;  ///< hash_of(scene); 0 where unknown
  std::vector<Pose> poses;       ///< quantised, times strictly increasing
  bool torn = false;             ///< the last line was cut off, as by a killed recorder
};

inline constexpr std::size_t kPosesPerBlock = 100;

/// The most poses of a session, and of all strokes of a work together: 2.7 hours at 1 kHz, 460 MiB
/// in memory.
inline constexpr std::size_t kMaxPoses = 10'000'000;
/// The largest session file that is read [bytes]: more than 50 for each of kMaxPoses, of which a
/// hand needs 20. With it, a session takes less than 1 GiB to read.
inline constexpr std::size_t kMaxSessionBytes = std::size_t{512} << 20;

/// The header line, with its newline.
std::string session_header(std::string_view scene_name, std::uint64_t scene_hash);
/// One block line, with its newline. At most kPosesPerBlock poses, times from 0 to 2^53 us
/// and strictly increasing. Nothing for no poses.
std::string session_block(std::span<const Pose> poses);
/// Header and all blocks.
std::string write_session(const Session& session);

/// Errors read "NAME:LINE: what was expected, what was found". An unfinished last line is
/// dropped and reported in `torn`; a damaged line anywhere is an error. More than kMaxPoses are
/// refused before the first of them is read. Takes the memory of the poses, and of one block.
Result<Session> parse_session(std::string_view text, std::string_view name);

/// FNV-1a over the text that write_scene gives, without its `written_by`: the scene whatever its
/// layout on disk and the version that wrote it.
[[nodiscard]] std::uint64_t hash_of(const SceneSpec& scene);

}  // namespace clay
