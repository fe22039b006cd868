#include "app/import/mesh_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace clay::importing {
namespace {

/// A symmetric matrix as v diag(values) v^T, by Jacobi's rotations.
struct Eigen {
  std::array<double, 3> values{};
  glm::dmat3 vectors{1.0};  ///< columns
};

Eigen eigen_of(glm::dmat3 a) {
  Eigen result;
  glm::dmat3& v = result.vectors;
  constexpr std::array<std::pair<int, int>, 3> kPairs = {{{0, 1}, {0, 2}, {1, 2}}};
  for (int sweep = 0; sweep < 60; ++sweep) {
    for (const auto& [p, q] : kPairs) {
      if (a[p][q] == 0.0) continue;
      const double ratio = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
      const double t = (ratio < 0.0 ? -1.0 : 1.0) / (std::abs(ratio) + std::hypot(1.0, ratio));
      const double c = 1.0 / std::hypot(1.0, t), s = t * c;
      glm::dmat3 turn(1.0);
      turn[p][p] = turn[q][q] = c;
      turn[q][p] = s;
      turn[p][q] = -s;
      a = glm::transpose(turn) * a * turn;
      a[p][q] = a[q][p] = 0.0;
      v = v * turn;
    }
  }
  for (int i = 0; i < 3; ++i) result.values[static_cast<std::size_t>(i)] = a[i][i];
  return result;
}

/// The inverse where the matrix is regular, zero elsewhere: a cylinder has no normals along its
/// axis.
glm::dmat3 pseudo_inverse(const glm::dmat3& m) {
  const Eigen eigen = eigen_of(m);
  const double largest = *std::max_element(eigen.values.begin(), eigen.values.end());
  glm::dmat3 result(0.0);
  for (int i = 0; i < 3; ++i) {
    const double value = eigen.values[static_cast<std::size_t>(i)];
    if (value > 1e-9 * largest)
      result += glm::outerProduct(eigen.vectors[i], eigen.vectors[i]) / value;
  }
  return result;
}

/// The normal line of a triangle: n, and the moment x cross n.
struct NormalLine {
  glm::dvec3 direction, moment;
  double weight = 0.0;  ///< its area
};

/// A line of best fit: direction and moment.
using Fit = std::pair<glm::dvec3, glm::dvec3>;

/// Distance of a normal line from the axis [mm], times the sine of the angle between them.
double miss(const Fit& axis, const NormalLine& line) {
  return std::abs(glm::dot(axis.first, line.moment) + glm::dot(axis.second, line.direction));
}

Fit best_line(const std::vector<NormalLine>& lines, const Fit* last, double scale) {
  glm::dmat3 moments(0.0), mixed(0.0), directions(0.0);
  for (const NormalLine& line : lines) {
    double weight = line.weight;
    if (last != nullptr) {
      const double far = miss(*last, line) / scale;
      weight /= (1.0 + far * far) * (1.0 + far * far);
    }
    moments += weight * glm::outerProduct(line.moment, line.moment);
    mixed += weight * glm::outerProduct(line.moment, line.direction);
    directions += weight * glm::outerProduct(line.direction, line.direction);
  }
  // The moment that fits a direction best is linear in it.
  const glm::dmat3 moment_of = -1.0 * pseudo_inverse(directions) * glm::transpose(mixed);
  const Eigen eigen = eigen_of(moments + mixed * moment_of);
  const auto least = std::min_element(eigen.values.begin(), eigen.values.end());
  const glm::dvec3 direction = eigen.vectors[static_cast<int>(least - eigen.values.begin())];
  return {direction, moment_of * direction};
}

}  // namespace

MeshAxis fitted_axis(const solid::TriangleMesh& mesh) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : mesh.points) low = glm::min(low, p), high = glm::max(high, p);
  const glm::dvec3 middle = 0.5 * (low + high);
  const double size = std::max(glm::length(high - low), 1e-9);
  std::vector<NormalLine> lines;
  lines.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    std::array<glm::dvec3, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) p[i] = (mesh.points[triangle[i]] - middle) / size;
    const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double area = glm::length(normal);
    if (!(area > 0.0)) continue;
    const glm::dvec3 n = normal / area;
    lines.push_back({n, glm::cross((p[0] + p[1] + p[2]) / 3.0, n), area});
  }
  Fit fit = best_line(lines, nullptr, 1.0);
  for (const double scale : {0.1, 0.05, 0.02, 0.01, 0.01, 0.005, 0.005})
    fit = best_line(lines, &fit, scale);
  glm::dvec3 direction = glm::normalize(fit.first);
  const glm::dvec3 offset = glm::cross(direction, fit.second);
  int largest = 2;
  for (const int i : {1, 0})
    if (std::abs(direction[i]) > std::abs(direction[largest]) + 1e-9) largest = i;
  if (direction[largest] < 0.0) direction = -direction;
  return {middle + size * offset, direction};
}

glm::dmat3 frame_of(const MeshAxis& axis) {
  const glm::dvec3& z = axis.direction;
  const glm::dvec3 near = std::abs(z.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(near - glm::dot(near, z) * z);
  return {x, glm::cross(z, x), z};
}

std::vector<glm::dvec3> about_axis(const solid::TriangleMesh& mesh, const MeshAxis& axis) {
  const glm::dmat3 to_frame = glm::transpose(frame_of(axis));
  std::vector<glm::dvec3> points;
  points.reserve(mesh.points.size());
  for (const glm::dvec3& p : mesh.points) points.push_back(to_frame * (p - axis.through));
  return points;
}

}  // namespace clay::importing
