#include "export/smoothing/profile_smoothing.hpp"

#include "claystack/export/proof.hpp"
#include "core/text.hpp"
#include "export/section/stack_section.hpp"
#include "export/smoothing/piece_smoother.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid::inline smoothing {
namespace {

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
