#include "check.hpp"

#include "claystack/engine/atomic_file.hpp"
#include "claystack/export/decimate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace clay::app {
namespace {

using solid::MeshFormat;
using solid::TriangleMesh;

/// Repairs and decimates as asked.
Result<TriangleMesh> mended(TriangleMesh mesh, const CheckCommand& command, Mending& mending) {
  mending.found = solid::check_mesh(mesh).problems;
  if (command.repair && !mending.found.empty()) {
    auto repaired = solid::repair(mesh);
    if (!repaired) return tl::make_unexpected(repaired.error());
    mesh = std::move(repaired->mesh);
    mending.repaired = std::move(repaired->repaired);
  }
  mending.triangles_before = mesh.triangles.size();
  if (command.max_triangles && mesh.triangles.size() > *command.max_triangles) {
    auto decimated = solid::decimate(mesh, *command.max_triangles);
    if (!decimated) return tl::make_unexpected(decimated.error());
    mending.decimation_error_mm = decimated->max_error_mm;
    mesh = std::move(decimated->mesh);
  }
  return mesh;
}

Result<std::string> encoded(const TriangleMesh& mesh, MeshFormat format) {
  switch (format) {
    case MeshFormat::obj:
      return solid::encode_obj(mesh, "mended");
    case MeshFormat::drc:
      return solid::encode_drc(mesh, {});
    case MeshFormat::stl_binary:
    case MeshFormat::stl_ascii:
      break;
  }
  return solid::encode_stl_binary(mesh);
}

/// The verdict is on what the file will hold, so the bytes are read again before they are written.
Result<TriangleMesh> written(const TriangleMesh& mesh, const CheckCommand& command,
                             Mending& mending) {
  const auto bytes = encoded(mesh, mending.format);
  if (!bytes) return tl::make_unexpected(bytes.error());
  auto reread = solid::decode_mesh(*bytes, mending.format, command.out);
  if (!reread) return reread;
  if (const auto done = publish(command.out, *bytes); !done)
    return tl::make_unexpected(done.error());
  mending.path = command.out;
  mending.bytes = bytes->size();
  return reread;
}

void measure_wall(const TriangleMesh& mesh, const CheckCommand& command, Verdict& verdict) {
  const auto problem = [&](std::string what, std::string where) {
    verdict.mesh.problems.push_back({std::move(what), std::move(where), 1});
  };
  const auto wall = solid::sampled_wall(mesh, command.wall_samples);
  if (!wall) {
    problem("wall not measured", wall.error().message);
    return;
  }
  verdict.wall_sampled = *wall;
  if (std::isinf(wall->least_mm))
    problem("wall not measured",
            fmt::format("none of {} rays met the other side of a wall", wall->rays));
  else if (wall->least_mm < *command.min_wall_mm)
    problem("thin wall (sampled)",
            fmt::format("triangle {} at ({:.6g}, {:.6g}, {:.6g}) mm: {:.3f} mm, expected {:.3f} mm "
                        "at least",
                        wall->triangle, wall->place.x, wall->place.y, wall->place.z, wall->least_mm,
                        *command.min_wall_mm));
}

Result<TriangleMesh> mend_and_write(TriangleMesh mesh, const CheckCommand& command,
                                    Mending& mending) {
  const auto format = solid::mesh_format_of(command.out);
  if (!format) return tl::make_unexpected(format.error());
  mending.format = *format;
  return mended(std::move(mesh), command, mending).and_then([&](const TriangleMesh& result) {
    return written(result, command, mending);
  });
}

}  // namespace

Result<Verdict> check_mesh_file(std::string_view bytes, MeshFormat format,
                                const CheckCommand& command) {
  auto mesh = solid::decode_mesh(bytes, format, command.file);
  if (!mesh) return tl::make_unexpected(mesh.error());
  Verdict verdict;
  if (command.mends()) {
    mesh = mend_and_write(std::move(*mesh), command, verdict.mending.emplace());
    if (!mesh) return failure(mesh.error().kind, command.file + ": " + mesh.error().message);
  }
  verdict.mesh = solid::check_mesh(*mesh);
  if (command.min_wall_mm) measure_wall(*mesh, command, verdict);
  return verdict;
}

}  // namespace clay::app
