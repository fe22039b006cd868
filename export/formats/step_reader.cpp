// Judges a STEP file of this program by its text alone: topology, incidence, orientation, volume.

#include "core/compensated_sum.hpp"
#include "export/formats/step.hpp"
#include "export/formats/step_entities.hpp"
#include "export/formats/step_shapes.hpp"
#include "export/formats/step_text.hpp"

#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::solid::inline formats {
namespace {

class StepJudge {
 public:
  explicit StepJudge(const StepFile& file) : step_(file), places_(file.entities.size(), kUnused) {}

  StepSolid run() {
    for (const StepValue& entity : step_.all()) {
      if (entity.word != "ADVANCED_BREP_SHAPE_REPRESENTATION") continue;
      check_unit(step_.word(entity, 2));
      for (const StepValue& item : step_.list(entity, 1)) judge_item(item.word);
    }
    if (solid_.bodies == 0) throw BadStep{"expected a solid, found none"};
    solid_.volume_mm3 = volume_mm3_.value();
    return solid_;
  }

 private:
  static constexpr std::size_t kUnused = ~std::size_t{0};

  /// An edge of the shell, and the numbers of loops that use it in its direction and against it.
  struct ShellEdge {
    std::string_view ref;
    StepEdge edge;
    std::size_t ahead = 0, back = 0;
  };

  /// An edge of a loop, by its place in `edges_`, and whether the loop uses it in its own
  /// direction.
  struct Use {
    std::size_t place = 0;
    bool forward = true;
  };

  /// The first unit of the context is that of lengths.
  void check_unit(std::string_view context) const {
    const auto unit =
        step_.word(step_.item(step_.part(context, "GLOBAL_UNIT_ASSIGNED_CONTEXT"), 0), 0);
    (void)step_.part(unit, "LENGTH_UNIT");
    const StepValue& si = step_.part(unit, "SI_UNIT");
    if (step_.word(si, 0) != ".MILLI." || step_.word(si, 1) != ".METRE.")
      bad_entity(unit, "lengths in mm");
  }

  void judge_item(std::string_view ref) {
    const StepValue& item = step_.entity(ref);
    if (item.word == "AXIS2_PLACEMENT_3D") return;
    if (item.word != "MANIFOLD_SOLID_BREP" && item.word != "BREP_WITH_VOIDS")
      bad_entity(ref, std::string("a solid, found ").append(item.word));
    ++solid_.bodies;
    const double before = volume_mm3_.value();
    judge_shell(step_.word(item, 1));
    if (!(volume_mm3_.value() > before)) bad_entity(ref, "normals out of the solid");
    if (item.size < 3) return;
    for (const StepValue& hole : step_.list(item, 2)) {
      const StepValue& oriented = step_.entity(hole.word, "ORIENTED_CLOSED_SHELL", 4);
      if (!step_.flag(oriented, 3)) bad_entity(hole.word, "the sense of its shell");
      judge_shell(step_.word(oriented, 2));
    }
  }

  /// Closed and oriented: every edge is used twice, in opposite directions.
  void judge_shell(std::string_view ref) {
    for (const StepValue& face : step_.list(step_.entity(ref, "CLOSED_SHELL", 2), 1)) {
      ++solid_.faces;
      judge_face(face.word);
    }
    for (const ShellEdge& found : edges_) {
      if (found.ahead != 1 || found.back != 1)
        bad_entity(found.ref, "two faces in opposite directions, found " +
                                  std::to_string(found.ahead) + " and " +
                                  std::to_string(found.back));
      places_[step_.place(found.ref)] = kUnused;
    }
    solid_.edges += edges_.size();
    edges_.clear();
  }

  /// The place in `edges_`: an edge is read once, even if several loops use it.
  std::size_t place_of(std::string_view ref) {
    std::size_t& place = places_[step_.place(ref)];
    if (place == kUnused) {
      edges_.push_back({ref, step_edge(step_, ref)});
      place = edges_.size() - 1;
    }
    return place;
  }

  std::vector<Use> loop(std::string_view ref) {
    std::vector<Use> uses;
    for (const StepValue& item : step_.list(step_.entity(ref, "EDGE_LOOP", 2), 1)) {
      const StepValue& oriented = step_.entity(item.word, "ORIENTED_EDGE", 5);
      const Use use{place_of(step_.word(oriented, 3)), step_.flag(oriented, 4)};
      ++(use.forward ? edges_[use.place].ahead : edges_[use.place].back);
      uses.push_back(use);
    }
    for (std::size_t i = 0; i < uses.size(); ++i) {
      const Use &a = uses[i], &b = uses[(i + 1) % uses.size()];
      if (edges_[a.place].edge.vertices[a.forward ? 1 : 0] !=
          edges_[b.place].edge.vertices[b.forward ? 0 : 1])
        bad_entity(ref, "edges that follow each other");
    }
    return uses;
  }

  void judge_face(std::string_view ref) {
    const StepValue& face = step_.entity(ref, "ADVANCED_FACE", 4);
    const StepSurface surface = step_surface(step_, step_.word(face, 2));
    const bool same_sense = step_.flag(face, 3);
    std::vector<Use> circles;
    for (const StepValue& item : step_.list(face, 1)) {
      const StepValue& bound = step_.entity(item.word);
      const bool outer = bound.word == "FACE_OUTER_BOUND";
      if (!outer && bound.word != "FACE_BOUND") bad_entity(item.word, "a bound of a face");
      if (!step_.flag(bound, 2)) bad_entity(item.word, "the sense of its loop");
      const std::size_t before = circles.size();
      for (const Use& use : loop(step_.word(bound, 1))) {
        const StepEdge& edge = edges_[use.place].edge;
        if (!surface.has(edge)) bad_entity(ref, "its edges on its surface");
        if (edge.circle) circles.push_back(use);
      }
      if (!surface.plane) continue;
      if (circles.size() == before) bad_entity(item.word, "circles in its loop");
      // The outer circle runs counterclockwise around the normal, holes the other way.
      if (circles.back().forward != (outer == (same_sense == (surface.up > 0.0))))
        bad_entity(ref, "bounds counterclockwise around its normal");
    }
    if (!surface.plane) judge_wall(ref, surface, same_sense, circles);
  }

  /// A wall lies between two half circles; the volume between it and the axis counts for the solid.
  void judge_wall(std::string_view ref, const StepSurface& surface, bool same_sense,
                  const std::vector<Use>& circles) {
    if (circles.size() != 2) bad_entity(ref, "two circles");
    const auto level = [&](std::size_t i) { return edges_[circles[i].place].edge.levels[0]; };
    const bool ordered = surface.curve ? level(0).is(surface.end(false)) : level(0).z < level(1).z;
    const std::size_t low = ordered ? 0 : 1, high = 1 - low;
    if (circles[low].forward != same_sense || circles[high].forward == same_sense)
      bad_entity(ref, "edges counterclockwise around its normal");
    const double volume = half_volume(surface, level(low), level(high));
    volume_mm3_.add(same_sense ? volume : -volume);
  }

  /// Half of the volume between the surface and the axis.
  static double half_volume(const StepSurface& surface, const StepLevel& low,
                            const StepLevel& high) {
    if (surface.curve) return 0.5 * swept_volume(*surface.curve);
    return std::numbers::pi / 6.0 * (high.z - low.z) *
           (low.rho * low.rho + low.rho * high.rho + high.rho * high.rho);
  }

  StepEntities step_;
  StepSolid solid_;
  CompensatedSum volume_mm3_;
  std::vector<ShellEdge> edges_;     ///< of the shell that is judged
  std::vector<std::size_t> places_;  ///< in `edges_`, of each entity
};

}  // namespace

Result<StepSolid> verify_step(std::string_view text, std::string_view name) {
  return parse_step(text, name).and_then([&](const StepFile& file) -> Result<StepSolid> {
    try {
      return StepJudge(file).run();
    } catch (const BadStep& problem) {
      return failure(ErrorKind::unsound, std::string(name).append(": ").append(problem.what));
    }
  });
}

}  // namespace clay::solid::inline formats
