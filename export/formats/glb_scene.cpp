#include "export/formats/glb_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec4.hpp>
#include <set>
#include <string>

namespace clay::solid::inline formats::glb {
namespace {

constexpr std::size_t kMaxNodeDepth = 32;

/// Of materials, textures or lights, by any vendor, such as EXT_texture_webp: it moves no point.
bool is_of_appearance(std::string_view extension) {
  const std::string_view kind = extension.substr(std::min(extension.find('_'), extension.size()));
  return std::ranges::any_of(std::array{"_materials_", "_texture_", "_lights_"},
                             [&](const char* begin) { return kind.starts_with(begin); });
}

void check_extensions(const Json& json) {
  const auto required = json.find("extensionsRequired");
  if (required == json.end()) return;
  for (const Json& extension : *required) {
    const std::string text = extension.is_string() ? extension.get<std::string>() : "";
    if (text == kDraco || text == kMeshopt || text == kQuantization || is_of_appearance(text))
      continue;
    throw BadGlb("expected no required extension but " +
                 std::string(kDraco).append(", ").append(kMeshopt).append(", ") +
                 std::string(kQuantization) + " and those of materials, textures and lights, " +
                 "found '" + one_line(text.substr(0, 60)) + "'");
  }
}

std::vector<std::size_t> nodes_in(const Json& json, const char* key) {
  std::vector<std::size_t> nodes;
  const auto found = json.find(key);
  if (found == json.end()) return nodes;
  if (!found->is_array()) throw BadGlb(std::string(key) + ": expected a list of nodes");
  for (const Json& node : *found) {
    if (!node.is_number_unsigned()) throw BadGlb(std::string(key) + ": expected numbers");
    nodes.push_back(node.get<std::size_t>());
  }
  return nodes;
}

/// Whether weights other than 0 move the points. Those of the node replace those of the mesh.
bool is_morphed(const Json& node, const Json& mesh) {
  const Json& owner = node.contains("weights") ? node : mesh;
  const auto weights = owner.find("weights");
  return weights != owner.end() && weights->is_array() &&
         std::ranges::any_of(*weights, [](const Json& w) { return w.is_number() && w != 0; });
}

/// A unit quaternion: any other would scale the mesh too.
std::array<double, 4> rotation_of(const Json& node) {
  const auto q = numbers_in(node, "rotation", {0, 0, 0, 1});
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!(std::abs(length - 1.0) <= 1e-3))
    throw BadGlb("rotation: expected a quaternion of length 1, found " + nine_digit_text(length));
  return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

glm::dmat4 whole_matrix_of(const Json& node) {
  for (const char* other : {"translation", "rotation", "scale"})
    if (node.contains(other))
      throw BadGlb("expected a node with a matrix or with a " + std::string(other) +
                   ", found one with both");
  const auto m = numbers_in(node, "matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  glm::dmat4 matrix(1.0);
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = m[static_cast<std::size_t>(i)];
  return matrix;
}

glm::dmat4 matrix_of(const Json& node) {
  if (node.contains("matrix")) return whole_matrix_of(node);
  const auto t = numbers_in(node, "translation", {0, 0, 0});
  const auto [x, y, z, w] = rotation_of(node);
  const auto s = numbers_in(node, "scale", {1, 1, 1});
  return {glm::dvec4(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0) * s[0],
          glm::dvec4(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0) * s[1],
          glm::dvec4(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0) * s[2],
          glm::dvec4(t[0], t[1], t[2], 1)};
}

class SceneReader {
 public:
  explicit SceneReader(const Json& json) : json_(json) {}

  Scene read() {
    for (const std::size_t node : first_nodes()) visit(node, glm::dmat4(1.0), 0);
    return std::move(scene_);
  }

 private:
  /// Those of the scene. A file may have no scenes: then the nodes that are no child of another.
  [[nodiscard]] std::vector<std::size_t> first_nodes() {
    if (json_.contains("scenes"))
      return nodes_in(object_at(json_, "scenes", count_in(json_, "scene", 0)), "nodes");
    scene_.missing = true;
    const auto found = json_.find("nodes");
    const std::size_t count = found != json_.end() && found->is_array() ? found->size() : 0;
    std::vector<bool> child(count);
    for (std::size_t i = 0; i < count; ++i)
      for (const std::size_t node : nodes_in(object_at(json_, "nodes", i), "children"))
        if (node < count) child[node] = true;
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < count; ++i)
      if (!child[i]) first.push_back(i);
    return first;
  }

  /// Every node has one parent: a second visit is a cycle or a fault.
  void visit(std::size_t index, const glm::dmat4& outer, std::size_t depth) {
    const Json& node = object_at(json_, "nodes", index);
    if (depth > kMaxNodeDepth || !visited_.insert(index).second)
      throw BadGlb("expected a tree of nodes at most 32 deep, found node " + std::to_string(index) +
                   " twice or deeper");
    const glm::dmat4 matrix = outer * matrix_of(node);
    if (node.contains("mesh")) {
      const std::size_t mesh = count_in(node, "mesh");
      // By the specification, only the joints of a skin move its mesh.
      const bool skinned = node.contains("skin");
      scene_.placed.emplace_back(mesh, skinned ? glm::dmat4(1.0) : matrix);
      scene_.skinned += skinned;
      scene_.morphed += is_morphed(node, object_at(json_, "meshes", mesh));
      scene_.instanced += has_extension(node, kInstancing);
    }
    for (const std::size_t child : nodes_in(node, "children")) visit(child, matrix, depth + 1);
  }

  const Json& json_;
  std::set<std::size_t> visited_;  ///< nodes
  Scene scene_;
};

}  // namespace

Scene scene_of(const Json& json) {
  check_extensions(json);
  return SceneReader(json).read();
}

}  // namespace clay::solid::inline formats::glb
