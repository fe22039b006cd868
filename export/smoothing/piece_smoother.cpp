#include "export/smoothing/piece_smoother.hpp"

#include "claystack/export/proof.hpp"
#include "claystack/export/walls.hpp"
#include "core/cancel.hpp"
#include "export/smoothing/exact_wall.hpp"
#include "export/smoothing/fair_wall.hpp"
#include "export/smoothing/faired_curve.hpp"
#include "export/smoothing/flange_guard.hpp"
#include "export/smoothing/lip_fillet.hpp"
#include "export/smoothing/smoothing_plan.hpp"
#include "export/smoothing/volume_correction.hpp"
#include "export/smoothing/wall_guard.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace clay::solid::inline smoothing {
namespace {

/// Of the minimum wall with chords, where no requested limit depends on it: a tooth of the noise is
/// far below it, a lip or a flange whose shape changes a little is above.
constexpr double kLeastOfChords = 0.5;
/// Of the tolerance: by so much may a wall become thinner where no minimum is requested and all
/// walls are thick. Otherwise a wall of even thickness could keep all its rings, because the line
/// from a corner leans a little.
constexpr double kSlack = 1e-3;
constexpr double kThick = 10.0;  // tolerances
/// Covers the allowance of a limit, so that a wall that meets the limit with chords also meets it
/// here.
constexpr double kMeetsLimit = 0.99;

/// A length below two rings has no effect.
double fairing_length_mm(const PieceWalls& piece, const SmoothingOptions& options) {
  if (options.mode != Smoothing::fair || options.smooth_length_mm == 0.0) return 0.0;
  return std::max(options.smooth_length_mm, kLeastFairedLength * piece.ring_height_mm);
}

class PieceSmoother {
 public:
  PieceSmoother(const PieceWalls& piece, const SmoothingOptions& options)
      : piece_(piece),
        options_(options),
        // Never 0, so that the guard finds and corrects walls that would meet.
        limit_(options.min_wall_mm ? std::max(*options.min_wall_mm, piece.least_step_mm)
                                   : least_own_wall_mm(piece)),
        slack_mm_(options.mode == Smoothing::fair && !options.min_wall_mm &&
                          limit_ > kThick * options.tolerance_mm
                      ? kSlack * options.tolerance_mm
                      : 0.0),
        own_walls_(piece, limit_),
        plan_(piece, fairing_length_mm(piece, options),
              options.mode == Smoothing::fair ? options.tolerance_mm : 0.0),
        correction_(piece, options.tolerance_mm, limit_, plan_, own_walls_),
        flange_guard_(piece, limit_),
        overshot_(piece) {}

  SmoothedPiece run() {
    do {
      smooth();
      result_.section = outline_of(lines_);
      if (certify({{result_.section}})) {
        report();
        return std::move(result_);
      }
    } while (options_.mode == Smoothing::fair && undone_everywhere());
    return stepped();
  }

 private:
  void smooth() {
    result_ = {};
    do {
      do build();
      while (guard_found_more() || flange_guard_found_more());
      // Compensation moves the walls, and the edge of a flange becomes a little sharper.
    } while (options_.mode == Smoothing::fair && (!volume_kept() || flange_guard_found_more()));
  }

  /// The volume correction may move walls into each other that are thinner than its move.
  bool undone_everywhere() { return plan_.use_chords_everywhere() || plan_.refine_everywhere(); }

  void build() {
    stop_if_cancelled();
    if (options_.mode == Smoothing::fair) {
      const double share = 0.5 * options_.tolerance_mm;
      const FairRings rings{share, plan_.tolerances(share), plan_.lengths()};
      lines_ = {fairly(piece_.outer, plan_.outer_cuts(), rings, moved_outside_),
                fairly(piece_.bore, plan_.bore_cuts(), rings, moved_inside_)};
      return;
    }
    result_.overshoot_mm = result_.extrapolated_mm = result_.max_ring_error_relative = 0.0;
    lines_ = {exactly(piece_.outer, plan_.outer_cuts()), exactly(piece_.bore, plan_.bore_cuts())};
  }

  Polygon fairly(const WallRings& wall, const CutFlags& cut, const FairRings& rings,
                 FairedMove& moved) const {
    FairWall made = fair_wall(piece_, wall, cut, rings);
    moved = made.most;
    return std::move(made.line);
  }

  Polygon exactly(const WallRings& wall, CutFlags& cut) {
    ExactWall made =
        exact_wall(piece_, wall, cut, options_.overshoot_limit_mm.value_or(options_.tolerance_mm));
    for (const OvershootCut& at : made.cut) overshot_.add(at.interface, -at.overshoot_mm);
    result_.overshoot_mm = std::max(result_.overshoot_mm, made.overshoot_mm);
    result_.extrapolated_mm = std::max(result_.extrapolated_mm, made.extrapolated_mm);
    result_.max_ring_error_relative = std::max(result_.max_ring_error_relative, made.largest_error);
    return std::move(made.line);
  }

  /// True if the guard found walls too thin and could undo some smoothing there.
  bool guard_found_more() {
    const WallGauge gauge(piece_, lines_);
    if (!gauge.thinner_than(limit_ - slack_mm_)) return false;
    const RingFlags suspects = gauge.rings_near_thin(limit_);
    const std::vector<double> now = gauge.by_ring_mm(limit_, suspects);
    const std::vector<double>& own = own_walls_.by_ring_mm(suspects);
    std::vector<ThinRing> thin;
    for (std::size_t i = 0; i < piece_.size(); ++i)
      if (suspects[i] != 0 && now[i] < own[i] * kWallRounding - slack_mm_)
        thin.push_back({i, now[i]});
    return (options_.mode == Smoothing::fair && (plan_.refine(thin) || plan_.use_chords(thin))) ||
           plan_.keep_steps(thin);
  }

  /// The same for flanges, clay between two places of one wall, and for places that fairing made
  /// thinner than chords.
  bool flange_guard_found_more() {
    const Profile profile{{outline_of(lines_)}};
    const Wall thinnest = min_wall(profile);
    const std::vector<ThinRing> thin = flange_guard_.thin_rings(lines_, profile, thinnest);
    if (!thin.empty() && (plan_.use_chords(thin) || plan_.keep_steps(thin))) return true;
    const std::vector<ThinRing> thinned = thinned_by_fairing(profile, thinnest);
    return !thinned.empty() && plan_.use_chords(thinned);
  }

  /// Rings whose walls only the fairing has made thin. The comparison is with the chords, not with
  /// the steps: a single tread of noise counts there as a flange as thin as a ring.
  std::vector<ThinRing> thinned_by_fairing(const Profile& profile, const Wall& thinnest) {
    if (fairing_length_mm(piece_, options_) == 0.0) return {};
    const double most = options_.min_wall_mm ? limit_ : kLeastOfChords * limit_;
    if (thinnest.thickness_mm >= most * kWallRounding || thinnest.compact) return {};
    const bool meet = options_.min_wall_mm && chords_wall_mm() >= kMeetsLimit * limit_;
    const double share = kWallRounding * (meet ? 1.0 : kLeastOfChords);
    return flange_guard_.rings_below(share * std::min(limit_, chords_wall_mm()), profile, thinnest);
  }

  /// The minimum wall without fairing; made once, when it is needed.
  double chords_wall_mm() {
    if (!chords_wall_mm_) {
      SmoothingOptions chords = options_;
      chords.smooth_length_mm = 0.0;
      chords_wall_mm_ = min_wall_mm({{PieceSmoother(piece_, chords).run().section}});
    }
    return *chords_wall_mm_;
  }

  /// Compensates the volume changed by chords, simplification and fillet. False if that would move
  /// the walls too far; then the fairing was undone, jumps were cut or the simplification was
  /// undone instead.
  bool volume_kept() {
    VolumeCorrection::Found found = correction_.find(lines_);
    const double moved_mm = found.walls.moved_mm, allowed_mm = correction_.allowed_move_mm();
    if (moved_mm > allowed_mm) {
      const double excess = (1.0 - allowed_mm / moved_mm) * found.walls.lacking_over_pi;
      if (plan_.use_chords_everywhere() || plan_.keep_jumps(excess, moved_mm) ||
          plan_.refine_everywhere())
        return false;
    }
    result_.taken_mm = found.taken_mm;
    finish(std::move(found));
    return true;
  }

  void finish(VolumeCorrection::Found found) {
    CorrectedWalls& walls = found.walls;
    FilletLimit& limit = result_.lip_fillet_limit = FilletLimit::none;
    if (options_.lip_fillet_mm > 0.0 && !piece_.carries_piece) {
      const double fillet =
          std::min(options_.lip_fillet_mm, largest_fillet_mm(piece_, plan_.cuts()));
      if (fillet < options_.lip_fillet_mm) limit = FilletLimit::height_below;
      walls = correction_.corrected(lines_, found.rings, fillet);
      if (walls.fillet_mm < fillet) limit = FilletLimit::lip_width;
    }
    result_.overshoot_mm = walls.moved_mm;
    result_.lip_fillet_mm = walls.fillet_mm;
    lines_ = std::move(walls.lines);
  }

  void report_fairing() {
    if (plan_.lengths().empty()) return;
    const FairedMove& most = moved_outside_.mm >= moved_inside_.mm ? moved_outside_ : moved_inside_;
    result_.fairing = {fairing_length_mm(piece_, options_), most.mm, most.at_mm, {}};
    plan_.report(result_.fairing.shortened);
  }

  void report() {
    report_fairing();
    overshot_.report(KeptFor::overshoot, {}, result_.guard);
    plan_.kept_for_volume().report(KeptFor::volume, {}, result_.guard);
    const KeptStretches& thinned = plan_.kept_for_wall();
    if (!thinned.empty())
      thinned.report(KeptFor::wall, WallGauge(piece_, lines_).by_ring_mm(limit_, thinned.rings()),
                     result_.guard);
  }

  [[nodiscard]] SmoothedPiece stepped() const {
    SmoothedPiece steps;
    steps.section = outline_of(stepped_lines(piece_));
    steps.guard.push_back(
        {piece_.level.front(), piece_.level.back(), KeptFor::certificate, 0.0, 0.0});
    return steps;
  }

  const PieceWalls& piece_;
  const SmoothingOptions& options_;
  double limit_, slack_mm_;
  OwnWalls own_walls_;
  SmoothingPlan plan_;
  VolumeCorrection correction_;
  FlangeGuard flange_guard_;
  std::optional<double> chords_wall_mm_;
  WallLines lines_;
  FairedMove moved_outside_, moved_inside_;
  KeptStretches overshot_;
  SmoothedPiece result_;
};

}  // namespace

SmoothedPiece smooth_piece(const PieceWalls& piece, const SmoothingOptions& options) {
  return PieceSmoother(piece, options).run();
}

}  // namespace clay::solid::inline smoothing
