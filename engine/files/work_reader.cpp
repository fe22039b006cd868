#include "claystack/engine/files.hpp"
#include "core/line_reader.hpp"
#include "core/text.hpp"
#include "engine/files/scene_json.hpp"
#include "engine/files/session_json.hpp"
#include "engine/files/work_lines.hpp"

#include <functional>
#include <utility>

namespace clay {
namespace {

using namespace files;

constexpr std::size_t kMaxLineValues = 100'000;  // the limit for a scene; a pot has more

/// Reads lines into a record. After an error it holds everything before that line.
class WorkBuilder {
 public:
  /// `rest`: the following lines.
  Result<void> take(const LocatedJson& line, LineReader rest) {
    const Json& root = line.root();
    if (root.contains("n")) return take_block(line);
    if (root.contains("end")) return take_end(line);
    if (running_) return wrong(line, "the poses or the end of node " + last_number());
    if (root.contains("node"))
      return take_node(line).map([&] { make_room(work_.nodes.back().poses, rest); });
    if (root.contains("at")) return take_at(line);
    if (root.contains("saved")) return take_saved(line);
    if (root.contains("rings") || root.contains("rounded_rings")) return take_start(line);
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
    return files::pot_of(line).map([&](Pot pot) { work_.start = std::move(pot); });
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
        read->expected(scene_hashes_[read->scene], count == 0 ? files::hash_of(work_.start) : 0);
    if (check != read->check) return damaged(line, check);
    work_.nodes.push_back({read->parent, read->scene, {}, 0});
    running_ = count > 0;
    if (count == 0) move_to(0);
    return {};
  }

  Result<void> take_block(const LocatedJson& line) {
    if (!running_) return wrong(line, "a node before its poses");
    std::vector<Pose>& poses = work_.nodes.back().poses;
    const std::size_t before = poses.size();
    return append_block(line, poses, kMaxPoses - poses_).map([&] {
      poses_ += poses.size() - before;
    });
  }

  /// Reserves memory for the following blocks.
  static void make_room(std::vector<Pose>& poses, LineReader lines) {
    std::size_t announced = 0;
    while (const auto line = lines.next()) {
      const std::size_t more = announced_poses(*line);
      if (more == 0 || announced + more > kMaxPoses) break;
      announced += more;
    }
    poses.reserve(announced);
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

  /// The running stroke becomes one or several nodes.
  void close(std::span<const std::int64_t> splits) {
    running_ = false;
    WorkNode& only = work_.nodes.back();
    if (splits.empty()) {
      to_zero(only.poses);
      return move_to(work_.nodes.size() - 1);
    }
    const WorkNode whole = std::move(only);
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
  }

  void move_to(std::size_t node) {
    visits_.visit(node);
    work_.at = node;
  }

  WorkRecord work_;
  std::vector<std::uint64_t> scene_hashes_;
  Visits visits_;
  std::size_t poses_ = 0;  ///< of all nodes
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
      [](const LocatedJson& line) { return ObjectReader::read(line, WorkHeader{}); });
  if (!header) return tl::make_unexpected(header.error());

  // After a crash, everything that can be kept is read.
  if (const auto announced = count_announced(lines.rest(), name); !announced && !lenient)
    return tl::make_unexpected(announced.error());
  WorkReading reading;
  WorkBuilder builder;
  reading.sound_bytes = text.size() - lines.rest().size();
  while (const auto line = lines.next()) {
    // An editor may have ended a torn line with a newline; nothing can follow it.
    reading.torn = lines.rest().empty() && is_unfinished_json(*line);
    if (reading.torn) break;
    const auto taken = document(*line).and_then(
        [&](const LocatedJson& read) { return builder.take(read, lines); });
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

}  // namespace

Result<WorkReading> parse_work(std::string_view text, std::string_view name) {
  return read_work(text, name, false).map_error([&](Error error) {
    return kind_error(std::move(error), text, name, "a work (.work)");
  });
}

Result<WorkReading> salvage_work(std::string_view text, std::string_view name) {
  return read_work(text, name, true);
}

}  // namespace clay
