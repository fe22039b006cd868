#include "export/formats/shaded_obj.hpp"

#include "core/cancel.hpp"
#include "export/formats/file_floats.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace clay::solid::inline formats {
namespace {

const double kSharpestSmoothBend = std::sqrt(3.0) / 2.0;  // cos(30 degrees)

/// The normal in the half-plane that points out of the clay, which lies to the left of the band.
glm::dvec2 outward(const Shell& shell, const Band& band) {
  const ProfilePoint &from = shell.points[band.from], &to = shell.points[band.to];
  return glm::normalize(glm::dvec2(to.y - from.y, from.rho - to.rho));
}

/// Normals of a shell in the half-plane, and those at the two ends of each band.
struct Normals {
  std::vector<glm::dvec2> all;
  std::vector<std::array<std::size_t, 2>> of_band;  ///< at start and end of the band

  explicit Normals(const Shell& shell) : of_band(shell.bands.size()) {
    std::vector<std::size_t> into(shell.points.size(), kNone), out(shell.points.size(), kNone);
    for (std::size_t b = 0; b < shell.bands.size(); ++b) {
      into[shell.bands[b].to] = b;
      out[shell.bands[b].from] = b;
    }
    for (std::size_t i = 0; i < shell.points.size(); ++i) {
      const bool both = into[i] != kNone && out[i] != kNone;
      const glm::dvec2 a = into[i] == kNone ? glm::dvec2(0) : outward(shell, shell.bands[into[i]]);
      const glm::dvec2 b = out[i] == kNone ? glm::dvec2(0) : outward(shell, shell.bands[out[i]]);
      const bool smooth = both && glm::dot(a, b) > kSharpestSmoothBend;
      if (into[i] != kNone) of_band[into[i]][1] = add(smooth ? glm::normalize(a + b) : a);
      if (out[i] != kNone) of_band[out[i]][0] = smooth ? all.size() - 1 : add(b);
    }
  }

 private:
  static constexpr std::size_t kNone = SIZE_MAX;
  std::size_t add(const glm::dvec2& normal) {
    all.push_back(normal);
    return all.size() - 1;
  }
};

class ShadedObj {
 public:
  ShadedObj(const RevolveLayout& rule, const TriangleMesh& mesh) : rule_(rule), mesh_(mesh) {}

  std::string encode(std::string_view object_name) {
    text_.append("# claystack: units mm\no ").append(one_line(object_name)).append("\n");
    for (const glm::dvec3& point : mesh_.points) {
      step_of_loop();
      append_point_line(text_, "v", file_point(point));
    }
    for (const Shell& shell : rule_.shells()) append_normals(normals_.emplace_back(shell));
    std::size_t first = 1;
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      append_faces(rule_.shells()[i], normals_[i], first);
      first += normals_[i].all.size() * rule_.segments();
    }
    return std::move(text_);
  }

 private:
  void append_normals(const Normals& normals) {
    for (const glm::dvec2& n : normals.all)
      for (const glm::dvec2& d : rule_.circle()) {
        step_of_loop();
        const glm::dvec2 radial = n.x * glm::normalize(d);
        append_point_line(text_, "vn", file_point({radial.x, radial.y, n.y}));
      }
  }

  /// In the order of RevolveLayout, which is that of the mesh.
  void append_faces(const Shell& shell, const Normals& normals, std::size_t first) {
    const std::size_t n = rule_.segments();
    const auto at = [&](std::size_t normal, std::size_t s) { return first + normal * n + s; };
    for (std::size_t s = 0; s < n; ++s) {
      const std::size_t next = s + 1 < n ? s + 1 : 0;
      for (std::size_t b = 0; b < shell.bands.size(); ++b) {
        const auto [from, to] = normals.of_band[b];
        if (!shell.pole(shell.bands[b].from)) append_face({at(from, s), at(from, next), at(to, s)});
        if (!shell.pole(shell.bands[b].to)) append_face({at(from, next), at(to, next), at(to, s)});
      }
    }
  }

  void append_face(const std::array<std::size_t, 3>& normals) {
    step_of_loop();
    const auto& triangle = mesh_.triangles[face_++];
    text_ += 'f';
    for (std::size_t c = 0; c < 3; ++c) {
      text_ += ' ';
      append_number(text_, triangle[c] + 1);
      text_ += "//";
      append_number(text_, normals[c]);
    }
    text_ += '\n';
  }

  const RevolveLayout& rule_;
  const TriangleMesh& mesh_;
  std::vector<Normals> normals_;
  std::size_t face_ = 0;
  std::string text_;
};

}  // namespace

std::string encode_shaded_obj(const RevolveLayout& rule, const TriangleMesh& mesh,
                              std::string_view object_name) {
  return ShadedObj(rule, mesh).encode(object_name);
}

}  // namespace clay::solid::inline formats
