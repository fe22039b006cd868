#include "export/proof/fan_intersections.hpp"

#include "export/proof/near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <numeric>

namespace clay::solid::inline proof {
namespace {

/// The direction, to a few 2^-53: the difference is rounded once, and scaling prevents overflow.
/// Not finite if the difference is not.
glm::dvec3 direction(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 way = to - from;
  const double most = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
  return glm::normalize(way / most);
}

/// The arc from one direction to another, on the unit sphere. It bulges beyond its chord, but not
/// beyond the tangents at its ends and its middle.
void set_arc(BoundingHull& body, const glm::dvec3& from, const glm::dvec3& to) {
  const double both = glm::length(from + to);
  if (!(both > std::ldexp(1.0, -20))) {
    // Nearly a half turn (or not finite): it may pass anywhere.
    body.corners.fill(glm::dvec3(0.0));
    body.slack = 2.0;
    return;
  }
  const glm::dvec3 middle = (from + to) / both;
  const auto tangents_meet = [&](const glm::dvec3& end) {
    return (end + middle) / (1.0 + glm::dot(end, middle));
  };
  body.corners = {from, to, tangents_meet(from), tangents_meet(to)};
  // The rounding error of the ends, about 2^-51, grows with the scaling of the middle.
  body.slack = std::ldexp(1.0, -46) / both;
}

class Fan {
 public:
  Fan(const TriangleMesh& mesh, const HighValenceVertices& hubs, std::size_t hub, PairSink& sink)
      : mesh_(mesh),
        hubs_(hubs),
        centre_(hubs.vertex(hub)),
        triangles_(hubs.triangles(hub)),
        test_(mesh),
        sink_(sink) {}

  bool run() {
    find_spokes();
    return search_spokes() && search_arcs();
  }

 private:
  /// A triangle on the edge from the centre to a hub.
  struct Leaf {
    std::uint32_t end = 0;
    std::uint32_t apex = 0;
    std::uint32_t triangle = 0;
    int quarter = 0;  ///< result of PairTest::quarter, relative to the first triangle of the book
    friend auto operator<=>(const Leaf&, const Leaf&) = default;
  };

  /// The two corners that are not the centre.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> rim(std::uint32_t triangle) const {
    const Triangle& t = mesh_.triangles[triangle];
    const std::size_t at = t[0] == centre_ ? 0 : t[1] == centre_ ? 1 : 2;
    return {t[(at + 1) % 3], t[(at + 2) % 3]};
  }

  /// Finds edges of many triangles that end in the centre; both their ends are hubs.
  void find_spokes() {
    for (const std::uint32_t t : triangles_) {
      const auto [a, b] = rim(t);
      for (const auto& [end, apex] : {std::pair(a, b), std::pair(b, a)})
        if (hubs_.is_hub(end)) leaves_.push_back({end, apex, t});
    }
    std::sort(leaves_.begin(), leaves_.end());
    for (auto begin = leaves_.begin(); begin != leaves_.end();) {
      const auto end = std::find_if(begin, leaves_.end(),
                                    [&](const Leaf& leaf) { return leaf.end != begin->end; });
      if (static_cast<std::size_t>(end - begin) > kManyTriangles) {
        spokes_.push_back({begin, end});
        spoke_ends_.push_back(begin->end);
      }
      begin = end;
    }
  }

  /// Returns false when the limit is reached.
  bool search_spokes() {
    for (const std::span<Leaf> spoke : spokes_)
      if (spoke.front().end > centre_ && !search_book(spoke)) return false;
    return true;
  }

  /// Triangles on one edge intersect if they lie in one half-plane about it, like pages of a book.
  bool search_book(std::span<Leaf> book) {
    const std::uint32_t end = book.front().end, first = book.front().apex;
    const auto quarter = [&](const Leaf& leaf) {
      return test_.quarter(centre_, end, first, leaf.apex);
    };
    for (Leaf& leaf : book) leaf.quarter = quarter(leaf);
    std::sort(book.begin(), book.end(), [&](const Leaf& a, const Leaf& b) {
      if (a.quarter != b.quarter) return a.quarter < b.quarter;
      return a.quarter % 2 == 1 && test_.quarter(centre_, end, a.apex, b.apex) == 1;
    });
    for (std::size_t begin = 0; begin < book.size();) {
      std::size_t past = begin + 1;
      while (past < book.size() && book[past].quarter == book[begin].quarter &&
             test_.quarter(centre_, end, book[begin].apex, book[past].apex) == 0)
        ++past;
      if (!add_half_plane(book.subspan(begin, past - begin))) return false;
      begin = past;
    }
    return true;
  }

  /// All pairs except those on the same three vertices.
  bool add_half_plane(std::span<Leaf> leaves) {
    if (leaves.size() == 1) return true;
    std::sort(leaves.begin(), leaves.end());  // by apex, then by number
    std::vector<std::vector<std::uint32_t>> by_apex;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (i == 0 || leaves[i].apex != leaves[i - 1].apex) by_apex.emplace_back();
      by_apex.back().push_back(leaves[i].triangle);
    }
    return sink_.add_between(by_apex);
  }

  bool search_arcs() {
    std::vector<BoundingHull> bodies;
    bodies.reserve(triangles_.size());
    for (const std::uint32_t t : triangles_) {
      const auto [a, b] = rim(t);
      BoundingHull& body = bodies.emplace_back();
      const glm::dvec3& centre = mesh_.points[centre_];
      set_arc(body, direction(centre, mesh_.points[a]), direction(centre, mesh_.points[b]));
      body.hubs = {is_spoke(a) ? a : kNoHub, is_spoke(b) ? b : kNoHub, kNoHub};
      body.number = t;
    }
    NearPairs near(std::move(bodies));
    bool more = true;
    near.for_each([&](std::uint32_t i, std::uint32_t j) {
      const std::uint32_t a = near[i].number, b = near[j].number;
      if (share_earlier_hub(a, b)) return true;
      more = !test_.meet(mesh_.triangles[a], mesh_.triangles[b]) || sink_.add(a, b);
      return more;
    });
    return more;
  }

  [[nodiscard]] bool is_spoke(std::uint32_t end) const {
    return std::binary_search(spoke_ends_.begin(), spoke_ends_.end(), end);
  }

  [[nodiscard]] bool share_earlier_hub(std::uint32_t a, std::uint32_t b) const {
    const auto of_a = rim(a), of_b = rim(b);
    const auto shared = [&](std::uint32_t v) {
      return v < centre_ && (v == of_b.first || v == of_b.second) && hubs_.is_hub(v);
    };
    return shared(of_a.first) || shared(of_a.second);
  }

  const TriangleMesh& mesh_;
  const HighValenceVertices& hubs_;
  std::uint32_t centre_;
  std::span<const std::uint32_t> triangles_;
  PairTest test_;
  PairSink& sink_;
  std::vector<Leaf> leaves_;
  std::vector<std::span<Leaf>> spokes_;  ///< of leaves_, by end
  std::vector<std::uint32_t> spoke_ends_;
};

}  // namespace

HighValenceVertices::HighValenceVertices(const TriangleMesh& mesh,
                                         std::span<const std::uint32_t> triangles)
    : is_hub_(mesh.points.size(), false) {
  std::vector<std::uint32_t> degrees(mesh.points.size(), 0);
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : mesh.triangles[t]) ++degrees[v];
  std::size_t end = 0;
  for (std::uint32_t v = 0; v < degrees.size(); ++v) {
    if (degrees[v] <= kManyTriangles) continue;
    is_hub_[v] = true;
    vertices_.push_back(v);
    begins_.push_back(end);
    end += degrees[v];
  }
  begins_.push_back(end);
  if (vertices_.empty()) return;
  triangles_.resize(end);
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  for (std::size_t hub = 0; hub < vertices_.size(); ++hub)
    degrees[vertices_[hub]] = static_cast<std::uint32_t>(hub);
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t v : mesh.triangles[t])
      if (is_hub_[v]) triangles_[next[degrees[v]]++] = t;
}

std::span<const std::uint32_t> HighValenceVertices::triangles(std::size_t hub) const {
  return std::span(triangles_).subspan(begins_[hub], begins_[hub + 1] - begins_[hub]);
}

bool find_crossings_about(const TriangleMesh& mesh, const HighValenceVertices& hubs,
                          std::size_t hub, PairSink& sink) {
  return Fan(mesh, hubs, hub, sink).run();
}

}  // namespace clay::solid::inline proof
