#include "claystack/export/formats.hpp"
#include "core/text.hpp"
#include "export/formats/draco_bits.hpp"
#include "export/formats/draco_counts.hpp"
#include "export/formats/draco_grid.hpp"
#include "export/formats/draco_mesh.hpp"
#include "export/formats/draco_metadata.hpp"
#include "export/formats/file_floats.hpp"
#include "export/formats/mesh_limits.hpp"

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <algorithm>
#include <cmath>
#include <exception>
#include <glm/common.hpp>
#include <new>
#include <optional>
#include <utility>

namespace clay::solid::inline formats {
namespace {

// Draco's entropy coder keeps a counter for every value a residual may take: 0.1 GB at 24 bits,
// gigabytes at 30. Finer residuals are stored uncompressed, as incompressible noise would be; from
// speed 2 on, the prediction does not count them either.
constexpr int kMaxEntropyCodedBits = 24;
constexpr int kLeastSpeedWithoutCounters = 2;
constexpr std::string_view kMagic = "DRACO";
constexpr std::size_t kVersionAt = 5;  // two bytes, the major one first
constexpr int kOldestVersion = 0x0100, kVersion = 0x0202, kVersionWithMetadata = 0x0103;

Result<void> check_settings(const DracoSettings& settings) {
  const bool good = settings.max_error_mm > 0.0 && settings.min_bits >= 1 &&
                    settings.min_bits <= kMaxDracoBits && settings.speed >= 0 &&
                    settings.speed <= 10;
  if (good) return {};
  return failure(ErrorKind::bad_input,
                 "cannot write .drc: expected an error above 0 mm, 1 to 30 bits, speed 0 to 10");
}

Result<void> check_claims(const DracoClaims* claims, const DracoSettings& settings) {
  if (claims == nullptr) return {};
  for (const double claim : {claims->volume_mm3, claims->volume_bound_mm3,
                             claims->counted_volume_mm3, claims->vertex_error_mm}) {
    if (std::isfinite(claim) && claim >= 0.0) continue;
    return failure(ErrorKind::bad_input, "cannot write .drc: expected claims of 0 or more");
  }
  if (claims->vertex_error_mm >= settings.max_error_mm) return {};
  return failure(ErrorKind::bad_input,
                 "cannot write .drc: expected no smaller vertex error claimed than allowed");
}

/// Draco's encoder does not check meshes, so this refuses those that break it.
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

Result<EncodedDraco> encode_on_grid(const TriangleMesh& mesh, const std::vector<glm::vec3>& points,
                                    const DracoGrid& grid, int speed,
                                    std::span<const std::array<std::uint16_t, 4>> colours = {}) {
  const auto input = to_draco(mesh, points, colours);
  draco::ExpertEncoder encoder(*input);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  const bool entropy_coded = grid.bits <= kMaxEntropyCodedBits;
  const int used_speed = entropy_coded ? speed : std::max(speed, kLeastSpeedWithoutCounters);
  encoder.SetSpeedOptions(used_speed, used_speed);
  encoder.SetUseBuiltInAttributeCompression(entropy_coded);
  encoder.SetAttributeExplicitQuantization(0, grid.bits, 3, &grid.origin.x, grid.side_mm);
  encoder.SetTrackEncodedProperties(true);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeToBuffer(&buffer);
  if (!status.ok()) {
    return failure(ErrorKind::io, "cannot write .drc: Draco: " + status.error_msg_string());
  }
  // Edgebreaker silently drops triangles that use one vertex twice.
  const std::size_t dropped = mesh.triangles.size() - encoder.num_encoded_faces();
  if (dropped > 0) {
    return failure(ErrorKind::unsound, "cannot write .drc: " + std::to_string(dropped) +
                                           " triangles use a vertex twice");
  }
  return EncodedDraco{std::string(buffer.data(), buffer.size()),
                      encoder.num_encoded_points(),
                      encoder.num_encoded_faces(),
                      {},
                      {}};
}

int version_of(std::string_view bytes) {
  const auto byte = [bytes](std::size_t at) { return int{static_cast<unsigned char>(bytes[at])}; };
  return 256 * byte(kVersionAt) + byte(kVersionAt + 1);
}

/// Refuses point clouds: decoding a few hundred bytes may take gigabytes.
Result<void> check_header(std::string_view bytes, std::string_view name) {
  if (!bytes.starts_with(kMagic))
    return bad_file(name, "expected a Draco file, which begins with DRACO");
  if (bytes.size() < kDracoHeaderBytes) return bad_file(name, "the Draco header ends early");
  const auto byte = [bytes](std::size_t at) { return int{static_cast<unsigned char>(bytes[at])}; };
  const int version = version_of(bytes), type = byte(7), method = byte(8);
  if (type != draco::TRIANGULAR_MESH) {
    return bad_file(name, "expected a triangle mesh, found Draco geometry " + std::to_string(type));
  }
  if (version < kOldestVersion || version > kVersion) {
    return bad_file(name, "expected Draco version 1.0 to 2.2, found " +
                              std::to_string(version / 256) + "." + std::to_string(version % 256));
  }
  if (method != draco::MESH_SEQUENTIAL_ENCODING && method != draco::MESH_EDGEBREAKER_ENCODING) {
    return bad_file(name, "expected Draco mesh method 0 or 1, found " + std::to_string(method));
  }
  return {};
}

Result<std::optional<DracoMetadata>> read_metadata(std::string_view bytes, std::string_view name) {
  return check_file_size(bytes, name)
      .and_then([&] { return check_header(bytes, name); })
      .and_then([&]() -> Result<std::optional<DracoMetadata>> {
        if (version_of(bytes) < kVersionWithMetadata) return std::nullopt;
        return read_draco_metadata(bytes, name);
      });
}

/// Decodes a file without metadata.
Result<TriangleMesh> decode_plain(std::string_view bytes, std::string_view name) {
  if (const auto counts = draco_counts(bytes, name); !counts)
    return tl::make_unexpected(counts.error());
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return bad_file(name, "Draco: " + decoded.status().error_msg_string());
  if (buffer.remaining_size() != 0) {
    return bad_file(name,
                    "expected the end of the file after the mesh, found " +
                        counted(static_cast<std::size_t>(buffer.remaining_size()), "more byte"));
  }
  return from_draco(*decoded.value(), name);
}

}  // namespace

Result<std::string> encode_drc(const TriangleMesh& mesh, const DracoSettings& settings,
                               const DracoClaims* claims) try {
  const std::vector<glm::vec3> points = file_points(mesh.points);
  return check_settings(settings)
      .and_then([&] { return check_claims(claims, settings); })
      .and_then([&] { return check_mesh_for_draco(mesh, points); })
      .and_then([&] { return choose_grid(points, settings); })
      .and_then(
          [&](const DracoGrid& grid) { return encode_on_grid(mesh, points, grid, settings.speed); })
      .map([&](EncodedDraco plain) {
        return claims == nullptr ? std::move(plain.bytes) : with_claims(plain.bytes, *claims);
      });
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::io, "cannot write .drc: not enough memory");
} catch (const std::exception& error) {
  return failure(ErrorKind::io, std::string("cannot write .drc: ") + error.what());
}

Result<EncodedDraco> encode_draco(const TriangleMesh& mesh, const DracoSettings& settings,
                                  std::span<const std::array<std::uint16_t, 4>> colours,
                                  const GridFile& file) try {
  const std::vector<glm::vec3> points = file_points(mesh.points);
  return check_settings(settings)
      .and_then([&] { return check_mesh_for_draco(mesh, points); })
      .and_then([&] { return choose_grid(points, settings, file); })
      .and_then([&](const DracoGrid& grid) {
        return encode_on_grid(mesh, points, grid, settings.speed, colours);
      })
      .and_then([](EncodedDraco encoded) {
        return decode_plain(encoded.bytes, "draco as encoded")
            .map([&](const TriangleMesh& decoded) {
              encoded.low = encoded.high = glm::vec3(decoded.points.front());
              for (const glm::dvec3& point : decoded.points) {
                encoded.low = glm::min(encoded.low, glm::vec3(point));
                encoded.high = glm::max(encoded.high, glm::vec3(point));
              }
              return std::move(encoded);
            });
      });
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::io, "cannot encode with Draco: not enough memory");
} catch (const std::exception& error) {
  return failure(ErrorKind::io, std::string("cannot encode with Draco: ") + error.what());
}

Result<TriangleMesh> decode_drc(std::string_view bytes, std::string_view name) {
  return guarded(name, [&] {
    return read_metadata(bytes, name).and_then([&](const std::optional<DracoMetadata>& metadata) {
      return metadata ? decode_plain(without_metadata(bytes, *metadata), name)
                      : decode_plain(bytes, name);
    });
  });
}

Result<std::size_t> drc_triangles(std::string_view bytes, std::string_view name) {
  return guarded(name, [&] {
    return read_metadata(bytes, name)
        .and_then([&](const std::optional<DracoMetadata>& metadata) {
          return metadata ? draco_counts(without_metadata(bytes, *metadata), name)
                          : draco_counts(bytes, name);
        })
        .map([](const DracoCounts& counts) { return static_cast<std::size_t>(counts.triangles); });
  });
}

Result<std::optional<DracoClaims>> drc_claims(std::string_view bytes, std::string_view name) {
  return guarded(name, [&] {
    return read_metadata(bytes, name).map([](const std::optional<DracoMetadata>& metadata) {
      return metadata ? metadata->claims : std::nullopt;
    });
  });
}

}  // namespace clay::solid::inline formats
