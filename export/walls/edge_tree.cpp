#include "export/walls/edge_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace clay::solid::inline walls {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAngleRounding = 1e-12;  // [rad]

Vec2 across(const Vec2& along) { return {-along.y, along.x}; }

/// Reduces an angle between -2 pi and 2 pi by whole turns.
double wrapped(double angle) {
  if (angle > kPi) return angle - 2.0 * kPi;
  return angle < -kPi ? angle + 2.0 * kPi : angle;
}

/// Lower bound of the distance from the rectangle of `a` to the bounding rectangle of `b` along its
/// sides.
double least_distance_along(const EdgeNode& a, const EdgeNode& b) noexcept {
  const Vec2 way = b.centre - a.centre;
  const double cosine = std::abs(glm::dot(a.along, b.along));
  const double sine = std::abs(cross(a.along, b.along));
  const double x = std::abs(glm::dot(way, a.along)) - a.half_length - b.half_length * cosine -
                   b.half_width * sine;
  const double y =
      std::abs(cross(a.along, way)) - a.half_width - b.half_length * sine - b.half_width * cosine;
  return std::hypot(std::max(x, 0.0), std::max(y, 0.0));
}

/// The rectangle along `chord` around incrementally added points.
class Rectangle {
 public:
  Rectangle(const Vec2& origin, const Vec2& chord) : origin_(origin) {
    const double length = glm::length(chord);
    along_ = length > 0.0 ? chord / length : Vec2{1.0, 0.0};
  }

  void add(const Vec2& point) {
    const Vec2 way = point - origin_;
    const Vec2 place{glm::dot(way, along_), cross(along_, way)};
    low_ = {std::min(low_.x, place.x), std::min(low_.y, place.y)};
    high_ = {std::max(high_.x, place.x), std::max(high_.y, place.y)};
  }

  void add(const EdgeNode& node) {
    const Vec2 length = node.half_length * node.along;
    const Vec2 width = node.half_width * across(node.along);
    for (const Vec2& corner : {length + width, length - width, width - length, -length - width})
      add(node.centre + corner);
  }

  void give(EdgeNode& node) const {
    const Vec2 middle = 0.5 * (low_ + high_);
    node.along = along_;
    node.centre = origin_ + middle.x * along_ + middle.y * across(along_);
    node.half_length = 0.5 * (high_.x - low_.x);
    node.half_width = 0.5 * (high_.y - low_.y);
  }

 private:
  Vec2 origin_, along_{1.0, 0.0};
  Vec2 low_{0.0}, high_{0.0};  ///< contains the origin
};

/// Tight: normals on one side of a staircase are exactly 90 degrees apart, and so not opposite.
void bound_normals(EdgeNode& node, std::span<const Vec2> normals) {
  if (normals.empty()) return;
  Vec2 middle{0.0};
  for (const Vec2& normal : normals) middle += normal;
  double low = 0.0, high = 0.0;  // angles relative to the middle
  for (const Vec2& normal : normals) {
    const double angle = std::atan2(cross(middle, normal), glm::dot(middle, normal));
    low = std::min(low, angle);
    high = std::max(high, angle);
  }
  if (high > 0.5 * kPi + kAngleRounding || low < -0.5 * kPi - kAngleRounding) {
    node.normal_spread = kPi;
    return;
  }
  node.normal_angle = wrapped(std::atan2(middle.y, middle.x) + 0.5 * (low + high));
  node.normal_spread = 0.5 * (high - low) + kAngleRounding;
}

void join_normals(EdgeNode& node, const EdgeNode& a, const EdgeNode& b) {
  const EdgeNode& known = a.normal_spread >= 0.0 ? a : b;
  node.normal_angle = known.normal_angle;
  node.normal_spread = known.normal_spread;
  if (a.normal_spread < 0.0 || b.normal_spread < 0.0) return;
  const double turn = wrapped(b.normal_angle - a.normal_angle);
  const double low = std::min(-a.normal_spread, turn - b.normal_spread);
  const double high = std::max(a.normal_spread, turn + b.normal_spread);
  node.normal_angle = wrapped(a.normal_angle + 0.5 * (low + high));
  node.normal_spread = std::min(0.5 * (high - low), kPi);
}

}  // namespace

double greatest_turn(const EdgeNode& a, const EdgeNode& b) noexcept {
  if (a.normal_spread < 0.0 || b.normal_spread < 0.0) return -1.0;
  return std::abs(wrapped(a.normal_angle - b.normal_angle)) + a.normal_spread + b.normal_spread;
}

double least_distance(const EdgeNode& a, const EdgeNode& b) noexcept {
  return std::max(least_distance_along(a, b), least_distance_along(b, a));
}

EdgeTree::EdgeTree(const Profile& profile, double rho_scale, double arc_scale)
    : arc_per_rho_(arc_scale / rho_scale) {
  std::size_t count = 0;
  for (const Polygon& polygon : profile.pieces) count += polygon.size();
  points_.reserve(count);
  Vec2 low{0.0}, high{0.0};
  for (const Polygon& polygon : profile.pieces) {
    begins_.push_back(static_cast<std::uint32_t>(points_.size()));
    for (const ProfilePoint& p : polygon) {
      points_.emplace_back(p.rho * rho_scale, p.y);
      low = {0.0, std::min(low.y, p.y)};
      high = {std::max(high.x, points_.back().x), std::max(high.y, p.y)};
    }
  }
  begins_.push_back(static_cast<std::uint32_t>(points_.size()));
  axis_arc_ = 8.0 * (std::max(1.0, arc_per_rho_) * high.x + high.y - low.y);
  std::vector<EdgeNode> leaves;
  make_leaves(leaves);
  nodes_.reserve(2 * leaves.size() - 1);
  add_node(leaves, 0, leaves.size());
}

Edge EdgeTree::edge(std::uint32_t index, std::uint32_t piece) const {
  Edge edge{points_[index], points_[after(index, piece)], {}, index};
  edge.inward = across(glm::normalize(edge.to - edge.from));
  return edge;
}

void EdgeTree::make_leaves(std::vector<EdgeNode>& leaves) {
  leaves.reserve(points_.size() / kLeafEdges + begins_.size());
  for (std::uint32_t piece = 0; piece < piece_count(); ++piece) {
    double arc = 0.0;
    for (std::uint32_t first = begins_[piece]; first < begins_[piece + 1];) {
      step_of_loop();
      const std::uint32_t end =
          std::min(first + static_cast<std::uint32_t>(kLeafEdges), begins_[piece + 1]);
      leaves.push_back(leaf(first, end, piece, arc));
      arc = leaves.back().arc_end;
      first = end;
    }
    perimeters_.push_back(arc);
  }
}

EdgeNode EdgeTree::leaf(std::uint32_t first, std::uint32_t end, std::uint32_t piece,
                        double arc) const {
  EdgeNode node;
  node.first = first, node.end = end;
  node.first_piece = node.last_piece = piece;
  node.arc_begin = arc;
  const std::uint32_t beyond = after(end - 1, piece);
  Rectangle rectangle(points_[first], points_[beyond] - points_[first]);
  std::array<Vec2, 2 * kLeafEdges + 1> normals;
  std::size_t count = 0;
  if (const Edge previous = edge(before(first, piece), piece); !previous.on_axis())
    normals[count++] = previous.inward;
  for (std::uint32_t i = first; i < end; ++i) {
    const Edge e = edge(i, piece);
    rectangle.add(e.to);
    arc += arc_length(e);
    if (e.on_axis()) continue;
    normals[count++] = e.inward;
    if (e.from.x == 0.0 || e.to.x == 0.0) normals[count++] = mirrored(e.inward);
  }
  node.arc_end = arc;
  rectangle.give(node);
  bound_normals(node, {normals.data(), count});
  return node;
}

void EdgeTree::add_node(const std::vector<EdgeNode>& leaves, std::size_t first, std::size_t end) {
  step_of_loop();
  if (end - first == 1) {
    nodes_.push_back(leaves[first]);
    return;
  }
  const std::size_t node = nodes_.size(), middle = first + left_leaves(end - first);
  nodes_.emplace_back();
  nodes_[node].leaves = static_cast<std::uint32_t>(end - first);
  add_node(leaves, first, middle);
  add_node(leaves, middle, end);
  nodes_[node] = joined(nodes_[left(node)], nodes_[right(node)]);
}

EdgeNode EdgeTree::joined(const EdgeNode& a, const EdgeNode& b) const {
  EdgeNode node;
  const Vec2 first = points_[a.first];
  Rectangle rectangle(first, points_[after(b.end - 1, b.last_piece)] - first);
  rectangle.add(a);
  rectangle.add(b);
  rectangle.give(node);
  join_normals(node, a, b);
  node.arc_begin = a.arc_begin, node.arc_end = b.arc_end;
  node.first = a.first, node.end = b.end;
  node.first_piece = a.first_piece, node.last_piece = b.last_piece;
  node.leaves = a.leaves + b.leaves;
  return node;
}

}  // namespace clay::solid::inline walls
