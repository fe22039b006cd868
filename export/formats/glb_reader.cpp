#include "claystack/export/formats.hpp"
#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/formats/glb.hpp"
#include "export/formats/glb_json.hpp"
#include "export/formats/glb_meshes.hpp"
#include "export/formats/glb_scene.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/stated_sizes.hpp"
#include "export/solid/vertex_welder.hpp"

#include <algorithm>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <utility>
#include <vector>

namespace clay::solid::inline formats {
namespace {

using namespace glb;

/// The meshes of the scene, in its places.
class GlbReader {
 public:
  GlbReader(std::string_view file, std::string_view name, const ReadOptions& options)
      : chunks_(chunks_of(file)),
        json_(parsed(chunks_.json)),
        meshes_(json_, chunks_.binary, name),
        scene_(scene_of(json_)),
        name_(name),
        options_(options) {}

  Result<TriangleMesh> read() {
    for (const auto& [mesh, matrix] : scene_.placed) (void)meshes_.read(mesh);
    if (auto fits = check_limit(); !fits) return tl::make_unexpected(fits.error());
    for (const auto& [mesh, matrix] : scene_.placed) place(meshes_.read(mesh), matrix);
    note_differences();
    return std::move(mesh_);
  }

  /// By the accessors, and by the headers of Draco's meshes.
  std::uint64_t stated_triangles() {
    std::map<std::size_t, std::uint64_t> stated;
    std::uint64_t triangles = 0;
    for (const auto& [mesh, matrix] : scene_.placed) {
      const auto [found, is_new] = stated.try_emplace(mesh);
      if (is_new) found->second = meshes_.stated_triangles(mesh);
      triangles += found->second;
    }
    return triangles;
  }

 private:
  [[nodiscard]] Result<void> check_limit() {
    std::uint64_t points = 0, triangles = 0;
    for (const auto& [mesh, matrix] : scene_.placed) {
      points += meshes_.read(mesh).points.size();
      triangles += meshes_.read(mesh).triangles.size();
    }
    const auto most = [&](std::uint64_t stored, std::uint64_t free, std::string_view what,
                          std::uint64_t found) {
      if (found <= most_with_copies(stored, free)) return;
      throw BadGlb("expected a scene of at most " + std::to_string(kMostCopies) + " times the " +
                   std::to_string(stored) + " " + std::string(what) + " in the file, found " +
                   std::to_string(found));
    };
    most(meshes_.triangles(), kFreeTriangles, "triangles", triangles);
    most(meshes_.points(), 3 * kFreeTriangles, "points", points);
    if (points > kMaxPoints) throw BadGlb(expected_at_most(kMaxPoints, "vertices"));
    return check_facet_count(triangles, name_);
  }

  void place(const TriangleMesh& mesh, const glm::dmat4& matrix) {
    const bool mirrored = glm::determinant(glm::dmat3(matrix)) < 0.0;
    std::vector<std::uint32_t> number(mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      step_of_loop();
      const glm::vec3 point = to_mm(glm::dvec3(matrix * glm::dvec4(mesh.points[i], 1.0)));
      if (const auto bad = find_bad_coordinate(point)) throw BadGlb("in mm: " + *bad);
      number[i] = welder_.index_of(point);
    }
    for (auto [a, b, c] : mesh.triangles) {
      if (mirrored) std::swap(b, c);
      mesh_.triangles.push_back({number[a], number[b], number[c]});
    }
  }

  void note_differences() const {
    if (options_.notes == nullptr) return;
    const auto note = [&](std::size_t count, std::string_view noun, std::string_view what) {
      if (count > 0) options_.notes->push_back(counted(count, noun).append(what));
    };
    if (scene_.missing)
      options_.notes->push_back("no scene in the file: all its root nodes are read");
    note(scene_.morphed, "node", " with morph weights, which are not applied");
    note(scene_.skinned, "node", " with a skin, whose skeleton is not applied");
    note(scene_.instanced, "node",
         " with EXT_mesh_gpu_instancing, which is not applied: the mesh is read once");
    note(meshes_.without_surface(), "primitive", " of points or lines not read");
  }

  Chunks chunks_;
  Json json_;
  Meshes meshes_;
  Scene scene_;
  std::string_view name_;
  ReadOptions options_;
  TriangleMesh mesh_;
  VertexWelder welder_{mesh_.points, 0};
};

}  // namespace

Result<TriangleMesh> decode_glb(std::string_view bytes, std::string_view name,
                                const ReadOptions& options) {
  return check_file_size(bytes, name).and_then([&] {
    return guarded(name, [&]() -> Result<TriangleMesh> {
      try {
        return GlbReader(bytes, name, options).read();
      } catch (const BadStream& bad) {
        return tl::make_unexpected(bad.error);
      } catch (const BadGlb& error) {
        return bad_file(name, error.what());
      }
    });
  });
}

std::uint64_t glb_triangles(std::string_view bytes) {
  return check_file_size(bytes, {})
      .and_then([&] {
        return guarded({}, [&]() -> Result<std::uint64_t> {
          return GlbReader(bytes, {}, {}).stated_triangles();
        });
      })
      .value_or(0);
}

}  // namespace clay::solid::inline formats
