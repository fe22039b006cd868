#include "export/proof/verify_file.hpp"

#include "export/formats/stored_file.hpp"
#include "export/proof/describe.hpp"
#include "export/proof/inspect_mesh.hpp"
#include "export/solid/mesh_topology.hpp"
#include "export/solid/vertex_distance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

namespace clay::solid::inline proof {
namespace {

/// Largest displacement of a corner [mm] in formats that keep the order of triangles and corners.
double corner_distance(const TriangleMesh& mesh, const TriangleMesh& decoded) {
  double largest = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      largest = std::max(largest, glm::distance(mesh.points[mesh.triangles[t][c]],
                                                decoded.points[decoded.triangles[t][c]]));
  return largest;
}

}  // namespace

double float_rounding_mm(const TriangleMesh& mesh) noexcept {
  double farthest = 0.0;
  for (const glm::dvec3& p : mesh.points) farthest = std::max(farthest, glm::length(p));
  return std::ldexp(farthest, -24);
}

Result<double> verify_file(std::string_view bytes, MeshFormat format, const TriangleMesh& mesh,
                           double allowed_mm) {
  const std::string name = std::string(name_of(format)) + " as written";
  const auto wrong = [&](const std::string& expected_and_found) {
    return failure(ErrorKind::unsound, name + ": " + expected_and_found);
  };
  const auto decoded = decode_mesh(bytes, format, name);
  if (!decoded) return tl::make_unexpected(decoded.error());
  if (decoded->triangles.size() != mesh.triangles.size())
    return wrong("expected " + std::to_string(mesh.triangles.size()) + " triangles, found " +
                 std::to_string(decoded->triangles.size()));
  const bool reordered =
      format == MeshFormat::drc || format == MeshFormat::three_mf || format == MeshFormat::glb;
  const double moved =
      reordered ? vertex_distance(mesh, *decoded) : corner_distance(mesh, *decoded);
  if (moved > allowed_mm)
    return wrong("expected vertices within " + nine_digit_text(allowed_mm) +
                 " mm of their places, found " + nine_digit_text(moved) + " mm");
  if (reordered) {
    // The decoded points differ from those checked before encoding.
    const MeshReport check = inspect_mesh(*decoded);
    if (!check.sound()) return wrong("found " + describe(check.problems.front()));
  } else {
    const MeshTopology topology = topology_of(decoded->points.size(), decoded->triangles);
    if (!topology.closed() || !topology.manifold() || !topology.oriented())
      return wrong("expected a closed manifold, found that the indices do not make one");
  }
  return moved;
}

Result<MeshReport> check_stored(const FileStore& store, std::uint64_t bytes, MeshFormat format) {
  const std::string name = as_written(format);
  const auto report =
      read_whole(store, bytes)
          .and_then([&](const std::string& file) { return decode_mesh(file, format, name); })
          .map(inspect_mesh);
  if (!report || report->sound()) return report;
  return failure(ErrorKind::unsound, name + ": found " + describe(report->problems.front()));
}

}  // namespace clay::solid::inline proof
