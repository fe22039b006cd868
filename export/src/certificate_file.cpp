#include "claystack/export/solid_certificate.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace clay::solid {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchemaVersion = 1;
constexpr std::string_view kClaim =
    "closed and embedded, of the volume and no thinner than stated, as the file's bytes say";

struct BadField : std::runtime_error {
  using std::runtime_error::runtime_error;
};

const Json& field(const Json& json, const std::string& name) {
  const auto found = json.find(name);
  if (found == json.end()) throw BadField(name + ": expected this field, found none");
  return *found;
}

double number(const Json& json, const std::string& name) {
  const Json& value = field(json, name);
  if (!value.is_number()) throw BadField(name + ": expected a number, found " + value.type_name());
  return value.get<double>();
}

std::uint64_t count(const Json& json, const std::string& name) {
  const Json& value = field(json, name);
  if (!value.is_number_unsigned())
    throw BadField(name + ": expected a whole number, found " + value.dump());
  return value.get<std::uint64_t>();
}

std::string text(const Json& json, const std::string& name) {
  const Json& value = field(json, name);
  if (!value.is_string()) throw BadField(name + ": expected text, found " + value.type_name());
  return value.get<std::string>();
}

void expect_no_others(const Json& json, const std::set<std::string>& known) {
  for (const auto& [name, value] : json.items())
    if (!known.contains(name)) throw BadField(name + ": unknown field");
}

Json profile_json(const Profile& profile) {
  Json pieces = Json::array();
  for (const Polygon& polygon : profile.pieces) {
    Json points = Json::array();
    for (const ProfilePoint& p : polygon) points.push_back({p.rho, p.y});
    pieces.push_back(std::move(points));
  }
  return pieces;
}

Profile profile_from(const Json& json) {
  Profile profile;
  for (const Json& points : field(json, "profile_mm")) {
    Polygon& polygon = profile.pieces.emplace_back();
    for (const Json& p : points) {
      if (!p.is_array() || p.size() != 2 || !p[0].is_number() || !p[1].is_number())
        throw BadField("profile_mm: expected points [rho, y], found " + p.dump());
      polygon.push_back({p[0].get<double>(), p[1].get<double>()});
    }
  }
  return profile;
}

Proof proof_from(const Json& json) {
  const std::string name = text(json, "proof");
  if (name == "margins") return Proof::margins;
  if (name == "exact_test") return Proof::exact_test;
  throw BadField("proof: expected margins or exact_test, found " + name);
}

SolidCertificate from_json(const Json& json) {
  if (!json.is_object()) throw BadField("expected an object");
  expect_no_others(json, {"kind", "schema", "claim", "format", "bytes", "content_hash",
                          "profile_hash", "proof", "segments", "rounding_mm", "clearance_mm",
                          "chord_mm", "wall_lower_mm", "wall_upper_mm", "volume_mm3",
                          "volume_bound_mm3", "counted_volume_mm3", "profile_mm"});
  if (text(json, "kind") != "claystack certificate")
    throw BadField("kind: expected claystack certificate");
  if (count(json, "schema") != kSchemaVersion)
    throw BadField("schema: expected 1, found " + field(json, "schema").dump());
  SolidCertificate c;
  c.format = text(json, "format");
  c.bytes = count(json, "bytes");
  c.content_hash = text(json, "content_hash");
  c.profile_hash = text(json, "profile_hash");
  c.proof = proof_from(json);
  c.segments = count(json, "segments");
  c.rounding_mm = number(json, "rounding_mm");
  c.margins = {number(json, "clearance_mm"), number(json, "chord_mm"), c.segments};
  c.wall_lower_mm = number(json, "wall_lower_mm");
  c.wall_upper_mm = number(json, "wall_upper_mm");
  c.volume_mm3 = number(json, "volume_mm3");
  c.volume_bound_mm3 = number(json, "volume_bound_mm3");
  c.counted_volume_mm3 = number(json, "counted_volume_mm3");
  c.profile = profile_from(json);
  return c;
}

}  // namespace

std::string write_certificate(const SolidCertificate& c) {
  const Json fields = {{"kind", "claystack certificate"},
                       {"schema", kSchemaVersion},
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
  // The profile on one line, the fields that people read on lines of their own.
  std::string text = fields.dump(1, ' ', false, Json::error_handler_t::replace);
  text.resize(text.rfind('\n'));
  return text + ",\n \"profile_mm\": " + profile_json(c.profile).dump() + "\n}\n";
}

Result<SolidCertificate> parse_certificate(std::string_view bytes, std::string_view name) try {
  return from_json(Json::parse(bytes));
} catch (const std::exception& error) {
  return failure(ErrorKind::bad_input, std::string(name).append(": ").append(error.what()));
}

}  // namespace clay::solid
