#include "claystack/export/proof.hpp"

#include "claystack/export/solid.hpp"
#include "claystack/version.hpp"
#include "core/text.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/proof/certificate_json.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace clay::solid::inline proof {
namespace {

constexpr const char* kSchema = "claystack-certificate-1";
constexpr std::string_view kClaim =
    "closed and embedded, of the volume and no thinner than stated, as the file's bytes say";
// Coordinates are within 1e6 mm, so no length between them is as long, no volume as large.
constexpr Range kLengthMm = from(0.0).to(1e7), kWallMm = from(-1e7).to(1e7),
                kVolumeMm3 = from(0.0).to(1e20);
constexpr std::size_t kMaxProfilePoints = kMaxTriangles / kMinSegments;

Json profile_json(const Profile& profile) {
  Json pieces = Json::array();
  for (const Polygon& polygon : profile.pieces) {
    Json points = Json::array();
    for (const ProfilePoint& p : polygon) points.push_back({p.rho, p.y});
    pieces.push_back(std::move(points));
  }
  return pieces;
}

/// Takes the points from the parser one by one, because its own structures need six times the
/// memory. Stops at an invalid profile, so that no file costs more than its points.
class ProfileReader {
 public:
  explicit ProfileReader(Profile& profile) : profile_(profile) {}

  bool operator()(int depth, Json::parse_event_t event, const Json& value) {
    using Event = Json::parse_event_t;
    limits_(depth, event, value);
    if (depth > 0 && event == Event::object_start)
      throw BadField("expected numbers, text and arrays of points, found an object");
    if (event == Event::value) return add_number(depth, value);
    if (event == Event::array_start && depth == kPieceDepth) profile_.pieces.emplace_back();
    if (event != Event::array_end || depth < kPieceDepth) return true;
    depth == kPointDepth ? end_point() : end_piece();
    return false;
  }

 private:
  static constexpr int kPieceDepth = 2, kPointDepth = 3, kNumberDepth = 4;

  bool add_number(int depth, const Json& value) {
    if (depth < kPieceDepth) return true;
    if (depth != kNumberDepth || !value.is_number() || count_ == 2)
      throw BadField("profile_mm: expected points [rho, y], found " +
                     (count_ == 2 ? "a third number, " : std::string()) + shown(value));
    point_[count_] = value.get<double>();
    if (std::abs(point_[count_++]) > kMaxCoordinateMm)
      throw BadField(std::string("profile_mm: expected ").append(kCoordinateRule) + ", found " +
                     shown(value));
    return false;
  }

  void end_point() {
    if (std::exchange(count_, 0) != 2)
      throw BadField("profile_mm: expected points [rho, y], found one of fewer numbers");
    if (++points_ > kMaxProfilePoints)
      throw BadField("profile_mm: expected at most " + std::to_string(kMaxProfilePoints) +
                     " points, found more");
    profile_.pieces.back().push_back({point_[0], point_[1]});
  }

  void end_piece() const {
    if (const std::size_t found = profile_.pieces.back().size(); found < 3)
      throw BadField("profile_mm: expected pieces of 3 points or more, found one of " +
                     std::to_string(found));
  }

  JsonLimits limits_{kNumberDepth, kSchema};
  Profile& profile_;
  std::array<double, 2> point_{};
  std::size_t count_ = 0;  ///< numbers of the current point
  std::size_t points_ = 0;
};

Proof proof_from(const Json& json) {
  const std::string name = text_in(json, "proof");
  if (name == "margins") return Proof::margins;
  if (name == "exact_test") return Proof::exact_test;
  throw BadField("proof: expected margins or exact_test, found " + shown(name));
}

/// Reads everything except the profile.
SolidCertificate from_json(const Json& json) {
  expect_schema(json, kSchema);
  expect_only(json, {"schema", "written_by", "claim", "format", "bytes", "content_hash",
                     "profile_hash", "proof", "segments", "rounding_mm", "clearance_mm", "chord_mm",
                     "wall_lower_mm", "wall_upper_mm", "volume_mm3", "volume_bound_mm3",
                     "counted_volume_mm3", "profile_mm"});
  (void)text_in(json, "written_by");
  if (text_in(json, "claim") != kClaim)
    throw BadField(std::string("claim: expected \"").append(kClaim) +
                   "\", which is all that is proved");
  (void)array_in(json, "profile_mm");
  SolidCertificate c;
  c.format = text_in(json, "format");
  c.bytes = count_in(json, "bytes");
  c.content_hash = text_in(json, "content_hash");
  c.profile_hash = text_in(json, "profile_hash");
  c.proof = proof_from(json);
  c.segments = count_in(json, "segments");
  c.rounding_mm = number_in(json, "rounding_mm", kLengthMm);
  c.margins = {number_in(json, "clearance_mm", kLengthMm), number_in(json, "chord_mm", kLengthMm),
               c.segments};
  c.wall_lower_mm = number_in(json, "wall_lower_mm", kWallMm);
  c.wall_upper_mm = number_in(json, "wall_upper_mm", kWallMm);
  c.volume_mm3 = number_in(json, "volume_mm3", kVolumeMm3);
  c.volume_bound_mm3 = number_in(json, "volume_bound_mm3", kVolumeMm3);
  c.counted_volume_mm3 = number_in(json, "counted_volume_mm3", kVolumeMm3);
  return c;
}

}  // namespace

std::string write_certificate(const SolidCertificate& c) {
  const Json fields = {{"schema", kSchema},
                       {"written_by", "claystack " CLAYSTACK_VERSION},
                       {"claim", kClaim},
                       {"format", c.format},
                       {"bytes", c.bytes},
                       {"content_hash", c.content_hash},
                       {"profile_hash", c.profile_hash},
                       {"proof", c.proof == Proof::margins ? "margins" : "exact_test"},
                       {"segments", c.segments},
                       {"rounding_mm", c.rounding_mm},
                       {"clearance_mm", c.margins.clearance_mm},
                       {"chord_mm", c.margins.chord_mm},
                       {"wall_lower_mm", c.wall_lower_mm},
                       {"wall_upper_mm", c.wall_upper_mm},
                       {"volume_mm3", c.volume_mm3},
                       {"volume_bound_mm3", c.volume_bound_mm3},
                       {"counted_volume_mm3", c.counted_volume_mm3}};
  // The profile on one line, the fields for people on separate lines.
  std::string text = fields.dump(1, ' ', false, Json::error_handler_t::replace);
  text.resize(text.rfind('\n'));
  return text + ",\n \"profile_mm\": " + profile_json(c.profile).dump() + "\n}\n";
}

Result<SolidCertificate> parse_certificate(std::string_view bytes, std::string_view name) {
  if (bytes.size() > kMaxCertificateBytes)
    return bad_json(name, "expected a certificate of at most " +
                              std::to_string(kMaxCertificateBytes) + " bytes, found " +
                              std::to_string(bytes.size()));
  Profile profile;
  return parsed_with(bytes, name, ProfileReader(profile), from_json)
      .map([&](SolidCertificate certificate) {
        certificate.profile = std::move(profile);
        return certificate;
      })
      .map_error([&](Error error) {
        return kind_error(std::move(error), bytes, name, "a certificate (.certificate.json)");
      });
}

}  // namespace clay::solid::inline proof
