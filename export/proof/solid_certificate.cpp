#include "claystack/export/proof.hpp"

#include "claystack/export/solid.hpp"
#include "claystack/export/walls.hpp"
#include "core/compensated_sum.hpp"
#include "core/content_hash.hpp"
#include "core/portable_trig.hpp"
#include "export/proof/describe.hpp"
#include "export/proof/inspect_mesh.hpp"
#include "export/proof/revolve_match.hpp"
#include "export/proof/rounded_claims.hpp"
#include "export/solid/revolve_layout.hpp"
#include "export/walls/clearance.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>
#include <new>
#include <numbers>

namespace clay::solid::inline proof {
namespace {

constexpr std::size_t kFewestSegmentsWithMargins = 8;

ContentHash hash_of_profile(const Profile& profile) {
  ContentHasher hasher;
  const auto add = [&](std::uint64_t bits) {
    std::array<std::byte, 8> bytes;
    for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<std::byte>(bits >> (8 * i));
    hasher.add(bytes);
  };
  for (const Polygon& polygon : profile.pieces) {
    add(polygon.size());
    for (const ProfilePoint& p : polygon) {
      add(std::bit_cast<std::uint64_t>(p.rho));
      add(std::bit_cast<std::uint64_t>(p.y));
    }
  }
  return hasher.digest();
}

/// If every vertex moves by at most `rounding` along a straight line, the volume changes at a rate
/// of at most `rounding` times the area; an area |u x v| / 2 grows by at most rounding (|u| + |v|)
/// + 2 rounding^2, because each edge grows by at most twice the rounding.
double volume_bound(const RevolveLayout& rule, double rounding) {
  const auto n = static_cast<double>(rule.segments());
  const double chord_per_radius =
      2.0 * equal_area_factor(rule.segments()) * cos_sin(std::numbers::pi / n).sine;
  CompensatedSum area;
  for (const Shell& shell : rule.shells())
    for (const auto& [from, to] : shell.bands) {
      const ProfilePoint &p = shell.points[from], &q = shell.points[to];
      const double a = chord_per_radius * p.rho, b = chord_per_radius * q.rho;
      const double slant = length_of(q.rho - p.rho, q.y - p.y) + 0.5 * std::abs(a - b);
      const double edges = a + b + 2.0 * (slant + std::min(a, b));
      area.add(n * (0.5 * (a + b) * slant + rounding * (edges + 4.0 * rounding)));
    }
  return rounding * area.value();
}

/// The smallest factor by which sections of an n-gon revolve scale rho, in the middle of its
/// facets; at their sides the factor is the equal-volume factor.
double scale_at_facets(std::size_t segments) {
  return std::min(1.0, equal_area_factor(segments) *
                           cos_sin(std::numbers::pi / static_cast<double>(segments)).cosine);
}

tl::unexpected<Error> wrong(std::string_view file, std::string_view claim,
                            const std::string& stated, const std::string& found) {
  return failure(ErrorKind::unsound, std::string(file)
                                         .append(": ")
                                         .append(claim)
                                         .append(": the certificate states ")
                                         .append(stated)
                                         .append(", found ")
                                         .append(found));
}

Result<void> same_number(std::string_view file, std::string_view claim, double stated, double found,
                         double slack = 0.0) {
  // The libm of another compiler may differ in the last bits.
  if (std::abs(stated - found) <= 1e-9 * std::abs(found) + slack) return {};
  return wrong(file, claim, nine_digit_text(stated), nine_digit_text(found));
}

/// Permitted difference of a profile's volume [mm^3] from the counted clay: two walls by pi H
/// step^2 each where steps below 2^-19 of the reach are levelled, and one or two ulp of the full
/// cylinder, which matters for very thin walls.
double counting_slack(const Profile& profile) {
  double radius = 0.0, low = 0.0, high = 0.0;
  for (const Polygon& polygon : profile.pieces)
    for (const ProfilePoint& p : polygon) {
      radius = std::max(radius, p.rho);
      low = std::min(low, p.y);
      high = std::max(high, p.y);
    }
  const double step = std::ldexp(length_of(radius, high - low), -19);
  return std::numbers::pi * (high - low) * (2.0 * step * step + std::ldexp(radius * radius, -50));
}

/// The checks that are as cheap as reading the bytes.
Result<void> same_bytes(const SolidCertificate& stated, std::string_view bytes,
                        std::string_view file) {
  if (stated.bytes != bytes.size())
    return wrong(file, "size", std::to_string(stated.bytes) + " bytes",
                 std::to_string(bytes.size()));
  if (const ContentHash hash = hash_of(std::as_bytes(std::span(bytes)));
      hash != stated.content_hash)
    return wrong(file, "content hash", stated.content_hash, hash);
  if (const ContentHash hash = hash_of_profile(stated.profile); hash != stated.profile_hash)
    return wrong(file, "profile hash", stated.profile_hash, hash);
  return {};
}

/// Checked before the profile is processed: afterwards that is no larger than the file.
Result<void> same_count(const SolidCertificate& stated, const TriangleMesh& decoded,
                        std::string_view file) {
  const std::size_t triangles = triangle_count(stated.profile, stated.segments);
  if (decoded.triangles.size() == triangles) return {};
  return wrong(file, "profile and segments", std::to_string(triangles) + " triangles",
               std::to_string(decoded.triangles.size()));
}

/// Returns the margins for the proof.
Result<Margins> same_claims(const SolidCertificate& stated, std::string_view file) {
  const SolidCertificate found = claims_of(stated.profile, stated.segments, stated.rounding_mm);
  const auto same = [&](std::string_view claim, double SolidCertificate::*member) {
    return same_number(file, claim, stated.*member, found.*member);
  };
  return same_number(file, "clearance", stated.margins.clearance_mm, found.margins.clearance_mm)
      .and_then([&] {
        return same_number(file, "chord", stated.margins.chord_mm, found.margins.chord_mm);
      })
      .and_then([&] { return same("minimum wall", &SolidCertificate::wall_lower_mm); })
      .and_then([&] { return same("wall's upper bound", &SolidCertificate::wall_upper_mm); })
      .and_then([&] { return same("volume", &SolidCertificate::volume_mm3); })
      .and_then([&] { return same("volume bound", &SolidCertificate::volume_bound_mm3); })
      .and_then([&] {
        return same_number(file, "counted volume", stated.counted_volume_mm3, found.volume_mm3,
                           counting_slack(stated.profile));
      })
      .map([&] { return found.margins; });
}

Result<void> same_solid(const SolidCertificate& stated, const Margins& margins,
                        const TriangleMesh& decoded, MeshFormat format, std::string_view file) {
  const RevolveLayout rule(stated.profile, stated.segments);
  if (const auto matched = match_revolve(decoded, rule, stated.rounding_mm, format, file); !matched)
    return tl::make_unexpected(matched.error());
  if (stated.proof == Proof::margins) {
    const double safe = margins.safe_rounding_mm();
    if (stated.rounding_mm < safe) return {};
    return wrong(file, "proof",
                 "that margins cover the rounding of " + nine_digit_text(stated.rounding_mm),
                 "that they cover less than " + nine_digit_text(safe) + " mm");
  }
  const MeshReport report = inspect_mesh(decoded);
  if (report.sound()) return {};
  return wrong(file, "proof", "a sound mesh", describe(report.problems.front()));
}

Result<void> same_mesh(const SolidCertificate& stated, const TriangleMesh& decoded,
                       MeshFormat format, std::string_view file) {
  return same_count(stated, decoded, file)
      .and_then([&] { return certify(stated.profile); })
      .and_then([&](const PlanarCertificate&) { return same_claims(stated, file); })
      .and_then([&](const Margins& margins) {
        return same_solid(stated, margins, decoded, format, file);
      });
}

}  // namespace

double Margins::safe_rounding_mm() const noexcept {
  return segments < kFewestSegmentsWithMargins ? 0.0 : std::min(clearance_mm, chord_mm) / 8.0;
}

Margins margins_of(const Profile& profile, std::size_t segments) {
  const Clearance found = clearance(profile, scale_at_facets(segments));
  return {
      found.distance_mm,
      found.least_radius_mm * cos_sin(2.0 * std::numbers::pi / static_cast<double>(segments)).sine,
      segments};
}

SolidCertificate claims_of(const Profile& profile, std::size_t segments, double rounding_mm) {
  const double at_facets = scale_at_facets(segments);
  const WallBounds wall = wall_bounds(profile, at_facets, equal_area_factor(segments));
  SolidCertificate claims;
  claims.profile = profile;
  claims.profile_hash = hash_of_profile(profile);
  claims.segments = segments;
  claims.margins = margins_of(profile, segments);
  claims.wall_lower_mm = wall.lower_mm;
  claims.wall_upper_mm = wall.upper_mm;
  claims.volume_mm3 = volume_of(profile);
  claims.counted_volume_mm3 = claims.volume_mm3;
  return with_rounding(std::move(claims), RevolveLayout(profile, segments), rounding_mm);
}

SolidCertificate with_rounding(SolidCertificate claims, const RevolveLayout& rule,
                               double rounding_mm) {
  claims.rounding_mm = rounding_mm;
  claims.wall_lower_mm = std::max(0.0, claims.wall_lower_mm - 2.0 * rounding_mm);
  claims.wall_upper_mm += 2.0 * rounding_mm;
  claims.volume_bound_mm3 = volume_bound(rule, rounding_mm);
  return claims;
}

Result<void> verify_certificate(const SolidCertificate& certificate, std::string_view file_bytes,
                                std::string_view file_name) try {
  const auto format = mesh_format_named(certificate.format);
  if (!format)
    return failure(ErrorKind::bad_input, std::string(file_name) + ": " + format.error().message);
  if (certificate.segments < kMinSegments || certificate.segments > kMaxSegments ||
      !(certificate.rounding_mm >= 0.0))
    return failure(ErrorKind::bad_input, std::string(file_name) + ": expected a certificate with " +
                                             std::to_string(kMinSegments) + " to " +
                                             std::to_string(kMaxSegments) +
                                             " segments and a rounding of 0 mm or more");
  return same_bytes(certificate, file_bytes, file_name)
      .and_then([&] { return decode_mesh(file_bytes, *format, file_name); })
      .and_then([&](const TriangleMesh& decoded) {
        return same_mesh(certificate, decoded, *format, file_name);
      });
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::io,
                 std::string(file_name) + ": verification stopped: not enough memory");
} catch (const std::exception& e) {
  return failure(ErrorKind::io, std::string(file_name) + ": verification failed: " + e.what());
}

}  // namespace clay::solid::inline proof
