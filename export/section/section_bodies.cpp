#include "export/section/section_bodies.hpp"

#include "claystack/engine/collapse.hpp"
#include "export/section/stack_section.hpp"

#include <algorithm>
#include <utility>

namespace clay::solid::inline section {
namespace {

/// Joins a line right of the axis and its mirror image into one outline.
Outline mirrored(const Polygon& line) {
  Outline outline;
  for (const ProfilePoint& p : line) outline.emplace_back(p.rho, p.y);
  for (auto p = line.rbegin(); p != line.rend(); ++p) outline.emplace_back(-p->rho, p->y);
  return outline;
}

/// Lines that end on the axis are joined with their mirror images, so that no seam shows there.
void add_cut(SectionBody& body, const Polygon& section) {
  for (const Chain& chain : chains_of(section)) {
    Polygon line;
    for (std::size_t i = 0; i <= chain.edges; ++i)
      line.push_back(section[(chain.first + i) % section.size()]);
    if (!chain.round) {
      body.cut.push_back(mirrored(line));
      continue;
    }
    for (const double side : {1.0, -1.0}) {
      Outline& outline = body.cut.emplace_back();
      for (const ProfilePoint& p : line) outline.emplace_back(side * p.rho, p.y);
    }
  }
}

SectionBody body_of(const ClayStack& stack, RingRange rings) {
  SectionBody body;
  for (const RingRange piece : pieces_of(stack, rings)) {
    add_cut(body, section_of(stack, piece));
    body.beyond.push_back(mirrored(outer_wall_of(stack, piece)));
  }
  body.axis = {{0.0, level_mm(stack, rings.first)}, {0.0, level_mm(stack, rings.last + 1)}};
  return body;
}

SectionBody crown_of(const ClayStack& stack) {
  const Polygon section = crown_section_of(stack);
  SectionBody body;
  add_cut(body, section);
  body.beyond.push_back(mirrored({section[0], section[1]}));
  body.axis = {{0.0, section[0].y}, {0.0, section[1].y}};
  return body;
}

/// The standing part, without the crown.
SectionBody standing(const ClayStack& stack, std::size_t failed) {
  const auto end = stack.rings().begin() + static_cast<std::ptrdiff_t>(failed) + 1;
  return ClayStack::from_rings(stack.ring_height_mm(), {stack.rings().begin(), end}, 0)
      .map([&](const ClayStack& lower) {
        return body_of(lower, {0, failed});
      })
      .value_or(SectionBody{});
}

/// The view along the axis of rotation of the collapse, with the HIP to the right.
class FallView {
 public:
  explicit FallView(const Collapse& collapse)
      : right_(collapse.axis.z, 0.0, -collapse.axis.x), place_(collapse) {}

  void move(Outline& outline) const {
    for (glm::dvec2& p : outline) {
      const glm::dvec3 there = place_({p.x * right_.x, p.y, p.x * right_.z});
      p = {there.x * right_.x + there.z * right_.z, there.y};
    }
  }

 private:
  glm::dvec3 right_;
  FallenPlace place_;
};

/// Before the collapse; empty if no clay was above the failed ring.
std::vector<SectionBody> upper_part(const Pot& pot) {
  const std::size_t first = pot.collapse->failed_ring + 1;
  if (first < pot.stack.size()) return {body_of(pot.stack, {first, pot.stack.size() - 1})};
  if (pot.stack.crown() > 0) return {crown_of(pot.stack)};
  return {};
}

}  // namespace

std::vector<SectionBody> bodies_of(const Pot& pot) {
  const std::size_t rings = pot.stack.size();
  if (rings == 0) return {};
  if (!pot.collapse || pot.collapse->failed_ring >= rings)
    return {body_of(pot.stack, {0, rings - 1})};
  std::vector<SectionBody> bodies{standing(pot.stack, pot.collapse->failed_ring)};
  const FallView view(*pot.collapse);
  for (SectionBody& body : upper_part(pot)) {
    for (Outline& outline : body.cut) view.move(outline);
    for (Outline& outline : body.beyond) view.move(outline);
    view.move(body.axis);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

std::vector<Outline> ghosts_of(const Pot& pot) {
  const std::vector<FallFrame> frames = fall_frames(pot);
  std::vector<Outline> ghosts;
  if (frames.size() < 2) return ghosts;
  const double start = frames.front().potential_mj, end = frames.back().potential_mj;
  for (const double part : {0.0, 0.25, 0.5, 0.75}) {
    const auto frame = std::ranges::find_if(
        frames, [&](const FallFrame& f) { return f.potential_mj <= start + part * (end - start); });
    Collapse then = *pot.collapse;
    then.angle_rad = frame->angle_rad;
    then.shift_mm = frame->shift_mm;
    const FallView view(then);
    for (const SectionBody& body : upper_part(pot))
      for (Outline outline : body.beyond) {
        view.move(outline);
        ghosts.push_back(std::move(outline));
      }
  }
  return ghosts;
}

}  // namespace clay::solid::inline section
