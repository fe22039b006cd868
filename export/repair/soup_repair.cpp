#include "export/repair/soup_repair.hpp"

#include "export/solid/mesh_topology.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <tuple>

namespace clay::solid::inline repair {
namespace {

std::uint32_t narrow(std::size_t n) { return static_cast<std::uint32_t>(n); }

bool collapsed(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

bool finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void drop_unusable(TriangleMesh& mesh, std::vector<Repair>& repaired) {
  const auto no_place = [&](std::uint32_t v) {
    return v >= mesh.points.size() || !finite(mesh.points[v]);
  };
  note_repair(repaired, "triangle without a place removed",
              std::erase_if(mesh.triangles, [&](const Triangle& t) {
                return std::any_of(t.begin(), t.end(), no_place);
              }));
}

/// Replaces vertices in all triangles.
void renumber(TriangleMesh& mesh, const std::vector<std::uint32_t>& number) {
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = number[v];
}

/// Requires finite points.
void merge_equal_points(TriangleMesh& mesh, std::vector<Repair>& repaired) {
  const auto place = [&](std::uint32_t v) {
    const glm::dvec3& p = mesh.points[v];
    return std::tuple(p.x, p.y, p.z, v);
  };
  std::vector<std::uint32_t> order(mesh.points.size()), number(mesh.points.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  std::size_t merged = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && mesh.points[order[i]] == mesh.points[order[i - 1]];
    number[order[i]] = same ? number[order[i - 1]] : order[i];
    merged += same ? 1 : 0;
  }
  renumber(mesh, number);
  note_repair(repaired, "points of one place merged", merged);
}

void drop_collapsed(TriangleMesh& mesh, std::vector<Repair>& repaired) {
  note_repair(repaired, "triangle without area removed", std::erase_if(mesh.triangles, collapsed));
}

struct Edge {
  std::uint32_t low, high, triangle;
  friend auto operator<=>(const Edge&, const Edge&) = default;
  [[nodiscard]] bool same_place(const Edge& other) const {
    return low == other.low && high == other.high;
  }
};

/// Calls visit(edges) for each edge of the mesh: one entry per triangle, in ascending order.
template <class Visit>
void for_each_edge(const TriangleMesh& mesh, const Visit& visit) {
  std::vector<Edge> all;
  all.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (collapsed(mesh.triangles[t])) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(mesh.triangles[t][c], mesh.triangles[t][(c + 1) % 3]);
      all.push_back({low, high, narrow(t)});
    }
  }
  std::sort(all.begin(), all.end());
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end =
        std::find_if(begin, all.end(), [&](const Edge& edge) { return !edge.same_place(*begin); });
    visit(std::span<const Edge>(begin, end));
    begin = end;
  }
}

/// Border points in cells as wide as a crack. Only the first point of a cell is stored, so no file
/// can make the search slow.
class CrackCells {
 public:
  CrackCells(const std::vector<glm::dvec3>& points, double crack_mm)
      : points_(points), crack_mm_(crack_mm) {}

  /// An earlier point within a crack's width; otherwise this one, which is stored.
  std::uint32_t first_near(std::uint32_t vertex) {
    const Cell home = cell_of(points_[vertex]);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto found = first_.find({home[0] + x, home[1] + y, home[2] + z});
          if (found != first_.end() && near(found->second, vertex)) return found->second;
        }
    first_.emplace(home, vertex);
    return vertex;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell_of(const glm::dvec3& p) const {
    const auto cell = [&](double x) {
      return static_cast<std::int64_t>(std::floor(x / crack_mm_));
    };
    return {cell(p.x), cell(p.y), cell(p.z)};
  }
  bool near(std::uint32_t a, std::uint32_t b) const {
    return glm::distance(points_[a], points_[b]) <= crack_mm_;
  }

  const std::vector<glm::dvec3>& points_;
  double crack_mm_;
  std::map<Cell, std::uint32_t> first_;
};

double largest_coordinate(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::abs(mesh.points[v][axis]));
  return largest;
}

void weld_cracks(TriangleMesh& mesh, std::vector<Repair>& repaired) {
  std::vector<bool> border(mesh.points.size(), false);
  for_each_edge(mesh, [&](std::span<const Edge> edges) {
    if (edges.size() == 1) border[edges[0].low] = border[edges[0].high] = true;
  });
  const double crack_mm = 4.0 * std::numeric_limits<float>::epsilon() * largest_coordinate(mesh);
  CrackCells cells(mesh.points, crack_mm);
  std::vector<std::uint32_t> number(mesh.points.size());
  std::size_t welded = 0;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    number[v] = border[v] ? cells.first_near(v) : v;
    welded += number[v] == v ? 0 : 1;
  }
  renumber(mesh, number);
  note_repair(repaired, "points welded across a crack", welded);
}

/// Whether the orientation of the corners is that of their sorted numbers.
bool rises(const Triangle& t) { return (t[0] < t[1]) == (t[1] < t[2]) ? t[0] < t[1] : t[2] < t[0]; }

/// Of triangles on the same vertices one is kept if one orientation prevails; if both are equally
/// frequent they lie back to back, and none is kept.
void drop_duplicates(TriangleMesh& mesh, std::vector<Repair>& repaired) {
  const auto key = [&](std::uint32_t t) {
    Triangle sorted = mesh.triangles[t];
    std::sort(sorted.begin(), sorted.end());
    return std::pair(sorted, t);
  };
  std::vector<std::pair<Triangle, std::uint32_t>> all;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) all.push_back(key(t));
  std::sort(all.begin(), all.end());
  std::vector<bool> drop(mesh.triangles.size(), false);
  std::size_t doubled = 0, back_to_back = 0;
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end = std::find_if(begin, all.end(),
                                  [&](const auto& item) { return item.first != begin->first; });
    const auto turns = [&](const auto& item) { return rises(mesh.triangles[item.second]); };
    const std::ptrdiff_t rising = std::count_if(begin, end, turns), size = end - begin;
    const bool cancel = 2 * rising == size;
    const auto keep = cancel ? end : std::find_if(begin, end, [&](const auto& item) {
      return turns(item) == (2 * rising > size);
    });
    for (auto item = begin; item != end; ++item) drop[item->second] = item != keep;
    (cancel ? back_to_back : doubled) += static_cast<std::size_t>(cancel ? size : size - 1);
    begin = end;
  }
  std::size_t number = 0;
  std::erase_if(mesh.triangles, [&](const Triangle&) { return drop[number++]; });
  note_repair(repaired, "duplicate triangle removed", doubled);
  note_repair(repaired, "triangle back to back with another removed", back_to_back);
}

/// Triangles joined by edges of two triangles, as sets named by their smallest triangle.
class Sheets {
 public:
  explicit Sheets(const TriangleMesh& mesh)
      : parent_(mesh.triangles.size()), open_(mesh.triangles.size(), false) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    for_each_edge(mesh, [&](std::span<const Edge> edges) {
      if (edges.size() == 2) unite(edges[0].triangle, edges[1].triangle);
    });
    for_each_edge(mesh, [&](std::span<const Edge> edges) {
      if (edges.size() == 1) open_[of(edges[0].triangle)] = true;
    });
  }
  std::uint32_t of(std::uint32_t t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }
  bool open(std::uint32_t sheet) const { return open_[sheet]; }

 private:
  void unite(std::uint32_t a, std::uint32_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::uint32_t> parent_;
  std::vector<bool> open_;
};

/// A fin is the only open sheet at an edge of three triangles; the other two continue the surface.
std::size_t drop_fins_once(TriangleMesh& mesh) {
  Sheets sheets(mesh);
  std::vector<bool> fin(mesh.triangles.size(), false);  // by sheet
  for_each_edge(mesh, [&](std::span<const Edge> edges) {
    if (edges.size() != 3) return;
    std::array<std::uint32_t, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = sheets.of(edges[i].triangle);
    std::vector<std::uint32_t> ends_here;
    for (const std::uint32_t sheet : at)
      if (sheets.open(sheet) && std::count(at.begin(), at.end(), sheet) == 1)
        ends_here.push_back(sheet);
    if (ends_here.size() == 1) fin[ends_here.front()] = true;
  });
  std::uint32_t number = 0;
  return std::erase_if(mesh.triangles, [&](const Triangle&) { return fin[sheets.of(number++)]; });
}

void drop_fins(TriangleMesh& mesh, std::vector<Repair>& repaired) {
  // A fin may stand on another fin.
  constexpr int kMostRounds = 8;
  std::size_t dropped = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    const std::size_t now = drop_fins_once(mesh);
    if (now == 0) break;
    dropped += now;
  }
  note_repair(repaired, "triangle of a fin removed", dropped);
}

}  // namespace

void note_repair(std::vector<Repair>& repaired, std::string_view what, std::size_t count) {
  if (count == 0) return;
  const auto known = std::find_if(repaired.begin(), repaired.end(),
                                  [&](const Repair& repair) { return repair.what == what; });
  if (known == repaired.end())
    repaired.push_back({std::string(what), count});
  else
    known->count += count;
}

void clean_soup(TriangleMesh& mesh, std::vector<Repair>& repaired) {
  drop_unusable(mesh, repaired);
  drop_unused_points(mesh);
  merge_equal_points(mesh, repaired);
  weld_cracks(mesh, repaired);
  drop_collapsed(mesh, repaired);
  drop_duplicates(mesh, repaired);
  drop_fins(mesh, repaired);
  drop_unused_points(mesh);
}

}  // namespace clay::solid::inline repair
