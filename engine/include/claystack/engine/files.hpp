#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay {

// ---- scene file ----------------------------------------------------------------------
// `*.scene.json`: strict JSON, described by samples/schema/scene.schema.json.

/// Errors read "NAME:LINE: FIELD: what was expected, what was found". Unknown fields, duplicate
/// keys, wrong types and values outside their range are errors. `schema`, `lump` and `tool` must
/// be there; what else is absent takes its default in SceneSpec, but without `force` or
/// `stability` that stage is left out.
Result<SceneSpec> parse_scene(std::string_view text, std::string_view name);
/// Every field, defaults too. A value outside its range is written as it is, for the reader to
/// refuse.
std::string write_scene(const SceneSpec& scene);

// ---- session file --------------------------------------------------------------------
// `*.session`: one JSON value a line, described by samples/schema/session.schema.json.
// The first line is the header (schema, version, name and hash of the scene); every further
// line is a block of at most 100 poses, second differences of counts of 2^-16 mm, with a
// checksum; gaps are in it only where a pose has one. A recorder appends whole lines, so a killed
// one loses at most its last block.

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

// ---- pot file ------------------------------------------------------------------------
// `*.pot.json` and `*.pot.cbor`: one schema (samples/schema/pot.schema.json), exact integers.
// JSON adds the radii in mm for people; a reader checks that they agree with the integers. Radii
// of a rounded pot are stored as second differences, a byte or two each in CBOR.

enum class PotEncoding { json, cbor };

/// Takes CBOR (first byte that of a map) or JSON. Errors name line (JSON) or field (CBOR). The
/// ledger must balance to the quantum, or the file is refused.
Result<Pot> parse_pot(std::string_view bytes, std::string_view name);
/// Equal pots give equal bytes. A pot whose radii are not the multiples that `Pot::rounding` says
/// is written as an exact one.
std::string write_pot(const Pot& pot, PotEncoding encoding);

// ---- work file -----------------------------------------------------------------------
// `*.work`: a pot and all strokes that led to it, undone ones too; one JSON value a line, described
// by samples/schema/work.schema.json. Scenes, the pot it began with, and blocks of poses stand in
// it as in their own files. Lines are only ever appended, so the file of a work, the journal of one
// that goes on and what a killed program leaves are one format.

/// A stroke and where it leads to: pot(node) = the poses, thrown with the node's scene on
/// pot(parent). Node 0 is the root: the pot as it was before any stroke.
struct WorkNode {
  std::size_t parent = 0;   ///< below the node's own number
  std::size_t scene = 0;    ///< index
  std::vector<Pose> poses;  ///< quantised, times strictly increasing from 0
  std::size_t taken = 0;    ///< child that redo follows; 0: there is none
  friend bool operator==(const WorkNode&, const WorkNode&) = default;
};

/// All that a work file holds.
struct WorkRecord {
  std::vector<SceneSpec> scenes;
  std::optional<Pot> start;     ///< none: the root is the lump of its scene
  std::vector<WorkNode> nodes;  ///< the root at least
  std::size_t at = 0;           ///< current node
  std::size_t saved_at = 0;     ///< current node when the work was last saved,
  std::size_t saved_nodes = 1;  ///< and how many there were; a journal alone knows it
};

/// The nodes on the way from the root to `node`, the root first.
[[nodiscard]] std::vector<std::size_t> way_to(std::span<const WorkNode> nodes, std::size_t node);
/// `node` becomes the current one, and redo leads to it from all before it.
void go_to(WorkRecord& work, std::size_t node);
/// The same poses with the first at time 0.
[[nodiscard]] std::vector<Pose> from_zero(std::span<const Pose> poses);

/// What was read, and how it ended.
struct WorkReading {
  WorkRecord work;
  bool torn = false;            ///< the last line was cut off; it is not in
  bool running = false;         ///< the last stroke has no end: what there is of it is a node
  std::size_t sound_bytes = 0;  ///< the whole lines
  std::optional<Error> damage;  ///< lenient only: what is wrong in the line behind them
};

/// Strict: errors read "NAME:LINE: what was expected, what was found". An unfinished last line is
/// dropped and reported; a damaged line anywhere is an error. More than kMaxPoses
/// (session_file.hpp) are refused before the first of them is read. Takes the memory of the poses,
/// and of one line.
Result<WorkReading> parse_work(std::string_view text, std::string_view name);
/// For what a crash left: reads up to the first damaged line, or to kMaxPoses. An error only when
/// the root is not before it.
Result<WorkReading> salvage_work(std::string_view text, std::string_view name);
/// The whole file, compact: one line of going for each choice that redo remembers.
std::string write_work(const WorkRecord& work);

// Lines, each with its newline, for who appends as things happen. A stroke's line is followed by
// the session_block lines of its poses and by its end.
std::string work_scene_line(const SceneSpec& scene);  ///< its index is the count of those before
/// Stroke `node` begins, with the scene of that index.
std::string work_stroke_line(std::size_t node, std::size_t parent, std::size_t scene,
                             const SceneSpec& spec);
/// Ends a stroke of `poses` poses. At each of `splits`, increasing indices of poses, a new stroke
/// begins below the one before: a hand that holds an arm without a break makes several strokes.
std::string work_end_line(std::size_t poses, std::span<const std::size_t> splits);
std::string work_at_line(std::size_t node);  ///< undo, redo, or another branch
/// The first `nodes` nodes are in a file, which has `node` for its current one.
std::string work_saved_line(std::size_t node, std::size_t nodes);

}  // namespace clay
