// Normals of the surface between levels, compared with those of the shape that the rows sample.

#include "app/render/section.hpp"
#include "tests/app/render/drawn.hpp"

#include <glm/geometric.hpp>

namespace clay::test {
namespace {

/// The largest angle [rad] between the normals of two stretches of a wall that follow each other
/// where `on_wall` holds.
double widest_edge(const render::PotView& pot, const std::function<bool(glm::vec2)>& on_wall) {
  const auto levels = render::levels_of(pot, 0, pot.rows.size(), 0.01F);
  const auto meridian = render::meridian_of(levels, false);
  double widest = 0.0;
  for (std::size_t i = 1; i < meridian.size(); ++i) {
    const render::Stretch &before = meridian[i - 1], &after = meridian[i];
    if (!on_wall(before.from) || !on_wall(after.from) || !on_wall(after.to)) continue;
    const double cosine = static_cast<double>(glm::dot(before.to_normal, after.from_normal));
    widest = std::max(widest, std::acos(std::clamp(cosine, -1.0, 1.0)));
  }
  return widest;
}

TEST(Meridian, ShadesARoundedLipWithoutAnEdge) {
  // Half a torus of 4 mm on a tube: towards the top, the wall turns from upright to level.
  constexpr double kTube = 46.0, kRound = 4.0, kRow = 0.2;
  render::PotView pot;
  pot.height_mm = 60.0;
  for (double y = 0.5 * kRow; y < pot.height_mm; y += kRow) {
    const double up = std::max(0.0, y - (pot.height_mm - kRound));
    const double half = std::sqrt(kRound * kRound - up * up);
    pot.rows.push_back({static_cast<float>(kTube + half), static_cast<float>(kTube - half)});
  }
  const auto above = [](float y) { return y > 30.0F; };
  EXPECT_LT(widest_edge(pot, [&](glm::vec2 at) { return above(at.y) && at.x > 46.0F; }), 0.6);
  EXPECT_LT(widest_edge(pot, [&](glm::vec2 at) { return above(at.y) && at.x < 46.0F; }), 0.6);
}

TEST(Meridian, KeepsTheEdgeOfAFlange) {
  render::PotView pot = pot_of([](double part) { return part < 0.5 ? 30.0 : 60.0; }, 100.0);
  // A step of 30 mm within a row of 0.5 mm: upright wall, floor of the flange, upright wall.
  EXPECT_GT(widest_edge(pot, [](glm::vec2 at) { return at.y > 10.0F && at.y < 90.0F; }), 1.0);
}

}  // namespace
}  // namespace clay::test
