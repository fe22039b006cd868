#include "claystack/export/mesh_formats.hpp"
#include "draco_mesh.hpp"
#include "file_floats.hpp"
#include "mesh_limits.hpp"

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <algorithm>
#include <cmath>
#include <exception>
#include <glm/common.hpp>
#include <limits>
#include <numbers>

namespace clay::solid {
namespace {

constexpr int kMaxBits = 30;
// Draco's entropy coder keeps a counter for every value a residual may take: 0.1 GB of them
// at 24 bits, gigabytes at 30. Finer residuals are stored plainly, as noise would be anyway;
// and from speed 2 on no prediction counts them either.
constexpr int kMaxEntropyCodedBits = 24;
constexpr int kLeastSpeedWithoutCounters = 2;
constexpr float kLeastSideMm = 1e-6F;
constexpr std::size_t kHeaderBytes = 11;
constexpr std::string_view kMagic = "DRACO";

/// The cube that Draco's grid divides: its corner of least coordinates, and its side.
struct GridBox {
  glm::vec3 origin{0.0F};
  float side = 1.0F;
  float farthest = 0.0F;  ///< largest |coordinate| of a point
};

GridBox box_of(const std::vector<glm::vec3>& points) noexcept {
  glm::vec3 low = points.front();
  glm::vec3 high = points.front();
  for (const glm::vec3& point : points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  const glm::vec3 size = high - low;
  const glm::vec3 reach = glm::max(glm::abs(low), glm::abs(high));
  // Upward, so that no rounding leaves a point outside the box; and never so small that its
  // inverse overflows in Draco.
  const float extent = std::max({size.x, size.y, size.z});
  const float side = std::max(kLeastSideMm, std::nextafter(extent, 4.0F * kMaxCoordinateMm));
  return {low, side, std::max({reach.x, reach.y, reach.z})};
}

/// A bound on how far a vertex moves [mm]: half a step along each axis, and what float32
/// loses on the way. Draco works in float32: the difference to the origin, the scale and its
/// product, the added half, then step, product and sum of the way back are at most 9 roundings
/// relative to the side (10 covers the products of roundings), and the sum one relative to
/// the coordinate itself, which has been rounded once before Draco saw it.
double error_bound_mm(const GridBox& box, int bits) noexcept {
  constexpr double kUnitRoundoff = 0x1p-24;
  const double step = double{box.side} / (std::exp2(bits) - 1.0);
  return std::numbers::sqrt3 *
         (0.5 * step + kUnitRoundoff * (10.0 * double{box.side} + 2.0 * double{box.farthest}));
}

Result<int> choose_bits(const GridBox& box, const DracoSettings& settings) {
  for (int bits = settings.min_bits; bits <= kMaxBits; ++bits) {
    if (error_bound_mm(box, bits) <= settings.max_error_mm) return bits;
  }
  std::string what = "cannot write .drc: a vertex error of ";
  append_number(what, settings.max_error_mm);
  what += " mm needs more than 30 bits; the least that can be promised is ";
  append_number(what, error_bound_mm(box, kMaxBits));
  return failure(ErrorKind::bad_input, what + " mm");
}

Result<void> check_settings(const DracoSettings& settings) {
  const bool good = settings.max_error_mm > 0.0 && settings.min_bits >= 1 &&
                    settings.min_bits <= kMaxBits && settings.speed >= 0 && settings.speed <= 10;
  if (good) return {};
  return failure(ErrorKind::bad_input,
                 "cannot write .drc: expected an error above 0 mm, 1 to 30 bits, speed 0 to 10");
}

/// Draco's encoder is not made for bad meshes: what would break it is refused here.
Result<void> check_mesh_for_draco(const TriangleMesh& mesh, const std::vector<glm::vec3>& points) {
  const auto refuse = [](std::string_view what) {
    return failure(ErrorKind::unsound, std::string("cannot write .drc: ").append(what));
  };
  if (mesh.triangles.empty()) return refuse("the mesh has no triangles");
  for (const glm::vec3& point : points) {
    if (const auto bad = find_bad_coordinate(point)) return refuse(*bad);
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t highest = *std::ranges::max_element(mesh.triangles[i]);
    if (highest < points.size()) continue;
    return refuse("triangle " + std::to_string(i + 1) + " names point " + std::to_string(highest) +
                  " of " + std::to_string(points.size()));
  }
  return {};
}

Result<std::string> encode_on_grid(const TriangleMesh& mesh, const std::vector<glm::vec3>& points,
                                   const GridBox& box, int bits, int speed) {
  const auto input = to_draco(mesh, points);
  draco::ExpertEncoder encoder(*input);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  const bool entropy_coded = bits <= kMaxEntropyCodedBits;
  const int used_speed = entropy_coded ? speed : std::max(speed, kLeastSpeedWithoutCounters);
  encoder.SetSpeedOptions(used_speed, used_speed);
  encoder.SetUseBuiltInAttributeCompression(entropy_coded);
  encoder.SetAttributeExplicitQuantization(0, bits, 3, &box.origin.x, box.side);
  encoder.SetTrackEncodedProperties(true);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeToBuffer(&buffer);
  if (!status.ok()) {
    return failure(ErrorKind::unsound, "cannot write .drc: Draco: " + status.error_msg_string());
  }
  // Edgebreaker leaves out, silently, triangles that use one vertex twice.
  const std::size_t dropped = mesh.triangles.size() - encoder.num_encoded_faces();
  if (dropped > 0) {
    return failure(ErrorKind::unsound, "cannot write .drc: " + std::to_string(dropped) +
                                           " triangles use a vertex twice");
  }
  return std::string(buffer.data(), buffer.size());
}

/// No point clouds: decoding one may take gigabytes for a few hundred bytes.
Result<void> check_header(std::string_view bytes, std::string_view name) {
  if (!bytes.starts_with(kMagic))
    return bad_file(name, "expected a Draco file, which begins with DRACO");
  if (bytes.size() < kHeaderBytes) return bad_file(name, "the Draco header ends early");
  const auto byte = [bytes](std::size_t at) { return int{static_cast<unsigned char>(bytes[at])}; };
  const int major = byte(5), minor = byte(6), type = byte(7), method = byte(8);
  if (type != draco::TRIANGULAR_MESH) {
    return bad_file(name, "expected a triangle mesh, found Draco geometry " + std::to_string(type));
  }
  if (major != 2 || minor != 2) {
    return bad_file(name, "expected Draco version 2.2, found " + std::to_string(major) + "." +
                              std::to_string(minor));
  }
  if (method != draco::MESH_SEQUENTIAL_ENCODING && method != draco::MESH_EDGEBREAKER_ENCODING) {
    return bad_file(name, "expected Draco mesh method 0 or 1, found " + std::to_string(method));
  }
  return {};
}

Result<TriangleMesh> decode_body(std::string_view bytes, std::string_view name) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return bad_file(name, "Draco: " + decoded.status().error_msg_string());
  if (buffer.remaining_size() != 0) {
    return bad_file(name, "expected the end of the file after the mesh, found " +
                              std::to_string(buffer.remaining_size()) + " bytes more");
  }
  return from_draco(*decoded.value(), name);
}

}  // namespace

Result<std::string> encode_drc(const TriangleMesh& mesh, const DracoSettings& settings) try {
  const std::vector<glm::vec3> points = file_points(mesh.points);
  GridBox box;
  return check_settings(settings)
      .and_then([&] { return check_mesh_for_draco(mesh, points); })
      .and_then([&] {
        box = box_of(points);
        return choose_bits(box, settings);
      })
      .and_then([&](int bits) { return encode_on_grid(mesh, points, box, bits, settings.speed); });
} catch (const std::exception& error) {
  return failure(ErrorKind::unsound, std::string("cannot write .drc: ") + error.what());
}

Result<TriangleMesh> decode_drc(std::string_view bytes, std::string_view name) {
  return guarded(name, [&] {
    return check_file_size(bytes, name)
        .and_then([&] { return check_header(bytes, name); })
        .and_then([&] { return decode_body(bytes, name); });
  });
}

}  // namespace clay::solid
