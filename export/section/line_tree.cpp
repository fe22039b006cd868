#include "export/section/line_tree.hpp"

#include "core/cancel.hpp"

#include <algorithm>
#include <utility>

namespace clay::solid::inline section {
namespace {

constexpr std::size_t kLeafEdges = 4;

double turn(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& c) {
  return (b.rho - a.rho) * (c.y - a.y) - (b.y - a.y) * (c.rho - a.rho);
}

bool cross(const LineEdge& a, const LineEdge& b) {
  const double from = turn(a.from, a.to, b.from), to = turn(a.from, a.to, b.to);
  if (!((from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0))) return false;
  const double left = turn(b.from, b.to, a.from), right = turn(b.from, b.to, a.to);
  return (left < 0.0 && right > 0.0) || (left > 0.0 && right < 0.0);
}

double distance2(const ProfilePoint& p, const LineEdge& edge) {
  const double rho = edge.to.rho - edge.from.rho, y = edge.to.y - edge.from.y;
  const double to_rho = p.rho - edge.from.rho, to_y = p.y - edge.from.y;
  const double t = std::clamp((to_rho * rho + to_y * y) / (rho * rho + y * y), 0.0, 1.0);
  const double away_rho = to_rho - t * rho, away_y = to_y - t * y;
  return away_rho * away_rho + away_y * away_y;
}

double distance2(const LineEdge& a, const LineEdge& b) {
  if (cross(a, b)) return 0.0;
  return std::min(
      {distance2(a.from, b), distance2(a.to, b), distance2(b.from, a), distance2(b.to, a)});
}

}  // namespace

LineTree::LineTree(const Polygon& line) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (line[i].rho > 0.0 || line[i + 1].rho > 0.0) edges_.push_back({line[i], line[i + 1]});
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    step_of_loop();
    const Box box = box_of(edges_[i]);
    if (i % kLeafEdges == 0)
      boxes.push_back(box);
    else
      boxes.back() = around(boxes.back(), box);
  }
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > 1) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> above;
    for (std::size_t i = 0; i < below.size(); i += 2)
      above.push_back(i + 1 < below.size() ? around(below[i], below[i + 1]) : below[i]);
    levels_.push_back(std::move(above));
  }
}

double LineTree::distance2(const Box& a, const Box& b) {
  const double rho = std::max({0.0, a.rho_low - b.rho_high, b.rho_low - a.rho_high});
  const double y = std::max({0.0, a.y_low - b.y_high, b.y_low - a.y_high});
  return rho * rho + y * y;
}

LineTree::Box LineTree::box_of(const LineEdge& edge) {
  const auto [rho_low, rho_high] = std::minmax(edge.from.rho, edge.to.rho);
  const auto [y_low, y_high] = std::minmax(edge.from.y, edge.to.y);
  return {rho_low, rho_high, y_low, y_high};
}

LineTree::Box LineTree::around(const Box& a, const Box& b) {
  return {std::min(a.rho_low, b.rho_low), std::max(a.rho_high, b.rho_high),
          std::min(a.y_low, b.y_low), std::max(a.y_high, b.y_high)};
}

template <class Visit>
void LineTree::for_each_edge(Node leaf, Visit visit) const {
  const std::size_t begin = leaf.index * kLeafEdges;
  for (std::size_t i = begin; i < std::min(begin + kLeafEdges, edges_.size()); ++i)
    visit(edges_[i]);
}

template <class Visit>
void LineTree::for_each_child(Node node, Visit visit) const {
  const std::size_t first = 2 * node.index;
  visit(Node{node.level - 1, first});
  if (first + 1 < levels_[node.level - 1].size()) visit(Node{node.level - 1, first + 1});
}

void LineTree::descend(Node node, const Box& near, const LineEdge& edge, Search& search) const {
  step_of_loop();
  if (search.done() || distance2(box(node), near) >= search.least2) return;
  if (node.level == 0)
    for_each_edge(node, [&](const LineEdge& mine) {
      search.least2 = std::min(search.least2, solid::distance2(mine, edge));
    });
  else
    for_each_child(node, [&](Node child) { descend(child, near, edge, search); });
}

void LineTree::descend(Node node, const LineTree& other, Node across, Search& search) const {
  step_of_loop();
  if (search.done() || distance2(box(node), other.box(across)) >= search.least2) return;
  if (node.level == 0 && across.level == 0)
    for_each_edge(node, [&](const LineEdge& mine) {
      const Box near = box_of(mine);
      if (distance2(near, other.box(across)) >= search.least2) return;
      other.for_each_edge(across, [&](const LineEdge& theirs) {
        if (distance2(near, box_of(theirs)) < search.least2)
          search.least2 = std::min(search.least2, solid::distance2(mine, theirs));
      });
    });
  else if (node.level >= across.level)
    for_each_child(node, [&](Node child) { descend(child, other, across, search); });
  else
    other.for_each_child(across, [&](Node child) { descend(node, other, child, search); });
}

double LineTree::run(const LineEdge& edge, Search search) const {
  if (!edges_.empty()) descend({levels_.size() - 1, 0}, box_of(edge), edge, search);
  return search.least2;
}

double LineTree::run(const LineTree& other, Search search) const {
  if (!edges_.empty() && !other.edges_.empty())
    descend({levels_.size() - 1, 0}, other, {other.levels_.size() - 1, 0}, search);
  return search.least2;
}

double LineTree::nearest2(const LineEdge& edge, double bound2) const { return run(edge, {bound2}); }

double LineTree::nearest2(const LineTree& other, double bound2) const {
  return run(other, {bound2});
}

bool LineTree::any_nearer2(const LineEdge& edge, double bound2) const {
  return run(edge, {bound2, bound2}) < bound2;
}

bool LineTree::any_nearer2(const LineTree& other, double bound2) const {
  return run(other, {bound2, bound2}) < bound2;
}

}  // namespace clay::solid::inline section
