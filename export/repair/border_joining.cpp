#include "export/repair/border_joining.hpp"

#include "core/cancel.hpp"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <iterator>
#include <map>
#include <vector>

namespace clay::solid::inline repair {
namespace {

/// Walks along one border. Where it meets a place again, the edges between become a separate
/// border; each place is looked up once, so that long borders are fast.
class BorderWalk {
 public:
  BorderWalk(Surface& surface, Surface::Halfedge_index start)
      : surface_(surface),
        start_(start),
        edges_left_(surface.halfedges_around_face(start).size()) {}

  std::size_t run() {
    std::size_t joined = 0;
    auto h = start_;
    do {
      step_of_loop();
      const auto next = surface_.next(h);
      const auto met = at_.find(surface_.point(surface_.target(h)));
      if (met != at_.end() && may_join(met->second, h)) {
        join(way_[met->second], h);
        edges_left_ -= way_.size() - met->second;
        go_back_to(met->second);
        ++joined;
      } else {
        at_.insert_or_assign(surface_.point(surface_.target(h)), way_.size());
        way_.push_back(h);
      }
      h = next;
    } while (h != start_);
    return joined;
  }

 private:
  /// Both borders are wide enough to be filled, and no edge becomes double.
  [[nodiscard]] bool may_join(std::size_t met, Surface::Halfedge_index h) const {
    const std::size_t between = way_.size() - met;
    if (between < 3 || edges_left_ < between + 3) return false;
    const auto kept = surface_.target(way_[met]);
    if (kept == surface_.target(h)) return false;
    for (const auto around : surface_.halfedges_around_target(h))
      if (surface_.halfedge(kept, surface_.source(around)).is_valid()) return false;
    return true;
  }

  void join(Surface::Halfedge_index earlier, Surface::Halfedge_index later) {
    const auto kept = surface_.target(earlier), dropped = surface_.target(later);
    const auto after_earlier = surface_.next(earlier), after_later = surface_.next(later);
    for (const auto around : surface_.halfedges_around_target(later))
      surface_.set_target(around, kept);
    surface_.set_next(later, after_earlier);
    surface_.set_next(earlier, after_later);
    surface_.set_halfedge(kept, earlier);
    surface_.remove_vertex(dropped);
  }

  void go_back_to(std::size_t met) {
    while (way_.size() > met + 1) {
      const auto place = at_.find(surface_.point(surface_.target(way_.back())));
      if (place != at_.end() && place->second == way_.size() - 1) at_.erase(place);
      way_.pop_back();
    }
  }

  Surface& surface_;
  Surface::Halfedge_index start_;
  std::size_t edges_left_;
  std::vector<Surface::Halfedge_index> way_;
  std::map<SurfacePoint, std::size_t> at_;  ///< the last half-edge on the way to each place
};

}  // namespace

std::size_t join_borders(Surface& surface) {
  std::vector<Surface::Halfedge_index> borders;
  CGAL::Polygon_mesh_processing::extract_boundary_cycles(surface, std::back_inserter(borders));
  std::size_t joined = 0;
  for (const auto start : borders) joined += BorderWalk(surface, start).run();
  return joined;
}

}  // namespace clay::solid::inline repair
