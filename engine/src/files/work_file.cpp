#include "claystack/engine/work_file.hpp"

#include "claystack/engine/session_file.hpp"
#include "files/fnv1a.hpp"
#include "files/json_text.hpp"
#include "files/line_reader.hpp"
#include "files/object_reader.hpp"
#include "files/object_writer.hpp"
#include "files/pot_json.hpp"
#include "files/scene_json.hpp"
#include "files/session_json.hpp"
#include "files/text_codes.hpp"

#include <algorithm>
#include <cassert>
#include <initializer_list>
#include <limits>

namespace clay {
namespace {

using namespace files;

constexpr std::size_t kMaxLineValues = 100'000;  // as of a scene; a pot has more
constexpr auto kMostNodes = std::int64_t{1} << 31;

std::uint64_t check_of(std::string_view kind, std::initializer_list<std::uint64_t> values) {
  Fnv1a hash;
  hash.add(kind);
  for (const std::uint64_t value : values) hash.add(static_cast<std::int64_t>(value));
  return hash.value();
}

/// As hash_of a scene: whichever version wrote it.
std::uint64_t hash_of(const std::optional<Pot>& start) {
  if (!start) return 0;
  Json json = pot_json(*start, false);
  json.erase("written_by");
  Fnv1a hash;
  hash.add(json_line(json));
  return hash.value();
}

struct Header {};

struct NodeLine {
  std::size_t node = 0, parent = 0, scene = 0;
  std::uint64_t check = 0;
  /// Over the scene too, and the pot that the root is.
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

void describe(auto& io, Is<Header> auto&) {
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

template <class Line>
std::string text_of(const Line& line) {
  return json_line(ObjectWriter::write(line)) + "\n";
}

template <class Line>
std::string checked_text(Line line) {
  line.check = line.expected();
  return text_of(line);
}

std::string node_text(NodeLine line, const SceneSpec& spec, const std::optional<Pot>& start) {
  line.check = line.expected(hash_of(spec), hash_of(start));
  return text_of(line);
}

/// When the nodes of a tree were last the current one, and where redo leads therefore: to the child
/// below which it was last. Linear in the tree, however often a file goes to and fro in it.
class Visits {
 public:
  explicit Visits(std::size_t nodes = 0) : last_(nodes, 0) {}
  void visit(std::size_t node) {
    if (node >= last_.size()) last_.resize(node + 1, 0);
    last_[node] = ++clock_;
  }
  /// look(node, child to which redo leads or 0), children before parents; true: the child that was
  /// wanted instead has been visited now.
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

/// Reads line after line into a record. After an error it holds what stood before that line.
class WorkBuilder {
 public:
  Result<void> take(const LocatedJson& line) {
    const Json& root = line.root();
    if (root.contains("n")) return take_block(line);
    if (root.contains("end")) return take_end(line);
    if (running_) return wrong(line, "the poses or the end of node " + last_number());
    if (root.contains("node")) return take_node(line);
    if (root.contains("at")) return take_at(line);
    if (root.contains("saved")) return take_saved(line);
    if (root.contains("rings")) return take_start(line);
    if (root.contains("lump")) return take_scene(line);
    return wrong(line, "a scene, a pot, a node, poses, an end, a place (at, saved)");
  }

  [[nodiscard]] bool has_root() const { return !work_.nodes.empty(); }
  [[nodiscard]] bool running() const { return running_; }
  WorkRecord finish() {
    if (running_) close({});
    std::vector<std::size_t> redo(work_.nodes.size(), 0);
    visits_.from_leaves(work_.nodes, [&](std::size_t node, std::size_t taken) {
      redo[node] = taken;
      return false;
    });
    for (std::size_t i = 0; i < redo.size(); ++i) work_.nodes[i].taken = redo[i];
    return std::move(work_);
  }

 private:
  static Result<void> wrong(const LocatedJson& line, const std::string& expected) {
    const Json& root = line.root();
    const std::string first = root.is_object() && !root.empty()
                                  ? std::string("a line that begins with \"")
                                        .append(printable(root.begin().key()))
                                        .append("\"")
                                  : std::string("another value");
    return tl::make_unexpected(line.error_at({}, "expected " + expected + ", found " + first));
  }

  static Result<void> wrong_field(const LocatedJson& line, std::string_view field,
                                  const std::string& expected) {
    return tl::make_unexpected(
        line.field_error({field}, "expected " + expected + ", found " +
                                      printable(json_line(line.root().at(std::string(field))))));
  }

  static Result<void> damaged(const LocatedJson& line, std::uint64_t expected) {
    return wrong_field(line, "check", HashCode::encode(expected) + " for this line");
  }

  [[nodiscard]] std::string last_number() const { return std::to_string(work_.nodes.size() - 1); }
  [[nodiscard]] std::string count_text() const { return std::to_string(work_.nodes.size()); }

  Result<void> take_scene(const LocatedJson& line) {
    return scene_of(line).map([&](SceneSpec scene) {
      scene_hashes_.push_back(clay::hash_of(scene));
      work_.scenes.push_back(std::move(scene));
    });
  }

  Result<void> take_start(const LocatedJson& line) {
    if (has_root() || work_.start)
      return wrong(line, "one pot at most, before node 0; a scene, a node or a place");
    return pot_of(line).map([&](Pot pot) { work_.start = std::move(pot); });
  }

  Result<void> take_node(const LocatedJson& line) {
    const auto read = ObjectReader::read(line, NodeLine{});
    if (!read) return tl::make_unexpected(read.error());
    const std::size_t count = work_.nodes.size();
    if (read->node != count) return wrong_field(line, "node", count_text());
    if (count == 0 ? read->parent != 0 : read->parent >= count)
      return wrong_field(line, "parent", count == 0 ? "0" : "a node below " + count_text());
    if (read->scene >= work_.scenes.size())
      return wrong_field(line, "scene",
                         "one of the " + std::to_string(work_.scenes.size()) + " scenes before");
    const auto check =
        read->expected(scene_hashes_[read->scene], count == 0 ? hash_of(work_.start) : 0);
    if (check != read->check) return damaged(line, check);
    work_.nodes.push_back({read->parent, read->scene, {}, 0});
    running_ = count > 0;
    if (count == 0) move_to(0);
    return {};
  }

  Result<void> take_block(const LocatedJson& line) {
    if (!running_) return wrong(line, "a node before its poses");
    return append_block(line, work_.nodes.back().poses);
  }

  Result<void> take_end(const LocatedJson& line) {
    if (!running_) return wrong(line, "a node before its end");
    const auto read = ObjectReader::read(line, EndLine{});
    if (!read) return tl::make_unexpected(read.error());
    const std::size_t poses = work_.nodes.back().poses.size();
    if (read->poses != poses)
      return wrong_field(line, "end", "the number of its poses, " + std::to_string(poses));
    const auto rises = std::ranges::adjacent_find(read->splits, std::greater_equal<>());
    if (!read->splits.empty() &&
        (rises != read->splits.end() || std::cmp_greater_equal(read->splits.back(), poses)))
      return wrong_field(line, "splits",
                         "increasing integers from 1 to below " + std::to_string(poses));
    if (read->expected() != read->check) return damaged(line, read->expected());
    close(read->splits);
    return {};
  }

  Result<void> take_at(const LocatedJson& line) {
    const auto read = ObjectReader::read(line, AtLine{});
    if (!read) return tl::make_unexpected(read.error());
    if (read->node >= work_.nodes.size())
      return wrong_field(line, "at", "a node below " + count_text());
    if (read->expected() != read->check) return damaged(line, read->expected());
    move_to(read->node);
    return {};
  }

  Result<void> take_saved(const LocatedJson& line) {
    const auto read = ObjectReader::read(line, SavedLine{});
    if (!read) return tl::make_unexpected(read.error());
    if (read->nodes > work_.nodes.size())
      return wrong_field(line, "nodes", "at most " + count_text());
    if (read->node >= read->nodes)
      return wrong_field(line, "saved", "a node below " + std::to_string(read->nodes));
    if (read->expected() != read->check) return damaged(line, read->expected());
    work_.saved_at = read->node;
    work_.saved_nodes = read->nodes;
    return {};
  }

  /// The stroke that runs becomes one node, or several.
  void close(std::span<const std::int64_t> splits) {
    const WorkNode whole = std::move(work_.nodes.back());
    work_.nodes.pop_back();
    std::size_t parent = whole.parent, begin = 0;
    for (std::size_t part = 0; part <= splits.size(); ++part) {
      const std::size_t end =
          part < splits.size() ? static_cast<std::size_t>(splits[part]) : whole.poses.size();
      const auto poses = std::span(whole.poses).subspan(begin, end - begin);
      work_.nodes.push_back({parent, whole.scene, from_zero(poses), 0});
      parent = work_.nodes.size() - 1;
      begin = end;
    }
    move_to(parent);
    running_ = false;
  }

  void move_to(std::size_t node) {
    visits_.visit(node);
    work_.at = node;
  }

  WorkRecord work_;
  std::vector<std::uint64_t> scene_hashes_;
  Visits visits_;
  bool running_ = false;
};

std::size_t most_values(std::string_view line) {
  return line.starts_with(R"({"schema":"claystack-pot)") ? kMaxPotValues : kMaxLineValues;
}

Result<WorkReading> read_work(std::string_view text, std::string_view name, bool lenient) {
  LineReader lines(text);
  const auto document = [&](std::string_view line) {
    return LocatedJson::from_json(line, name, most_values(line), lines.number());
  };
  const auto first = lines.next();
  if (!first)
    return failure(ErrorKind::bad_input,
                   std::string(name) + ":1: expected a whole header line, found " +
                       std::to_string(text.size()) + " bytes without a newline");
  const auto header = document(*first).and_then(
      [](const LocatedJson& line) { return ObjectReader::read(line, Header{}); });
  if (!header) return tl::make_unexpected(header.error());

  WorkReading reading;
  WorkBuilder builder;
  reading.sound_bytes = text.size() - lines.rest().size();
  while (const auto line = lines.next()) {
    // An editor may have ended a torn line with a newline; nothing can stand behind it.
    reading.torn = lines.rest().empty() && is_unfinished_json(*line);
    if (reading.torn) break;
    const auto taken =
        document(*line).and_then([&](const LocatedJson& read) { return builder.take(read); });
    if (!taken) {
      if (!lenient || !builder.has_root()) return tl::make_unexpected(taken.error());
      reading.damage = taken.error();
      break;
    }
    reading.sound_bytes = text.size() - lines.rest().size();
  }
  reading.torn = reading.torn || (!reading.damage && !lines.rest().empty());
  if (!builder.has_root())
    return failure(ErrorKind::bad_input, std::string(name) + ":" +
                                             std::to_string(lines.number() + 1) +
                                             ": expected node 0, found the end of the file");
  reading.running = builder.running();
  reading.work = builder.finish();
  return reading;
}

/// `at` lines after which redo leads where it did. The deepest first: going there changes what redo
/// does at all nodes above.
std::string choices(const WorkRecord& work) {
  const std::size_t count = work.nodes.size();
  Visits visits(count);
  for (std::size_t i = 0; i < count; ++i) visits.visit(i);
  std::string lines;
  std::size_t at = count - 1;
  visits.from_leaves(work.nodes, [&](std::size_t node, std::size_t taken) {
    const std::size_t wanted = work.nodes[node].taken;
    if (wanted == 0 || taken == wanted) return false;
    lines += work_at_line(at = wanted);
    return true;
  });
  return at == work.at ? lines : lines + work_at_line(work.at);
}

}  // namespace

std::vector<std::size_t> way_to(std::span<const WorkNode> nodes, std::size_t node) {
  std::vector<std::size_t> way = {node};
  while (way.back() != 0) way.push_back(nodes[way.back()].parent);
  std::ranges::reverse(way);
  return way;
}

void go_to(WorkRecord& work, std::size_t node) {
  assert(node < work.nodes.size());
  for (std::size_t at = node; at != 0; at = work.nodes[at].parent)
    work.nodes[work.nodes[at].parent].taken = at;
  work.at = node;
}

std::vector<Pose> from_zero(std::span<const Pose> poses) {
  std::vector<Pose> shifted(poses.begin(), poses.end());
  for (Pose& pose : shifted) pose.time_us -= poses.front().time_us;
  return shifted;
}

std::string work_scene_line(const SceneSpec& scene) { return json_line(scene_json(scene)) + "\n"; }

std::string work_stroke_line(std::size_t node, std::size_t parent, std::size_t scene,
                             const SceneSpec& spec) {
  return node_text({node, parent, scene, 0}, spec, std::nullopt);
}

std::string work_end_line(std::size_t poses, std::span<const std::size_t> splits) {
  return checked_text(EndLine{poses, {splits.begin(), splits.end()}, 0});
}

std::string work_at_line(std::size_t node) { return checked_text(AtLine{node, 0}); }

std::string work_saved_line(std::size_t node, std::size_t nodes) {
  return checked_text(SavedLine{node, nodes, 0});
}

std::string write_work(const WorkRecord& work) {
  std::string text = text_of(Header{});
  for (const SceneSpec& scene : work.scenes) text += work_scene_line(scene);
  if (work.start) text += json_line(pot_json(*work.start, false)) + "\n";
  for (std::size_t i = 0; i < work.nodes.size(); ++i) {
    const WorkNode& node = work.nodes[i];
    text += node_text({i, node.parent, node.scene, 0}, work.scenes[node.scene],
                      i == 0 ? work.start : std::nullopt);
    if (i == 0) continue;
    for (std::span<const Pose> rest = node.poses; !rest.empty();) {
      const auto block = rest.first(std::min(rest.size(), kPosesPerBlock));
      text += session_block(block);
      rest = rest.subspan(block.size());
    }
    text += work_end_line(node.poses.size(), {});
  }
  return text + choices(work);
}

Result<WorkReading> parse_work(std::string_view text, std::string_view name) {
  return read_work(text, name, false);
}

Result<WorkReading> salvage_work(std::string_view text, std::string_view name) {
  return read_work(text, name, true);
}

}  // namespace clay
