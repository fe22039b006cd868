#include "export/smoothing/profile_smoothing.hpp"

#include "claystack/export/proof.hpp"
#include "claystack/export/walls.hpp"
#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/section/stack_section.hpp"
#include "export/section/swept_volume.hpp"
#include "export/smoothing/exact_wall.hpp"
#include "export/smoothing/fair_wall.hpp"
#include "export/smoothing/faired_curve.hpp"
#include "export/smoothing/flange_guard.hpp"
#include "export/smoothing/lip_fillet.hpp"
#include "export/smoothing/smoothing_plan.hpp"
#include "export/smoothing/wall_guard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid::inline smoothing {
namespace {

constexpr int kFilletRounds = 6;
constexpr int kCarefulRounds = 8;
constexpr double kSettledShare = 1e-14;
constexpr double kInvisibleHeights = 0.01;
/// Of the minimum wall with chords, where no requested limit depends on it: a tooth of the noise is
/// far below it, a lip or a flange whose shape changes a little is above.
constexpr double kLeastOfChords = 0.5;
/// Covers the allowance of a limit, so that whatever passes with chords passes.
constexpr double kMeetsLimit = 0.99;

struct SmoothedPiece {
  Polygon section;
  std::vector<KeptSteps> guard;
  double overshoot_mm = 0.0;
  double extrapolated_mm = 0.0;
  double taken_mm = 0.0;
  double lip_fillet_mm = 0.0;
  FilletLimit lip_fillet_limit = FilletLimit::none;
  double max_ring_error_relative = 0.0;
  FairingReport fairing;
};

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
        own_walls_(piece, limit_),
        plan_(piece, fairing_length_mm(piece, options),
              options.mode == Smoothing::fair ? options.tolerance_mm : 0.0),
        flange_guard_(piece, limit_),
        overshot_(piece) {}

  SmoothedPiece run() {
    do {
      do build();
      while (guard_found_more() || flange_guard_found_more());
      // Compensation moves the walls, and the edge of a flange becomes a little sharper.
    } while (options_.mode == Smoothing::fair && (!volume_kept() || flange_guard_found_more()));
    result_.section = outline_of(lines_);
    report();
    if (!certify({{result_.section}})) keep_all_steps();
    return std::move(result_);
  }

 private:
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
    if (!gauge.thinner_than(limit_)) return false;
    const RingFlags suspects = gauge.rings_near_thin(limit_);
    const std::vector<double> now = gauge.by_ring_mm(limit_, suspects);
    const std::vector<double>& own = own_walls_.by_ring_mm(suspects);
    std::vector<ThinRing> thin;
    for (std::size_t i = 0; i < piece_.size(); ++i)
      if (suspects[i] != 0 && now[i] < own[i] * kWallRounding) thin.push_back({i, now[i]});
    return (options_.mode == Smoothing::fair && (plan_.refine(thin) || plan_.use_chords(thin))) ||
           plan_.keep_steps(thin);
  }

  /// The same for flanges, clay between two places of one wall, and for what fairing made thinner
  /// than chords.
  bool flange_guard_found_more() {
    const Profile profile{{outline_of(lines_)}};
    const Wall thinnest = min_wall(profile);
    const std::vector<ThinRing> thin = flange_guard_.thin_rings(lines_, profile, thinnest);
    if (!thin.empty() && (plan_.use_chords(thin) || plan_.keep_steps(thin))) return true;
    const std::vector<ThinRing> thinned = thinned_by_fairing(profile, thinnest);
    return !thinned.empty() && plan_.use_chords(thinned);
  }

  /// Rings whose walls only the fairing has made thin. Steps cannot tell: a single tread of their
  /// noise counts as a flange as thin as a ring, and allows one.
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

  struct Correction {
    WallLines lines;
    double lacking_over_pi = 0.0;  ///< volume added, negative if removed [mm^3]
    double moved_mm = 0.0;         ///< largest displacement of a wall
    double fillet_mm = 0.0;
  };

  /// Compensates the volume changed by chords, simplification and fillet. False if that would move
  /// the walls too far; then the fairing was undone, jumps were cut or the simplification was
  /// undone instead.
  bool volume_kept() {
    RingFlags rings = all_rings();
    Correction correction = corrected(rings, 0.0);
    const bool taken = correction.lacking_over_pi < 0.0;
    result_.taken_mm = 0.0;
    if (taken && WallGauge(piece_, correction.lines).thinner_than(limit_)) {
      rings = thick_rings();
      Correction careful = careful_correction(rings);
      if (careful.moved_mm > 0.0) {
        correction = std::move(careful);
      } else {
        result_.taken_mm = correction.moved_mm;
        rings = all_rings();
      }
    }
    if (correction.moved_mm > allowed_move_mm()) {
      const double too_much = 1.0 - allowed_move_mm() / correction.moved_mm;
      const double excess = too_much * correction.lacking_over_pi;
      if (plan_.use_chords_everywhere() || plan_.keep_jumps(excess, correction.moved_mm) ||
          plan_.refine_everywhere())
        return false;
    }
    finish(std::move(correction), rings);
    return true;
  }

  void finish(Correction correction, const RingFlags& rings) {
    if (options_.lip_fillet_mm > 0.0 && !piece_.carries_piece) {
      const double fillet =
          std::min(options_.lip_fillet_mm, largest_fillet_mm(piece_, plan_.cuts()));
      if (fillet < options_.lip_fillet_mm) result_.lip_fillet_limit = FilletLimit::height_below;
      correction = corrected(rings, fillet);
      if (correction.fillet_mm < fillet) result_.lip_fillet_limit = FilletLimit::lip_width;
    }
    result_.overshoot_mm = correction.moved_mm;
    result_.lip_fillet_mm = correction.fillet_mm;
    lines_ = std::move(correction.lines);
  }

  /// The fillet is applied after scaling, so that its arcs stay round; the clay that it removes
  /// changes the scale a little. The last round only scales the small remainder.
  Correction corrected(const RingFlags& rings, double fillet_mm) const {
    Correction made;
    WallLines scaled = lines_;
    for (int round = 1;; ++round) {
      made.lines = scaled;
      if (fillet_mm > 0.0) {
        FilletedLip lip = with_lip_fillet(scaled, fillet_mm, 0.5 * options_.tolerance_mm);
        made.lines = std::move(lip.lines);
        made.fillet_mm = fillet_mm = lip.radius_mm;
      }
      const double wanted = piece_.clay_over_pi + swept_over_pi(made.lines.bore);
      made.lacking_over_pi += wanted - swept_over_pi(made.lines.outer);
      const std::vector<double> weights = weights_of(made.lines.outer, rings);
      const double share = scale_for(made.lines.outer, weights, wanted);
      made.moved_mm += scale(scaled.outer, weights_of(scaled.outer, rings), share);
      if (fillet_mm > 0.0 && std::abs(share) > kSettledShare && round < kFilletRounds) continue;
      scale(made.lines.outer, weights, share);
      return made;
    }
  }

  /// 1 for points whose edges all lie in flagged rings, else 0.
  std::vector<double> weights_of(const Polygon& line, const RingFlags& rings) const {
    std::vector<double> weights(line.size(), 1.0);
    std::size_t first = 0;
    for (std::size_t e = 0; e + 1 < line.size(); ++e) {
      step_of_loop();
      while (first + 1 < piece_.size() && piece_.level[first + 1] < line[e].y) ++first;
      for (std::size_t i = first; i < piece_.size() && piece_.level[i] <= line[e + 1].y; ++i)
        if (rings[i] == 0) weights[e] = weights[e + 1] = 0.0;
    }
    return weights;
  }

  /// The largest displacement of a wall by the volume correction: that of the simplification, or an
  /// invisible fraction of a ring.
  double allowed_move_mm() const {
    return std::max(options_.tolerance_mm, kInvisibleHeights * piece_.ring_height_mm);
  }

  /// Rings that can be moved that far without approaching the limit of the guard.
  RingFlags thick_rings() {
    const double spare = 2.0 * allowed_move_mm();  // across a solid both sides move
    const std::vector<double>& own = own_walls_.by_ring_mm(all_rings());
    const std::vector<double> now = walls_of(lines_, limit_ + spare);
    RingFlags thick(piece_.size());
    for (std::size_t i = 0; i < piece_.size(); ++i)
      thick[i] = now[i] >= (own[i] + spare) * kWallRounding ? 1 : 0;
    return thick;
  }

  /// Moves only the flagged rings, which must be thick. A wall runs from the outside of one ring to
  /// the bore of another one: where the move thins a wall, the rings around it are unflagged. Moves
  /// nothing if too few rings remain.
  Correction careful_correction(RingFlags& rings) {
    const std::vector<double>& own = own_walls_.by_ring_mm(all_rings());
    const std::vector<double> before = walls_of(lines_, limit_);
    for (int round = 0; round < kCarefulRounds; ++round) {
      Correction made = corrected(rings, 0.0);
      if (!(made.moved_mm <= allowed_move_mm())) break;
      const std::vector<double> now = walls_of(made.lines, limit_);
      bool thinned = false;
      std::size_t done = 0;
      for (std::size_t i = 0; i < piece_.size(); ++i) {
        if (now[i] >= std::min(own[i], before[i]) * kWallRounding) continue;
        thinned = true;
        const auto [first, last] = plan_.rings_around({i, now[i]});
        for (done = std::max(done, first); done <= last; ++done) rings[done] = 0;
      }
      if (!thinned) return made;
    }
    return {};
  }

  std::vector<double> walls_of(const WallLines& lines, double cap_mm) const {
    return WallGauge(piece_, lines).by_ring_mm(cap_mm, all_rings());
  }

  RingFlags all_rings() const { return RingFlags(piece_.size(), 1); }

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

  void keep_all_steps() {
    result_ = {};
    result_.section = outline_of(stepped_lines(piece_));
    result_.guard.push_back(
        {piece_.level.front(), piece_.level.back(), KeptFor::certificate, 0.0, 0.0});
  }

  const PieceWalls& piece_;
  const SmoothingOptions& options_;
  double limit_;
  OwnWalls own_walls_;
  SmoothingPlan plan_;
  FlangeGuard flange_guard_;
  std::optional<double> chords_wall_mm_;
  WallLines lines_;
  FairedMove moved_outside_, moved_inside_;
  KeptStretches overshot_;
  SmoothedPiece result_;
};

/// One piece, `fair` or `exact`. Only the topmost piece has a lip.
SmoothedPiece smooth_piece(const PieceWalls& piece, const SmoothingOptions& options) {
  return PieceSmoother(piece, options).run();
}

/// The error, if any.
Result<void> check_range(const std::string& option, double value, bool zero_allowed) {
  if (std::isfinite(value) && (value > 0.0 || (zero_allowed && value == 0.0))) return {};
  return failure(ErrorKind::bad_input, option + ": expected " +
                                           (zero_allowed ? "0 mm or more" : "more than 0 mm") +
                                           ", found " + nine_digit_text(value) + " mm");
}

/// An option for `fair` only.
Result<void> check_fair(const std::string& option, double value, const SmoothingOptions& options) {
  if (options.mode == Smoothing::fair || value == 0.0) return {};
  return failure(ErrorKind::bad_input,
                 option + ": expected fair smoothing, found " + std::string(name_of(options.mode)));
}

Result<void> check(const SmoothingOptions& options) {
  return check_range("tolerance", options.tolerance_mm, false)
      .and_then(
          [&] { return check_range("minimum wall", options.min_wall_mm.value_or(0.0), true); })
      .and_then([&] { return check_range("lip fillet", options.lip_fillet_mm, true); })
      .and_then([&] { return check_range("smooth length", options.smooth_length_mm, true); })
      .and_then([&] { return check_fair("smooth length", options.smooth_length_mm, options); })
      .and_then([&] {
        return check_range("overshoot limit", options.overshoot_limit_mm.value_or(0.0), true);
      })
      .and_then([&]() -> Result<void> {
        if (options.mode == Smoothing::fair || options.lip_fillet_mm == 0.0) return {};
        return failure(
            ErrorKind::bad_input,
            "lip fillet: expected fair smoothing, found " + std::string(name_of(options.mode)) +
                (options.mode == Smoothing::exact ? ", in which the top rings keep all their clay"
                                                  : ", which keeps the steps"));
      });
}

void add_fairing(FairingReport& sum, const FairingReport& piece) {
  sum.shortened.insert(sum.shortened.end(), piece.shortened.begin(), piece.shortened.end());
  sum.length_mm = std::max(sum.length_mm, piece.length_mm);
  if (piece.moved_mm <= sum.moved_mm) return;
  sum.moved_mm = piece.moved_mm;
  sum.moved_at_mm = piece.moved_at_mm;
}

void smooth_pieces(const ClayStack& stack, const SmoothingOptions& options,
                   SmoothedProfile& result) {
  result.lip_fillet_asked_mm = options.lip_fillet_mm;
  for (std::size_t k = 0; k < result.section.shapes.size(); ++k) {
    const PieceShape& shape = result.section.shapes[k];
    SmoothedPiece piece =
        smooth_piece(walls_of(stack, {shape.first_ring, shape.last_ring}), options);
    result.section.profile.pieces[k] = std::move(piece.section);
    result.guard.insert(result.guard.end(), piece.guard.begin(), piece.guard.end());
    result.overshoot_mm = std::max(result.overshoot_mm, piece.overshoot_mm);
    result.extrapolated_mm = std::max(result.extrapolated_mm, piece.extrapolated_mm);
    result.taken_mm = std::max(result.taken_mm, piece.taken_mm);
    // A lip that carries the next piece has none.
    if (piece.lip_fillet_limit != FilletLimit::none || piece.lip_fillet_mm > 0.0) {
      result.lip_fillet_mm = piece.lip_fillet_mm;
      result.lip_fillet_limit = piece.lip_fillet_limit;
    }
    result.max_ring_error_relative =
        std::max(result.max_ring_error_relative, piece.max_ring_error_relative);
    add_fairing(result.fairing, piece.fairing);
  }
}

/// Each piece is certified alone. A scaled wall may still meet the next piece at the level where
/// that begins: then both keep their steps.
void keep_pieces_apart(const ClayStack& stack, SmoothedProfile& result) {
  std::vector<Polygon>& pieces = result.section.profile.pieces;
  if (pieces.size() < 2 || certify(result.section.profile)) return;
  const auto rings = [&](std::size_t k) {
    return RingRange{result.section.shapes[k].first_ring, result.section.shapes[k].last_ring};
  };
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    if (certify({{pieces[k - 1], pieces[k]}})) continue;
    for (const std::size_t kept : {k - 1, k}) pieces[kept] = section_of(stack, rings(kept));
    result.guard.push_back({level_mm(stack, rings(k - 1).first), level_mm(stack, rings(k).last + 1),
                            KeptFor::certificate, 0.0, 0.0});
  }
}

}  // namespace

std::string_view name_of(Smoothing smoothing) noexcept {
  switch (smoothing) {
    case Smoothing::none:
      return "none";
    case Smoothing::fair:
      return "fair";
    default:
      return "exact";
  }
}

std::string_view name_of(KeptFor reason) noexcept {
  switch (reason) {
    case KeptFor::wall:
      return "wall";
    case KeptFor::overshoot:
      return "overshoot";
    case KeptFor::volume:
      return "volume";
    default:
      return "certificate";
  }
}

Result<SmoothedProfile> smoothed_profile(const ClayStack& stack, StackProfile steps,
                                         const SmoothingOptions& options) {
  return check(options).map([&] {
    SmoothedProfile result;
    result.section = std::move(steps);
    if (options.mode != Smoothing::none) {
      smooth_pieces(stack, options, result);
      keep_pieces_apart(stack, result);
    }
    const double counted = stack.volume_mm3();
    result.volume_error_relative = std::abs(volume_of(result.section.profile) - counted) / counted;
    return result;
  });
}

Result<SmoothedProfile> smooth_profile_of(const ClayStack& stack, const SmoothingOptions& options) {
  return check(options)
      .and_then([&] { return profile_of(stack); })
      .and_then(
          [&](StackProfile steps) { return smoothed_profile(stack, std::move(steps), options); });
}

}  // namespace clay::solid::inline smoothing
