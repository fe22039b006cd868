#include "engine/tick/contact.hpp"

#include "tests/engine/clay/stack_samples.hpp"
#include "tests/engine/tick/contact_samples.hpp"
#include "tests/support/allocation_counter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

namespace clay {
namespace {

Contact contact_of(const Tool& tool, const ClayStack& stack, glm::dvec3 hip) {
  Contact contact;
  contact.rings.reserve(most_contacts(tool, stack.ring_height_mm(), stack.size()));
  const std::size_t allocations = allocation_count();
  find_contact(tool, stack, hip, contact);
  EXPECT_EQ(allocation_count(), allocations);  // a tick must not allocate
  return contact;
}

/// Section 4 of the paper without its first stage: tests every ring.
RC_GTEST_PROP(Contact, TwoStageSearchMatchesTestingEveryRing, ()) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(1, 60);
  const double h = *rc::gen::element(0.1, 1.0, 7.0);
  const ClayStack stack = samples::stack(random, count, h);
  const Tool tool = Tool::build(SphereSpec{1.0 + 30.0 * samples::uniform(random)}).value();
  const double height = stack.height_mm();
  const glm::dvec3 hip(80.0 * samples::uniform(random),
                       height * (2.0 * samples::uniform(random) - 0.5),
                       20.0 * samples::uniform(random));
  const Contact contact = contact_of(tool, stack, hip);

  const double d = std::hypot(hip.x, hip.z);
  const auto at_centre = static_cast<std::size_t>(
      std::min(std::max(std::floor(hip.y / h), 0.0), static_cast<double>(count - 1)));
  const Ring& centre = stack.rings()[at_centre];
  const bool outside = d > (centre.outer_mm() + centre.inner_mm()) / 2;
  const auto rings = samples::touched(contact);
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = (static_cast<double>(i) + 0.5) * h - hip.y;
    if (std::abs(t) > tool.high()) continue;
    // The middle of the covered part of the ring.
    const double covered =
        0.5 * (std::max(t - 0.5 * h, tool.low()) + std::min(t + 0.5 * h, tool.high()));
    const double f = std::sqrt(tool.high() * tool.high() - covered * covered);
    const Ring& ring = stack.rings()[i];
    const double depth = outside ? ring.outer_mm() + f - d : d + f - ring.inner_mm();
    if (depth <= 1e-9) continue;
    RC_ASSERT(found < rings.size());
    RC_ASSERT(rings[found].ring == i);
    RC_ASSERT(std::abs(rings[found].depth_mm - depth) < 1e-7);
    RC_ASSERT(i >= contact.bottom && i <= contact.top);
    ++found;
  }
  RC_ASSERT(found == rings.size());
  if (found > 0) RC_ASSERT((contact.side == Side::compressive) == outside);
}

class ContactOnCylinder : public testing::Test {
 protected:
  ClayStack cup = ClayStack::cylinder(100, 1.0, 50.0, 40.0, 100).value();
  Tool sphere = Tool::build(SphereSpec{10.0}).value();
};

TEST_F(ContactOnCylinder, DemarcatingCircleDecidesTheSide) {
  EXPECT_EQ(contact_of(sphere, cup, {45.001, 50, 0}).side, Side::compressive);
  EXPECT_EQ(contact_of(sphere, cup, {44.999, 50, 0}).side, Side::expansive);
  EXPECT_EQ(contact_of(sphere, cup, {0, 50, -45.001}).side, Side::compressive);
}

/// A floor of 8 mm below a bore of 37 mm radius: the wall's middle is at 41 mm, that of the solid
/// floor at 22.5 mm.
TEST(Contact, ACentreInTheFloorIsOnTheSideOfTheBoreAboveIt) {
  std::vector<Ring> rings(8, {quanta_from_radius(45.0), 0});
  rings.resize(50, {quanta_from_radius(45.0), quanta_from_radius(37.0)});
  const ClayStack stack = ClayStack::from_rings(1.0, rings, 0).value();
  const Tool tool = Tool::build(SphereSpec{10.0}).value();
  Contact contact;
  contact.rings.reserve(most_contacts(tool, 1.0, stack.size()));
  const auto side = [&](double x, double y, HandAt hand) {
    find_contact(tool, stack, {x, y, 0.0}, contact, glm::dvec3(0.0), hand);
    return contact.side;
  };
  for (const double y : {-9.0, 0.0, 5.0, 7.9, 8.1}) {
    EXPECT_EQ(side(40.0, y, HandAt::above), Side::expansive) << y;
    EXPECT_EQ(side(42.0, y, HandAt::above), Side::compressive) << y;
  }
  EXPECT_EQ(side(40.0, 5.0, HandAt::unknown), Side::compressive);
  EXPECT_EQ(side(40.0, 5.0, HandAt::below), Side::compressive);
  EXPECT_EQ(side(22.0, 5.0, HandAt::below), Side::expansive);
}

/// The hand is below: the centre is in the floor above a foot that is hollow.
TEST(Contact, ACentreAboveAHollowFootIsOnItsSideForAHandBelow) {
  std::vector<Ring> rings(4, {quanta_from_radius(45.0), quanta_from_radius(37.0)});
  rings.resize(50, {quanta_from_radius(45.0), 0});
  const ClayStack stack = ClayStack::from_rings(1.0, rings, 0).value();
  const Tool tool = Tool::build(SphereSpec{10.0}).value();
  Contact contact;
  contact.rings.reserve(most_contacts(tool, 1.0, stack.size()));
  const auto side = [&](double y, HandAt hand) {
    find_contact(tool, stack, {40.0, y, 0.0}, contact, glm::dvec3(0.0), hand);
    return contact.side;
  };
  EXPECT_EQ(side(6.0, HandAt::below), Side::expansive);
  EXPECT_EQ(side(6.0, HandAt::above), Side::compressive);
  EXPECT_EQ(side(23.0, HandAt::below), Side::expansive);  // 20 mm above the foot: the tool's height
  EXPECT_EQ(side(24.1, HandAt::below), Side::compressive);  // farther
}

/// A plate of 80 mm radius on a foot of 30 mm radius and 11 mm height. The tool is in the air
/// beside the foot, below the plate, whose bore begins 2 mm higher.
TEST(Contact, ACentreBesideAFootIsOutside) {
  std::vector<Ring> rings(11, {quanta_from_radius(30.0), 0});
  rings.resize(13, {quanta_from_radius(80.0), 0});
  rings.resize(50, {quanta_from_radius(80.0), quanta_from_radius(70.0)});
  const ClayStack stack = ClayStack::from_rings(1.0, rings, 0).value();
  const Tool tool = Tool::build(SphereSpec{5.0}).value();
  Contact contact;
  contact.rings.reserve(most_contacts(tool, 1.0, stack.size()));
  for (const double x : {36.0, 50.0, 69.0}) {
    find_contact(tool, stack, {x, 5.5, 0.0}, contact, glm::dvec3(0.0), HandAt::above);
    EXPECT_TRUE(contact.rings.empty()) << x;
  }
  find_contact(tool, stack, {34.0, 5.5, 0.0}, contact, glm::dvec3(0.0), HandAt::above);
  EXPECT_EQ(contact.side, Side::compressive);
  EXPECT_FALSE(contact.rings.empty());
  find_contact(tool, stack, {29.0, 5.5, 0.0}, contact, glm::dvec3(0.0), HandAt::above);
  EXPECT_EQ(contact.side, Side::expansive);
}

TEST_F(ContactOnCylinder, CandidatesFollowEquationsOneAndTwo) {
  // (1): ceil((50.2 + 10) / 1) = 61st ring, (2): floor((50.2 - 10) / 1) = 40th ring.
  Contact contact;
  find_contact<Model::paper>(sphere, cup, {55, 50.2, 0}, contact);
  EXPECT_EQ(contact.top, 60u);
  EXPECT_EQ(contact.bottom, 39u);
  EXPECT_EQ(contact.edge_count, 0u);
}

TEST_F(ContactOnCylinder, RangeEndsAtTheEndsOfTheTool) {
  const Contact contact = contact_of(sphere, cup, {55, 50.2, 0});
  EXPECT_EQ(contact.top, 60u);     // 60.2
  EXPECT_EQ(contact.bottom, 40u);  // 40.2
  EXPECT_NEAR(contact.up_offset, 0.8 - 0.5, 1e-12);
  EXPECT_NEAR(contact.down_offset, 0.2 - 0.5, 1e-12);
}

TEST_F(ContactOnCylinder, PartlyCoveredRingsGiveForceButDoNotYield) {
  const Tool rib = Tool::build(RibSpec{20.0, 6.0}).value();
  // From 40.3 to 60.3 mm: it covers 0.7 of ring 40, including its middle, and 0.3 of ring 60.
  const Contact contact = contact_of(rib, cup, {54, 50.3, 0});
  const auto rings = samples::touched(contact);
  ASSERT_EQ(rings.size(), 20u);
  EXPECT_EQ(rings.front().ring, 40u);
  EXPECT_NEAR(rings.front().coverage, 0.7, 1e-12);
  ASSERT_EQ(contact.edge_count, 1u);
  EXPECT_EQ(contact.edges[0].ring, 60u);
  EXPECT_NEAR(contact.edges[0].coverage, 0.3, 1e-12);
  double covered = contact.edges[0].coverage;
  for (const RingContact& ring : rings) {
    EXPECT_NEAR(ring.depth_mm, 2.0, 1e-12);
    covered += ring.coverage;
  }
  EXPECT_NEAR(covered, 20.0, 1e-12);  // the rib's height
}

TEST_F(ContactOnCylinder, CrownGivesForce) {
  const Ring ring{quanta_from_radius(50), quanta_from_radius(40)};
  const ClayStack crowned =
      ClayStack::from_rings(1.0, std::vector<Ring>(100, ring), ring.volume() / 4).value();
  const Contact contact = contact_of(Tool::build(RibSpec{20.0, 6.0}).value(), crowned, {54, 95, 0});
  ASSERT_EQ(contact.rings.touched(), 15u);
  ASSERT_EQ(contact.edge_count, 1u);
  EXPECT_NEAR(contact.edges[0].coverage, 0.25, 1e-9);
}

TEST_F(ContactOnCylinder, FindsNoContactAboveBelowOrBeside) {
  for (const glm::dvec3 hip : {glm::dvec3{50, 110.1, 0},
                               {50, -10.1, 0},
                               {60.001, 50, 0},
                               {50, 1e300, 0},
                               {50, -1e300, 0},
                               {0, 50, 0}})
    EXPECT_TRUE(contact_of(sphere, cup, hip).rings.empty()) << hip.x << " " << hip.y;
}

TEST_F(ContactOnCylinder, HasNoDirectionOnTheAxis) {
  const Contact contact = contact_of(Tool::build(SphereSpec{45.0}).value(), cup, {0, 50, 0});
  ASSERT_FALSE(contact.rings.empty());
  EXPECT_EQ(contact.side, Side::expansive);
  EXPECT_EQ(contact.radial_x, 0.0);
  EXPECT_EQ(contact.radial_z, 0.0);
}

TEST_F(ContactOnCylinder, ToolWiderThanThePotTouchesEveryRing) {
  const Tool giant = Tool::build(SphereSpec{500.0}).value();
  EXPECT_EQ(contact_of(giant, cup, {100, 50, 0}).rings.touched(), 100u);
}

}  // namespace
}  // namespace clay
