#include "claystack/engine/files.hpp"

#include "core/json/object_writer.hpp"
#include "engine/files/scene_json.hpp"
#include "engine/files/work_lines.hpp"

#include <algorithm>
#include <cassert>

namespace clay {
namespace {

using namespace files;

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
  line.check = line.expected(clay::hash_of(spec), files::hash_of(start));
  return text_of(line);
}

/// The `at` lines that restore the choices of redo. The deepest come first, because visiting a node
/// changes the choices at all nodes above it.
std::string choices(const WorkRecord& work) {
  const std::size_t count = work.nodes.size();
  Visits visits(count);
  for (std::size_t i = 0; i < count; ++i) visits.visit(i);
  std::string lines;
  std::size_t at = count - 1;
  visits.from_leaves(work.nodes, [&](std::size_t node, std::size_t taken) {
    const std::size_t wanted = work.nodes[node].taken;
    if (wanted == 0 || taken == wanted) return false;
    at = wanted;
    lines += work_at_line(at);
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
  to_zero(shifted);
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
  std::string text = text_of(WorkHeader{});
  for (const SceneSpec& scene : work.scenes) text += work_scene_line(scene);
  if (work.start) text += json_line(pot_json(*work.start, false)) + "\n";
  for (std::size_t i = 0; i < work.nodes.size(); ++i) {
    const WorkNode& node = work.nodes[i];
    text += node_text({i, node.parent, node.scene, 0}, work.scenes[node.scene],
                      i == 0 ? work.start : std::nullopt);
    if (i == 0) continue;
    text += session_blocks(node.poses);
    text += work_end_line(node.poses.size(), {});
  }
  return text + choices(work);
}

}  // namespace clay
