#include "claystack/export/proof.hpp"

#include "claystack/export/job.hpp"
#include "tests/export/job/exported.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace clay::solid {
namespace {

struct CertifiedExport {
  SolidCertificate certificate;
  std::string file;
};

CertifiedExport certified(const ClayStack& stack, MeshFormat format,
                          const ExportOptions& options = {}) {
  MemoryStore store;
  const auto report = run_export(shapes::pot_of(stack), {{format, &store}}, options);
  EXPECT_TRUE(report) << report.error().message;
  return {report->files.at(0).certificate.value(), store.bytes()};
}

::testing::AssertionResult refused(const SolidCertificate& certificate, const std::string& file,
                                   const std::string& because) {
  const auto verdict = verify_certificate(certificate, file, "pot.stl");
  if (verdict) return ::testing::AssertionFailure() << "was accepted";
  if (verdict.error().message.find(because) == std::string::npos)
    return ::testing::AssertionFailure() << verdict.error().message;
  return ::testing::AssertionSuccess();
}

TEST(SolidCertificate, HoldsForEveryFormat) {
  for (const MeshFormat format : samples::every_format()) {
    const CertifiedExport pot = certified(shapes::vase(60), format);
    EXPECT_EQ(pot.certificate.format, name_of(format));
    const auto verdict = verify_certificate(pot.certificate, pot.file, "pot");
    EXPECT_TRUE(verdict) << verdict.error().message;
    const auto again = parse_certificate(write_certificate(pot.certificate), "c");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, pot.certificate);
  }
}

TEST(SolidCertificate, ReportsEveryFalseClaim) {
  const auto [good, file] = certified(shapes::vase(60), MeshFormat::stl_binary);
  const auto expect = [&, &sound = good, &bytes = file](auto change, const std::string& says) {
    SolidCertificate lie = sound;
    change(lie);
    EXPECT_TRUE(refused(lie, bytes, says));
  };
  expect([](auto& c) { c.bytes += 1; }, "size");
  expect([](auto& c) { c.content_hash[5] ^= 1; }, "content hash");
  expect([](auto& c) { c.profile_hash[5] ^= 1; }, "profile hash");
  expect([](auto& c) { c.profile.pieces[0][9].rho += 1e-3; }, "profile hash");
  expect([](auto& c) { c.wall_lower_mm += 1e-6; }, "minimum wall");
  expect([](auto& c) { c.wall_upper_mm -= 1e-6; }, "wall's upper bound");
  expect([](auto& c) { c.volume_mm3 *= 1.00001; }, "volume");
  expect([](auto& c) { c.volume_bound_mm3 *= 0.5; }, "volume bound");
  expect([](auto& c) { c.counted_volume_mm3 *= 1.00001; }, "counted volume");
  expect([](auto& c) { c.margins.clearance_mm *= 2.0; }, "clearance");
  expect([](auto& c) { c.margins.chord_mm *= 2.0; }, "chord");
  expect([](auto& c) { c.format = "ply"; }, "expected a PLY file, found an STL mesh");
  expect([](auto& c) { c.segments = 2; }, "segments");
}

TEST(SolidCertificate, DetectsConsistentClaimsThatDoNotMatchTheFile) {
  const auto [good, file] = certified(shapes::vase(60), MeshFormat::stl_binary);
  const auto with_claims_of = [&, &sound = good](const SolidCertificate& claims) {
    SolidCertificate lie = claims;
    lie.format = sound.format;
    lie.bytes = sound.bytes;
    lie.content_hash = sound.content_hash;
    return lie;
  };
  EXPECT_TRUE(refused(with_claims_of(claims_of(good.profile, good.segments + 4, good.rounding_mm)),
                      file, "triangles, found"));
  EXPECT_TRUE(refused(with_claims_of(claims_of(good.profile, good.segments, 1e-9)), file,
                      "expected a vertex of the solid within"));
  Profile other = good.profile;
  for (ProfilePoint& p : other.pieces[0]) p.y *= 1.001;
  EXPECT_TRUE(
      refused(with_claims_of(claims_of(other, good.segments, good.rounding_mm)), file, "vertex"));
}

TEST(SolidCertificate, RefusesMarginsThatDoNotCoverTheRounding) {
  // Walls of 6e-6 mm: float32 separates them, but without a margin.
  ExportOptions options;
  options.smoothing = Smoothing::none;
  auto [certificate, file] =
      certified(shapes::stack_of(5.0, {{20.0, 20.0 - 6e-6}}), MeshFormat::stl_binary, options);
  EXPECT_EQ(certificate.proof, Proof::exact_test);
  EXPECT_TRUE(verify_certificate(certificate, file, "pot"));
  certificate.proof = Proof::margins;
  EXPECT_TRUE(refused(certificate, file, "proof"));
}

TEST(SolidCertificate, RefusesTheCertificateOfAnotherPot) {
  const auto vase = certified(shapes::vase(60), MeshFormat::stl_binary);
  const auto cup = certified(shapes::stack_of(5, {{30, 0}, {30, 26}}), MeshFormat::stl_binary);
  EXPECT_TRUE(refused(vase.certificate, cup.file, "size"));
}

TEST(SolidCertificate, DetectsEveryEditedByte) {
  ExportOptions options;
  options.segments = 8;
  const auto [certificate, file] =
      certified(shapes::stack_of(5, {{30, 0}, {30, 26}}), MeshFormat::stl_binary, options);
  for (std::size_t i = 0; i < file.size(); ++i) {
    std::string edited = file;
    edited[i] ^= 4;
    EXPECT_TRUE(refused(certificate, edited, "content hash"));
  }
}

TEST(SolidCertificate, ErrorsNameTheField) {
  const std::string good =
      write_certificate(certified(shapes::vase(60), MeshFormat::obj).certificate);
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& says) {
    std::string bad = good;
    ASSERT_NE(bad.find(from), std::string::npos) << from;
    bad.replace(bad.find(from), from.size(), to);
    const auto parsed = parse_certificate(bad, "c.json");
    ASSERT_FALSE(parsed) << from;
    EXPECT_EQ(parsed.error().message.find("c.json: "), 0u);
    EXPECT_NE(parsed.error().message.find(says), std::string::npos) << parsed.error().message;
  };
  expect("\"segments\"", "\"segment\"", "segment: unknown field");
  expect("certificate-1", "certificate-2", "schema: expected claystack-certificate-1");
  expect("\"margins\"", "\"hope\"", "proof: expected margins");
  expect("\"format\": \"obj\"", "\"format\": 7", "format: expected text");
  expect("[[[", "[[[7,", "profile_mm");
  expect("{", "", "expected a JSON object");
}

TEST(Margins, ScaleWithTheProfile) {
  // A cup whose floor, wall and lip are all 4 mm: the clearance is the minimum distance between a
  // vertex and an edge not incident to it.
  const Profile cup = profile_of(shapes::stack_of(4.0, {{30, 0}, {30, 26}}))->profile;
  const Margins margins = margins_of(cup, 100);
  const double factor =
      std::sqrt(2.0 * std::numbers::pi / 100 / std::sin(2.0 * std::numbers::pi / 100));
  const double at_facets = factor * std::cos(std::numbers::pi / 100);
  EXPECT_NEAR(margins.clearance_mm, 4.0 * at_facets, 1e-9);
  EXPECT_NEAR(margins.chord_mm, 26.0 * at_facets * std::sin(2.0 * std::numbers::pi / 100), 1e-9);
  EXPECT_DOUBLE_EQ(margins.safe_rounding_mm(), margins.chord_mm / 8.0);
  EXPECT_EQ(margins_of(cup, 7).safe_rounding_mm(), 0.0);
}

TEST(ClaimsOf, VolumeBoundEqualsAreaTimesRounding) {
  // For a small rounding the bound is the surface times it; a cylinder's is 2 pi R (R + H).
  const double r = 20.0, h = 30.0, rounding = 1e-7;
  const Profile cylinder{{{{r, 0}, {r, h}, {0, h}, {0, 0}}}};
  const double area = 2.0 * std::numbers::pi * r * (r + h);
  EXPECT_NEAR(claims_of(cylinder, 2000, rounding).volume_bound_mm3, area * rounding,
              1e-3 * area * rounding);
}

struct KnownPot {
  const char* name;
  Profile profile;
  double wall_mm;  ///< at its thinnest, by formula
};

/// A closed section from an outer and an inner curve of `n` steps, both from foot to rim.
template <class Outer, class Inner>
Polygon between(Outer outer, Inner inner, int n) {
  Polygon section;
  for (int i = 0; i <= n; ++i) section.push_back(outer(static_cast<double>(i) / n));
  for (int i = n; i >= 0; --i) section.push_back(inner(static_cast<double>(i) / n));
  return section;
}

std::vector<KnownPot> known_pots() {
  constexpr double kPi = std::numbers::pi;
  const auto arc = [](double radius, double angle) {
    return ProfilePoint{30.0 + radius * std::cos(angle), 40.0 + radius * std::sin(angle)};
  };
  std::vector<KnownPot> pots;
  pots.push_back(
      {"cylinder cup", {{{{30, 0}, {30, 50}, {26.5, 50}, {26.5, 5}, {0, 5}, {0, 0}}}}, 3.5});
  // A radial wall of 4 mm inclined by atan(1/2).
  pots.push_back({"cone", {{{{30, 0}, {60, 60}, {56, 60}, {26, 0}}}}, 4.0 * 2.0 / std::sqrt(5.0)});
  // From 30 to 150 degrees of latitude, so that the rims are cut along radii.
  const auto shell = [&](double radius) {
    return [=](double t) {
      const double angle = kPi * (1.0 / 6 + t * 2.0 / 3);
      return ProfilePoint{radius * std::sin(angle), 60.0 - radius * std::cos(angle)};
    };
  };
  pots.push_back({"sphere shell", {{between(shell(50.0), shell(47.0), 4000)}}, 3.0});
  Polygon ring;
  for (int i = 0; i < 4000; ++i) ring.push_back(arc(6.0, 2.0 * kPi * i / 4000));
  pots.push_back({"torus ring", {{ring}}, 12.0});
  return pots;
}

TEST(ClaimsOf, WallBoundsContainTheKnownWallWithinTheTolerance) {
  constexpr double kTolerance = 0.02;
  for (const KnownPot& pot : known_pots()) {
    ASSERT_TRUE(certify(pot.profile)) << pot.name;
    const std::size_t segments = segments_for(66.0, kTolerance);
    const double rounding = std::ldexp(120.0, -24);
    const SolidCertificate claims = claims_of(pot.profile, segments, rounding);
    EXPECT_LE(claims.wall_lower_mm, pot.wall_mm) << pot.name;
    EXPECT_GE(claims.wall_upper_mm, pot.wall_mm) << pot.name;
    EXPECT_LT(claims.wall_upper_mm - claims.wall_lower_mm, kTolerance) << pot.name;
  }
}

/// Random stacks with walls and ring heights down to the rounding unit of float32.
ClayStack thin_stack(std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<shapes::Radii> radii;
  const int count = 1 + static_cast<int>(random() % 7);
  const double thinnest = uniform(-23.0, 0.0);
  for (int i = 0; i < count; ++i) {
    const double outer = uniform(20.0, 74.0);
    radii.push_back({outer, outer - 0.5 * outer * std::exp2(uniform(thinnest, 0.0))});
    // A ring that overlaps the last one by the smallest amount that float32 resolves.
    if (i > 0 && random() % 2 == 0)
      radii.back() = {radii[radii.size() - 2].inner_mm * (1.0 + std::exp2(uniform(-24.0, -4.0))),
                      5.0};
  }
  return shapes::stack_of(std::exp2(uniform(-9.0, 3.0)), radii);
}

/// CGAL's exact test on the decoded bytes accepts every solid that the certificate accepts; so does
/// the verification of the certificate.
TEST(SolidCertificate, IsNeverWrong) {
  std::mt19937_64 random(20);
  int by_margins = 0, by_test = 0, refused = 0;
  for (int k = 0; k < 2500; ++k) {
    ExportOptions options;
    options.smoothing = random() % 2 ? Smoothing::none : Smoothing::fair;
    options.allow_pieces = true;
    options.segments = 3 + random() % 22;
    const MeshFormat format = random() % 2 ? MeshFormat::stl_binary : MeshFormat::obj;
    MemoryStore store;
    const auto report = run_export(shapes::pot_of(thin_stack(random)), {{format, &store}}, options);
    if (!report) {
      ++refused;
      continue;
    }
    const SolidCertificate& certificate = report->files[0].certificate.value();
    ++(certificate.proof == Proof::margins ? by_margins : by_test);
    const auto decoded = decode_mesh(store.bytes(), format, "pot");
    ASSERT_TRUE(decoded);
    const MeshReport check = check_mesh(*decoded).value();
    ASSERT_TRUE(check.sound()) << k << check.problems.front().what;
    ASSERT_NEAR(check.volume_mm3, report->volume.solid_mm3, certificate.volume_bound_mm3) << k;
    const auto verdict = verify_certificate(certificate, store.bytes(), "pot");
    ASSERT_TRUE(verdict) << k << verdict.error().message;
  }
  // All three outcomes occur often.
  EXPECT_GT(by_margins, 500);
  EXPECT_GT(by_test, 100);
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace clay::solid
