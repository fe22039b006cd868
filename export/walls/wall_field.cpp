#include "claystack/export/walls.hpp"
#include "export/walls/part_names.hpp"
#include "export/walls/wall_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace clay::solid::inline walls {
namespace {

/// Labels the edges of a polygon. Counterclockwise, the outer wall runs from the outermost of the
/// lowest vertices to the outermost of the highest.
class FaceNames {
 public:
  explicit FaceNames(const Polygon& polygon)
      : count_(polygon.size()), bore_(polygon.size(), WallFace::bore) {
    const auto higher = [](const ProfilePoint& a, const ProfilePoint& b) {
      return a.y != b.y ? a.y < b.y : a.rho < b.rho;
    };
    const auto lower = [](const ProfilePoint& a, const ProfilePoint& b) {
      return a.y != b.y ? a.y > b.y : a.rho < b.rho;
    };
    const auto foot = std::max_element(polygon.begin(), polygon.end(), lower);
    const auto rim = std::max_element(polygon.begin(), polygon.end(), higher);
    foot_ = static_cast<std::size_t>(foot - polygon.begin());
    rim_ = static_cast<std::size_t>(rim - polygon.begin());
    low_ = foot->y, high_ = rim->y;
    name_floors_and_lids(polygon);
  }

  [[nodiscard]] WallFace of(const Edge& edge, std::size_t vertex) const {
    if (edge.from.y == low_ && edge.to.y == low_) return WallFace::foot;
    if (edge.from.y == high_ && edge.to.y == high_) return WallFace::rim;
    if ((vertex + count_ - foot_) % count_ < (rim_ + count_ - foot_) % count_)
      return WallFace::outer;
    return bore_[vertex];
  }

 private:
  /// Edges within 45 degrees of level, from the axis on: the inside of a rim may face up, too.
  void name_floors_and_lids(const Polygon& polygon) {
    const auto next = [&](std::size_t i) { return i + 1 == count_ ? 0 : i + 1; };
    const auto before = [&](std::size_t i) { return i == 0 ? count_ - 1 : i - 1; };
    /// Towards the axis above clay, or away from it below clay.
    const auto level = [&](std::size_t i, double sign) {
      const double across = sign * (polygon[next(i)].rho - polygon[i].rho);
      return across > std::abs(polygon[next(i)].y - polygon[i].y);
    };
    for (std::size_t i = 0; i < count_; ++i) {
      if (polygon[i].rho > 0.0) continue;
      for (std::size_t k = before(i); level(k, -1.0); k = before(k)) bore_[k] = WallFace::floor;
      for (std::size_t k = i; level(k, 1.0); k = next(k)) bore_[k] = WallFace::lid;
    }
  }

  std::size_t count_, foot_ = 0, rim_ = 0;
  double low_ = 0.0, high_ = 0.0;
  std::vector<WallFace> bore_;  ///< by edge, as if all were of the bore
};

ProfilePoint place(const Vec2& v) { return {v.x, v.y}; }

class Field {
 public:
  Field(const Profile& profile, double spacing_mm)
      : profile_(profile), tree_(profile, 1.0), spacing_mm_(spacing_mm) {}

  std::vector<WallSample> run() {
    stride_ = (sample_count() - 1) / kMaxWallSamples + 1;
    std::size_t node = 0;
    for (std::uint32_t piece = 0; piece < tree_.piece_count(); ++piece) {
      const AxisClay axis(tree_, piece);
      const Names names{FaceNames(profile_.pieces[piece]), PartNames(tree_, piece)};
      arc_mm_ = 0.0;
      for (; node < tree_.nodes().size(); ++node) {
        const EdgeNode& leaf = tree_.nodes()[node];
        if (leaf.leaves > 1) continue;
        if (leaf.first_piece != piece) break;
        for (const Face& face : LeafFaces(tree_, leaf)) add_samples(face, axis, names);
      }
      fill_ends();
    }
    return std::move(samples_);
  }

 private:
  struct Names {
    FaceNames face;
    PartNames part;
  };

  [[nodiscard]] std::size_t parts(const Edge& edge) const {
    const double count = std::ceil(glm::length(edge.to - edge.from) / spacing_mm_);
    return static_cast<std::size_t>(std::clamp(count, 1.0, kMostParts));
  }

  [[nodiscard]] std::size_t sample_count() const {
    std::size_t count = 0;
    for (std::uint32_t piece = 0; piece < tree_.piece_count(); ++piece)
      for (std::size_t i = 0; i < profile_.pieces[piece].size(); ++i) {
        const Edge edge =
            tree_.edge(tree_.first_edge(piece) + static_cast<std::uint32_t>(i), piece);
        if (!edge.on_axis()) count += parts(edge);
      }
    return std::max<std::size_t>(count, 1);
  }

  void add_samples(const Face& face, const AxisClay& axis, const Names& names) {
    const Vec2 along = face.edge.to - face.edge.from;
    const std::size_t count = parts(face.edge);
    const std::size_t past = met_ % stride_;  // samples since the last that was kept
    for (std::size_t k = past == 0 ? 0 : stride_ - past; k < count; k += stride_) {
      const double t = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
      add_sample(face, t, axis, names.part);
      samples_.back().arc_mm = arc_mm_ + t * glm::length(along);
      samples_.back().face =
          names.face.of(face.edge, face.edge.index - tree_.first_edge(face.piece));
    }
    met_ += count;
    arc_mm_ += glm::length(along);
  }

  /// A sample at an end of a wall, where a smaller ball has too little boundary, gets the thickness
  /// of the nearest sample of its piece that is not at an end.
  void fill_ends() {
    const std::size_t end = samples_.size(), none = end;
    std::vector<std::size_t> below(end - piece_begin_, none);
    for (std::size_t i = piece_begin_, last = none; i < end; ++i)
      below[i - piece_begin_] = last = at_end_[i] ? last : i;
    for (std::size_t i = end, above = none; i-- > piece_begin_;) {
      if (!at_end_[i]) above = i;
      const std::size_t low = below[i - piece_begin_];
      if (!at_end_[i] || (low == none && above == none)) continue;
      const auto distance = [&](std::size_t j) {
        return j == none ? std::numeric_limits<double>::infinity()
                         : std::abs(samples_[j].arc_mm - samples_[i].arc_mm);
      };
      const WallSample& nearest = samples_[distance(low) <= distance(above) ? low : above];
      samples_[i].thickness_mm = nearest.thickness_mm;
      samples_[i].opposite = nearest.opposite;
      samples_[i].part = nearest.part;
    }
    piece_begin_ = end;
  }

  void add_sample(const Face& face, double t, const AxisClay& axis, const PartNames& parts) {
    const Ball ball = PlaceSearch(tree_, face, t).run(axis);
    at_end_.push_back(ball.excluded < ball.diameter);
    const Vec2 at = face.edge.from + t * (face.edge.to - face.edge.from);
    const bool found = std::isfinite(ball.diameter);
    samples_.push_back({ball.diameter, place(at), place(found ? ball.to : at), 0.0, face.piece});
    const double from_arc = face.arc_begin + t * (face.arc_end - face.arc_begin);
    if (found && ball.to_arc >= 0.0)
      samples_.back().part = parts.of(from_arc, ball.to_arc, ball.diameter);
  }

  static constexpr double kMostParts = 1e9;  // of one edge: keeps the total count exact

  const Profile& profile_;
  EdgeTree tree_;
  double spacing_mm_;
  std::size_t stride_ = 1, met_ = 0;
  double arc_mm_ = 0.0;
  std::vector<WallSample> samples_;
  std::vector<bool> at_end_;     ///< of each sample
  std::size_t piece_begin_ = 0;  ///< the first sample of the present piece
};

}  // namespace

std::vector<WallSample> wall_field(const Profile& profile, double spacing_mm) {
  return Field(profile, spacing_mm).run();
}

}  // namespace clay::solid::inline walls
