#include "export/repair/duplicate_triangles.hpp"

#include "export/repair/soup_edges.hpp"
#include "export/repair/soup_repair.hpp"
#include "export/solid/disjoint_sets.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <utility>

namespace clay::solid::inline repair {
namespace {

/// Whether the orientation of the corners is that of their sorted numbers.
bool rises(const Triangle& t) { return (t[0] < t[1]) == (t[1] < t[2]) ? t[0] < t[1] : t[2] < t[0]; }

class Duplicates {
 public:
  explicit Duplicates(TriangleMesh& mesh) : mesh_(mesh), drop_(mesh.triangles.size(), false) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      Triangle sorted = mesh.triangles[t];
      std::sort(sorted.begin(), sorted.end());
      sorted_.emplace_back(sorted, t);
    }
    std::sort(sorted_.begin(), sorted_.end());
    for_each_group([&](Group group) { select(group); });
  }

  void run(std::vector<Repair>& repaired) {
    if (doubled_ > 0) keep_faces_of_solids();
    std::size_t number = 0;
    std::erase_if(mesh_.triangles, [&](const Triangle&) { return drop_[number++]; });
    note_repair(repaired, "duplicate triangle removed", doubled_);
    note_repair(repaired, "triangle back to back with another removed", back_to_back_);
  }

 private:
  using Item = std::pair<Triangle, std::uint32_t>;  // sorted vertices, and the triangle
  using Group = std::span<const Item>;              // on the same vertices

  template <class Visit>
  void for_each_group(const Visit& visit) const {
    for (auto begin = sorted_.begin(); begin != sorted_.end();) {
      const auto end = std::find_if(begin, sorted_.end(),
                                    [&](const Item& item) { return item.first != begin->first; });
      if (end - begin > 1) visit(Group(begin, end));
      begin = end;
    }
  }

  [[nodiscard]] bool rising(const Item& item) const { return rises(mesh_.triangles[item.second]); }

  /// Number of rising triangles minus the number of falling ones.
  [[nodiscard]] std::ptrdiff_t excess(Group group) const {
    const auto up = std::ranges::count_if(group, [&](const Item& item) { return rising(item); });
    return 2 * up - std::ssize(group);
  }

  /// Keeps the first triangle of the orientation that prevails.
  void select(Group group) {
    const std::ptrdiff_t more = excess(group);
    const auto keep = more == 0 ? group.end() : std::ranges::find_if(group, [&](const Item& item) {
      return rising(item) == (more > 0);
    });
    for (auto item = group.begin(); item != group.end(); ++item) drop_[item->second] = item != keep;
    (more == 0 ? back_to_back_ : doubled_) += group.size() - (more == 0 ? 0 : 1);
  }

  /// The dropped triangles of faces without which a closed surface would be open; all triangles of
  /// such a face share edges. Empty: there are none.
  std::vector<bool> dropped_of_solids() {
    DisjointSets faces(mesh_.triangles.size());
    std::vector<std::uint32_t> opened;
    for_each_edge(mesh_, [&](std::span<const SoupEdge> edges) {
      int all = 0, kept = 0;
      const SoupEdge* dropped = nullptr;
      for (const SoupEdge& edge : edges) {
        const int way = direction(mesh_, edge);
        all += way;
        if (!drop_[edge.triangle]) {
          kept += way;
          continue;
        }
        if (dropped != nullptr) faces.unite(dropped->triangle, edge.triangle);
        dropped = &edge;
      }
      if (all == 0 && kept != 0) opened.push_back(dropped->triangle);
    });
    if (opened.empty()) return {};
    std::vector<bool> open_face(mesh_.triangles.size(), false), found = drop_;
    for (const std::uint32_t t : opened) open_face[faces.of(t)] = true;
    for (std::uint32_t t = 0; t < found.size(); ++t) found[t] = found[t] && open_face[faces.of(t)];
    return found;
  }

  /// Keeps as many triangles of these faces as the excess of the prevailing orientation.
  void keep_faces_of_solids() {
    const std::vector<bool> of_solid = dropped_of_solids();
    if (of_solid.empty()) return;
    for_each_group([&](Group group) {
      const std::ptrdiff_t more = excess(group);
      std::ptrdiff_t left = std::abs(more) - 1;
      for (const Item& item : group) {
        if (left <= 0 || !of_solid[item.second] || rising(item) != (more > 0)) continue;
        drop_[item.second] = false;
        --left;
        --doubled_;
      }
    });
  }

  TriangleMesh& mesh_;
  std::vector<Item> sorted_;
  std::vector<bool> drop_;  ///< by triangle
  std::size_t doubled_ = 0, back_to_back_ = 0;
};

}  // namespace

void drop_duplicates(TriangleMesh& mesh, std::vector<Repair>& repaired) {
  Duplicates(mesh).run(repaired);
}

}  // namespace clay::solid::inline repair
