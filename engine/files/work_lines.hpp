#pragma once
// The line types of a work file, and the choices of redo.

#include "claystack/engine/files.hpp"
#include "core/fnv1a.hpp"
#include "core/json/json_text.hpp"
#include "core/json/object_reader.hpp"
#include "engine/files/pot_json.hpp"
#include "engine/files/text_codes.hpp"
#include "engine/tool/tool_state.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace clay::files {

inline constexpr auto kMostNodes = std::int64_t{1} << 31;

inline std::uint64_t check_of(std::string_view kind, std::initializer_list<std::uint64_t> values) {
  Fnv1a hash;
  hash.add(kind);
  for (const std::uint64_t value : values) hash.add(static_cast<std::int64_t>(value));
  return hash.value();
}

/// Like hash_of a scene: independent of the version that wrote it.
inline std::uint64_t hash_of(const std::optional<Pot>& start) {
  if (!start) return 0;
  Json json = pot_json(*start, false);
  json.erase("written_by");
  Fnv1a hash;
  hash.add(json_line(json));
  return hash.value();
}

/// Shifts the times so that the first pose is in the first period of the clock: the throw stays the
/// same.
inline void to_zero(std::span<Pose> poses) {
  if (poses.empty()) return;
  const std::int64_t rest = poses.front().time_us % kClockPeriodUs;
  const std::int64_t by = poses.front().time_us - (rest < 0 ? rest + kClockPeriodUs : rest);
  for (Pose& pose : poses) pose.time_us -= by;
}

struct WorkHeader {};

struct NodeLine {
  std::size_t node = 0, parent = 0, scene = 0;
  std::uint64_t check = 0;
  /// Includes the scene, and the pot of the root.
  [[nodiscard]] std::uint64_t expected(std::uint64_t scene_hash, std::uint64_t start_hash) const {
    return check_of("node", {node, parent, scene, scene_hash, start_hash});
  }
};

struct EndLine {
  std::size_t poses = 0;
  std::vector<std::int64_t> splits;
  std::uint64_t check = 0;
  [[nodiscard]] std::uint64_t expected() const {
    std::uint64_t sum = check_of("end", {poses});
    for (const std::int64_t split : splits)
      sum = check_of("split", {sum, static_cast<std::uint64_t>(split)});
    return sum;
  }
};

struct AtLine {
  std::size_t node = 0;
  std::uint64_t check = 0;
  [[nodiscard]] std::uint64_t expected() const { return check_of("at", {node}); }
};

struct SavedLine {
  std::size_t node = 0, nodes = 0;
  std::uint64_t check = 0;
  [[nodiscard]] std::uint64_t expected() const { return check_of("saved", {node, nodes}); }
};

void describe(auto& io, Is<WorkHeader> auto&) {
  io.require({"schema", "written_by", "position_quantum_mm"});
  io.constant("schema", "claystack-work-1");
  io.written_by();
  io.constant("position_quantum_mm", "2^-16");
}

void describe(auto& io, Is<NodeLine> auto& line) {
  io.require({"node", "parent", "scene", "check"});
  io.integer("node", line.node, 0, kMostNodes);
  io.integer("parent", line.parent, 0, kMostNodes);
  io.integer("scene", line.scene, 0, kMostNodes);
  io.template coded<HashCode>("check", line.check);
}

void describe(auto& io, Is<EndLine> auto& line) {
  io.require({"end", "check"});
  io.integer("end", line.poses, 0, std::numeric_limits<std::int64_t>::max());
  io.series("splits", line.splits, 1, std::numeric_limits<std::int64_t>::max());
  io.template coded<HashCode>("check", line.check);
}

void describe(auto& io, Is<AtLine> auto& line) {
  io.require({"at", "check"});
  io.integer("at", line.node, 0, kMostNodes);
  io.template coded<HashCode>("check", line.check);
}

void describe(auto& io, Is<SavedLine> auto& line) {
  io.require({"saved", "nodes", "check"});
  io.integer("saved", line.node, 0, kMostNodes);
  io.integer("nodes", line.nodes, 1, kMostNodes);
  io.template coded<HashCode>("check", line.check);
}

/// Records when each node was last current. Redo leads to the child whose branch had the current
/// node last. Linear in the size of the tree, for any number of changes.
class Visits {
 public:
  explicit Visits(std::size_t nodes = 0) : last_(nodes, 0) {}
  void visit(std::size_t node) {
    if (node >= last_.size()) last_.resize(node + 1, 0);
    last_[node] = ++clock_;
  }
  /// Calls look(node, child to which redo leads or 0), children before parents; the result true
  /// means that the wanted child has now been visited instead.
  template <class Look>
  void from_leaves(std::span<const WorkNode> nodes, Look look) {
    std::vector<std::uint64_t> below(nodes.size(), 0);
    std::vector<std::size_t> taken(nodes.size(), 0);
    for (std::size_t i = nodes.size(); i-- > 0;) {
      if (look(i, taken[i])) below[i] = ++clock_;
      const std::uint64_t latest = std::max(last_[i], below[i]);
      if (i == 0 || latest <= below[nodes[i].parent]) continue;
      below[nodes[i].parent] = latest;
      taken[nodes[i].parent] = i;
    }
  }

 private:
  std::uint64_t clock_ = 0;
  std::vector<std::uint64_t> last_;
};

}  // namespace clay::files
