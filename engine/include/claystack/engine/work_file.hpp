#pragma once
// `*.work`: a pot and all strokes that led to it, undone ones too; one JSON value a line, described
// by samples/schema/work.schema.json. Scenes, the pot it began with, and blocks of poses stand in
// it as in their own files. Lines are only ever appended, so the file of a work, the journal of one
// that goes on and what a killed program leaves are one format.

#include "claystack/engine/pose.hpp"
#include "claystack/engine/pot.hpp"
#include "claystack/engine/result.hpp"
#include "claystack/engine/scene.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay {

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
/// The stroke has so many poses. At each of `splits`, increasing indices of poses, a stroke of its
/// own begins, below the one before: one holding of an arm, several strokes.
std::string work_end_line(std::size_t poses, std::span<const std::size_t> splits);
std::string work_at_line(std::size_t node);  ///< undo, redo, or another branch
/// The first `nodes` nodes are in a file, which has `node` for its current one.
std::string work_saved_line(std::size_t node, std::size_t nodes);

}  // namespace clay
