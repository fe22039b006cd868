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
/// keys, wrong types and values out of range are errors. `schema`, `lump` and `tool` are required;
/// other absent fields take their defaults in SceneSpec, but an absent `force` or `stability`
/// leaves that stage out.
Result<SceneSpec> parse_scene(std::string_view text, std::string_view name);
/// Writes every field, including defaults. A value out of range is written unchanged; the reader
/// refuses it.
std::string write_scene(const SceneSpec& scene);

// ---- session file --------------------------------------------------------------------
// `*.session`: one JSON value per line, described by samples/schema/session.schema.json. The first
// line is the header (schema, version, name and hash of the scene); every further line is a block
// of at most 100 poses: second differences of counts of 2^-16 mm, with a checksum; gaps are present
// only if a pose has one. A recorder appends whole lines, so a killed recorder loses at most its
// last block.

/// Positions in a session are counted in 2^-16 mm, far below the step of any device. A recorder
/// plays the pose that it writes, not the measured one, so that a replay gives the same bits.
/// `quantized` rounds to the nearest count, at most 1e6 mm from the origin, and NaN to 0; the same
/// for a gap, with 0 for a negative one.
inline constexpr double kPoseQuantaPerMm = 65536.0;
[[nodiscard]] Pose quantized(Pose pose) noexcept;

struct Session {
  std::string scene_name;        ///< of its scene
  std::uint64_t scene_hash = 0;  ///< hash_of(scene); 0 if unknown
  std::vector<Pose> poses;       ///< quantised, times strictly increasing
  bool torn = false;             ///< the last line was incomplete, as after a killed recorder
};

inline constexpr std::size_t kPosesPerBlock = 100;

/// Poses that were played, in order.
struct PoseBlock {
  std::span<const Pose> poses;    ///< at most kPosesPerBlock, quantized, later than all before them
  std::span<const bool> contact;  ///< for each pose: whether the tool worked on the clay
};

/// Receives the poses of a stroke as they are played: a session or a journal. Called from one
/// thread at a time.
class PoseSink {
 public:
  virtual ~PoseSink() = default;
  /// After an error nothing more is appended.
  virtual Result<void> append(const PoseBlock& block) = 0;
  /// The end of the poses. An error: not all of them were stored.
  virtual Result<void> finish() = 0;
};

/// The most poses of a session, and of all strokes of a work together: 2.7 hours at 1 kHz, 460 MiB
/// in memory.
inline constexpr std::size_t kMaxPoses = 10'000'000;
/// The largest session file that is read [bytes]: more than 50 for each of kMaxPoses; a hand needs
/// 20. With this limit, reading a session takes less than 1 GiB of memory.
inline constexpr std::size_t kMaxSessionBytes = std::size_t{512} << 20;

/// The header line, with its newline.
std::string session_header(std::string_view scene_name, std::uint64_t scene_hash);
/// One block line, with its newline. At most kPosesPerBlock poses, times strictly increasing from 0
/// to 2^53 us. Empty for no poses.
std::string session_block(std::span<const Pose> poses);
/// Any number of poses, in lines of kPosesPerBlock and a last one of the rest.
std::string session_blocks(std::span<const Pose> poses);
/// Header and all blocks.
std::string write_session(const Session& session);

/// Errors read "NAME:LINE: what was expected, what was found". An unfinished last line is dropped
/// and reported in `torn`; a damaged line anywhere is an error. More than kMaxPoses are refused
/// before the first is read. Uses the memory of the poses and of one block.
Result<Session> parse_session(std::string_view text, std::string_view name);

/// FNV-1a of the text of write_scene without its `written_by`: independent of the file's layout and
/// of the version that wrote it.
[[nodiscard]] std::uint64_t hash_of(const SceneSpec& scene);

// ---- pot file ------------------------------------------------------------------------
// `*.pot.json` and `*.pot.cbor`: one schema (samples/schema/pot.schema.json), exact integers. JSON
// adds the radii in mm for people; the reader checks that they agree with the integers. Radii of a
// rounded pot are stored as second differences, one or two bytes each in CBOR.

enum class PotEncoding { json, cbor };

/// Reads CBOR (first byte that of a map) or JSON. Errors name line (JSON) or field (CBOR). A pot
/// whose ledger does not balance to the quantum is refused.
Result<Pot> parse_pot(std::string_view bytes, std::string_view name);
/// Equal pots give equal bytes. If the radii are not multiples of `Pot::rounding`, the pot is
/// written as an exact one.
std::string write_pot(const Pot& pot, PotEncoding encoding);

// ---- work file -----------------------------------------------------------------------
// `*.work`: a pot and all its strokes, including undone ones; one JSON value per line, described by
// samples/schema/work.schema.json. Scenes, the initial pot and blocks of poses have the form of
// their own files. Lines are only appended, so a saved work, the journal of a running one and the
// remains of a killed program share one format.

/// A stroke and its result: pot(node) = the poses, thrown with the node's scene on pot(parent).
/// Node 0 is the root: the pot before any stroke.
struct WorkNode {
  std::size_t parent = 0;   ///< below the node's own number
  std::size_t scene = 0;    ///< index
  std::vector<Pose> poses;  ///< quantised, times strictly increasing from 0
  std::size_t taken = 0;    ///< the child that redo follows; 0: none
  friend bool operator==(const WorkNode&, const WorkNode&) = default;
};

/// The contents of a work file.
struct WorkRecord {
  std::vector<SceneSpec> scenes;
  std::optional<Pot> start;     ///< if absent, the root is the lump of its scene
  std::vector<WorkNode> nodes;  ///< at least the root
  std::size_t at = 0;           ///< current node
  std::size_t saved_at = 0;     ///< current node when the work was last saved
  std::size_t saved_nodes = 1;  ///< and the number of nodes then; only a journal records both
};

/// The nodes on the path from the root to `node`, root first.
[[nodiscard]] std::vector<std::size_t> way_to(std::span<const WorkNode> nodes, std::size_t node);
/// Makes `node` the current one; redo from each of its ancestors leads to it.
void go_to(WorkRecord& work, std::size_t node);
/// Gives the same throw: shifts the times by whole periods of 9 ms, the first pose to the first.
[[nodiscard]] std::vector<Pose> from_zero(std::span<const Pose> poses);

/// The work that was read, and the state of its end.
struct WorkReading {
  WorkRecord work;
  bool torn = false;            ///< the last line was incomplete and was dropped
  bool running = false;         ///< the last stroke has no end: its recorded part is a node
  std::size_t sound_bytes = 0;  ///< length of the complete lines
  std::optional<Error> damage;  ///< lenient only: the error in the next line
};

/// Strict: errors read "NAME:LINE: what was expected, what was found". An unfinished last line is
/// dropped and reported; a damaged line anywhere is an error. A file that announces more than
/// kMaxPoses poses is refused before the first of them is read. Uses the memory of the poses and of
/// one line.
Result<WorkReading> parse_work(std::string_view text, std::string_view name);
/// For the remains of a crash: reads up to the first damaged line, or to kMaxPoses. Fails only if
/// the root cannot be read.
Result<WorkReading> salvage_work(std::string_view text, std::string_view name);
/// The whole file, compact: one `at` line for each choice that redo remembers.
std::string write_work(const WorkRecord& work);

// Lines, each with its newline, for appending during the work. A stroke's line is followed by the
// session_block lines of its poses and by its end line.
std::string work_scene_line(
    const SceneSpec& scene);  ///< its index is the number of scene lines before it
/// Begins stroke `node`, with the scene of that index.
std::string work_stroke_line(std::size_t node, std::size_t parent, std::size_t scene,
                             const SceneSpec& spec);
/// Ends a stroke of `poses` poses. `splits` holds increasing indices of poses; at each, a new
/// stroke begins as a child of the one before: a continuously held arm makes several strokes.
std::string work_end_line(std::size_t poses, std::span<const std::size_t> splits);
std::string work_at_line(std::size_t node);  ///< undo, redo, or another branch
/// Records that a file holds the first `nodes` nodes, with `node` as the current one.
std::string work_saved_line(std::size_t node, std::size_t nodes);

}  // namespace clay
