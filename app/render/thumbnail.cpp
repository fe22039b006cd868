#include "app/render/thumbnail.hpp"

#include "app/render/circle.hpp"
#include "core/colour_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <vector>

namespace clay::render {
namespace {

constexpr int kPerSide = 2;           // samples of a pixel along each side
constexpr std::size_t kSectors = 64;  // around the axis
constexpr std::size_t kMostRows = 80;
constexpr glm::vec3 kClay{0.56F, 0.27F, 0.16F}, kGround{0.92F, 0.905F, 0.87F};  // linear

/// A stretch of a section, revolved: a wall, a floor or a rim. The light reaches `open` of it.
struct Band {
  glm::dvec2 from, to;  ///< (rho, y)
  glm::vec2 open{1.0F};
  double side = 1.0;                    ///< of the clay: left of the way, or right (-1)
  std::array<glm::dvec2, 2> normals{};  ///< at both ends, away from the clay
};

/// Normals at the ends of bands; the mean where a wall continues without an edge.
void smooth(std::vector<Band>& bands) {
  constexpr double kEdge = 0.8;  // cosine
  const auto normal = [](const Band& band) {
    const glm::dvec2 along = band.to - band.from;
    const double length = glm::length(along);
    return length > 0.0 ? band.side / length * glm::dvec2(along.y, -along.x) : glm::dvec2(0.0);
  };
  for (Band& band : bands) band.normals = {normal(band), normal(band)};
  for (std::size_t i = 1; i < bands.size(); ++i) {
    const glm::dvec2 before = normal(bands[i - 1]), after = normal(bands[i]);
    if (bands[i - 1].to != bands[i].from || glm::dot(before, after) < kEdge) continue;
    bands[i - 1].normals[1] = bands[i].normals[0] = glm::normalize(before + after);
  }
}

/// Share of the sky that is visible in a bore at a depth below its mouth.
float open_at(double depth_mm, double radius_mm) {
  return static_cast<float>(1.0 / (1.0 + 0.6 * depth_mm / std::max(radius_mm, 1e-3)));
}

/// The faces of the rows from `begin` to `end`.
class Part {
 public:
  Part(const PotView& pot, std::size_t begin, std::size_t end)
      : pot_(pot), end_(end), row_mm_(pot.height_mm / static_cast<double>(pot.rows.size())) {
    const std::size_t step = 1 + (end - begin) / kMostRows;
    for (std::size_t row = begin; row < end; row += step) rows_.push_back(row);
    if (rows_.back() + 1 != end) rows_.push_back(end - 1);
    walls();
    for (std::size_t i = 0; i < rows_.size();) i = hollow(i) ? bore(i) : i + 1;
    smooth(bands_);
  }

  [[nodiscard]] const std::vector<Band>& bands() const { return bands_; }

 private:
  [[nodiscard]] const Row& row(std::size_t i) const { return pot_.rows[rows_[i]]; }
  [[nodiscard]] bool hollow(std::size_t i) const { return row(i).inner_mm > 0.0F; }
  [[nodiscard]] double foot(std::size_t i) const { return row_mm_ * static_cast<double>(rows_[i]); }
  [[nodiscard]] double top(std::size_t i) const {
    return row_mm_ * static_cast<double>(i + 1 < rows_.size() ? rows_[i + 1] : end_);
  }
  [[nodiscard]] double middle(std::size_t i) const { return 0.5 * (foot(i) + top(i)); }
  [[nodiscard]] glm::dvec2 outer(std::size_t i, double y) const { return {row(i).outer_mm, y}; }
  [[nodiscard]] glm::dvec2 inner(std::size_t i, double y) const { return {row(i).inner_mm, y}; }

  void walls() {
    const std::size_t last = rows_.size() - 1;
    glm::dvec2 at = outer(0, foot(0));
    bands_.push_back({{row(0).inner_mm, foot(0)}, at});
    for (std::size_t i = 0; i <= last; ++i) {
      const glm::dvec2 next = outer(i, middle(i));
      bands_.push_back({at, next});
      at = next;
    }
    bands_.push_back({at, outer(last, top(last))});
    bands_.push_back({outer(last, top(last)), {row(last).inner_mm, top(last)}});
  }

  /// A run of rows with a bore, from `first` on; returns the row after it. Where rows follow, they
  /// are its floor and its lid.
  std::size_t bore(std::size_t first) {
    std::size_t last = first;
    while (last + 1 < rows_.size() && hollow(last + 1)) ++last;
    const double mouth = top(last);
    const auto add = [&](glm::dvec2 from, glm::dvec2 to) {
      const double radius = std::max(from.x, to.x);
      bands_.push_back(
          {from, to, {open_at(mouth - from.y, radius), open_at(mouth - to.y, radius)}, -1.0});
    };
    if (first > 0) add({0.0, foot(first)}, inner(first, foot(first)));
    glm::dvec2 at = inner(first, foot(first));
    for (std::size_t i = first; i <= last; ++i) {
      const glm::dvec2 next = inner(i, middle(i));
      add(at, next);
      at = next;
    }
    add(at, inner(last, mouth));
    if (last + 1 < rows_.size()) add(inner(last, mouth), {0.0, mouth});
    return last + 1;
  }

  const PotView& pot_;
  std::size_t end_;
  double row_mm_;
  std::vector<std::size_t> rows_;
  std::vector<Band> bands_;
};

struct Corner {
  glm::dvec3 at;  ///< in samples, and depth
  float light = 0.0F;
};

/// Samples with depth; triangles that appear clockwise are back faces, which others hide.
class Samples {
 public:
  explicit Samples(int side)
      : side_(side),
        depth_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
               std::numeric_limits<float>::infinity()),
        light_(depth_.size(), -1.0F) {}

  void draw(const Corner& a, const Corner& b, const Corner& c) {
    const double area = cross(b.at - a.at, c.at - a.at);
    if (!(area > 1e-12)) return;
    const auto [left, right] = reach(a.at.x, b.at.x, c.at.x);
    const auto [upper, lower] = reach(a.at.y, b.at.y, c.at.y);
    for (int y = upper; y <= lower; ++y)
      for (int x = left; x <= right; ++x) {
        const glm::dvec3 p(x + 0.5, y + 0.5, 0.0);
        const double of_a = cross(c.at - b.at, p - b.at), of_b = cross(a.at - c.at, p - c.at);
        if (of_a < 0.0 || of_b < 0.0) continue;  // most samples: before the quotients
        const double u = of_a / area, v = of_b / area, w = 1.0 - u - v;
        if (w < 0.0) continue;
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                       static_cast<std::size_t>(x);
        const auto depth = static_cast<float>(u * a.at.z + v * b.at.z + w * c.at.z);
        if (depth >= depth_[i]) continue;
        depth_[i] = depth;
        light_[i] =
            static_cast<float>(u * double{a.light} + v * double{b.light} + w * double{c.light});
      }
  }

  /// The light at a sample; below 0: the ground.
  [[nodiscard]] float light(int x, int y) const {
    return light_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                  static_cast<std::size_t>(x)];
  }

 private:
  static double cross(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.y - a.y * b.x; }

  /// The samples between the least and the largest coordinate.
  [[nodiscard]] std::array<int, 2> reach(double a, double b, double c) const {
    const double most = side_ - 1;
    return {static_cast<int>(std::ceil(std::clamp(std::min({a, b, c}) - 0.5, 0.0, most))),
            static_cast<int>(std::floor(std::clamp(std::max({a, b, c}) - 0.5, -1.0, most)))};
  }

  int side_;
  std::vector<float> depth_, light_;
};

/// One lamp from the upper left, and light of the sky.
float light_on(const glm::dvec3& normal, float open) {
  static const glm::dvec3 kLamp = glm::normalize(glm::dvec3(-0.62, 0.74, 0.52));
  const double lamp = std::max(0.0, glm::dot(normal, kLamp)), sky = 0.5 + 0.5 * normal.y;
  return open * static_cast<float>(0.16 + 0.42 * sky + 0.85 * lamp);
}

class Drawing {
 public:
  Drawing(const Camera& camera, int side)
      : view_(view_matrix(camera)),
        whole_(projection_matrix(camera, 1.0)),
        side_(side),
        samples_(side) {
    for (const glm::dvec2& d : directions_around(kSectors)) directions_.emplace_back(d.y, d.x);
    directions_.push_back(directions_.front());
  }

  void add(const Band& band, const glm::dmat4& place) {
    if (band.from == band.to) return;
    std::array<Corner, 2> last{};
    for (std::size_t k = 0; k <= kSectors; ++k) {
      const glm::dvec2 d = directions_[k];
      const std::array<Corner, 2> next{corner(band.from, d, band.normals[0], band.open[0], place),
                                       corner(band.to, d, band.normals[1], band.open[1], place)};
      if (k > 0) {
        const bool left = band.side > 0.0;
        samples_.draw(last[0], left ? last[1] : next[1], left ? next[1] : last[1]);
        samples_.draw(last[0], left ? next[1] : next[0], left ? next[0] : next[1]);
      }
      last = next;
    }
  }

  [[nodiscard]] const Samples& samples() const { return samples_; }

 private:
  [[nodiscard]] Corner corner(const glm::dvec2& point, const glm::dvec2& direction,
                              const glm::dvec2& normal, float open, const glm::dmat4& place) const {
    const glm::dvec4 at =
        view_ * (place * glm::dvec4(point.x * direction.x, point.y, point.x * direction.y, 1.0));
    const glm::dvec4 across(normal.x * direction.x, normal.y, normal.x * direction.y, 0.0);
    const glm::dvec3 seen(view_ * (place * across));
    const glm::dvec4 clip = whole_ * at;
    const glm::dvec3 shown = glm::dvec3(clip) / clip.w;
    return {{0.5 * side_ * (1.0 + shown.x), 0.5 * side_ * (1.0 - shown.y), shown.z},
            light_on(seen, open)};
  }

  glm::dmat4 view_, whole_;
  int side_;
  std::vector<glm::dvec2> directions_;
  Samples samples_;
};

Image pixels_of(const Samples& samples, int side_px) {
  constexpr float kSteps = 4095.0F;
  std::vector<std::uint8_t> bytes;
  for (float step = 0.0F; step <= kSteps; ++step) bytes.push_back(srgb_byte(step / kSteps));
  Image image{side_px, side_px, {}};
  image.rgba.reserve(4 * static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px));
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x) {
      glm::vec3 sum(0.0F);
      for (int i = 0; i < kPerSide * kPerSide; ++i) {
        const float light = samples.light(kPerSide * x + i % kPerSide, kPerSide * y + i / kPerSide);
        sum += light < 0.0F ? kGround : glm::min(kClay * light, glm::vec3(1.0F));
      }
      sum /= static_cast<float>(kPerSide * kPerSide);
      for (int c = 0; c < 3; ++c)
        image.rgba.push_back(bytes[static_cast<std::size_t>(sum[c] * kSteps + 0.5F)]);
      image.rgba.push_back(255);
    }
  return image;
}

}  // namespace

Image thumbnail(const PotView& pot, int side_px) {
  Drawing drawing(framed(pot, 1.0), kPerSide * side_px);
  if (!pot.rows.empty()) {
    const std::size_t split =
        pot.fallen ? std::min(pot.fallen->first_row, pot.rows.size()) : pot.rows.size();
    const auto add = [&](std::size_t begin, std::size_t end, const glm::dmat4& place) {
      if (begin == end) return;
      const Part part(pot, begin, end);
      for (const Band& band : part.bands()) drawing.add(band, place);
    };
    add(0, split, glm::dmat4(1.0));
    if (pot.fallen) add(split, pot.rows.size(), pot.fallen->place);
  }
  return pixels_of(drawing.samples(), side_px);
}

}  // namespace clay::render
