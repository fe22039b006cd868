// Curvature against height along both walls of a sample pot, straight from ring to ring and faired:
//   curvature_combs SAMPLE LENGTH_MM OUT_PREFIX
// writes OUT_PREFIX-outside.svg and OUT_PREFIX-inside.svg, and prints the largest values.
//   curvature_combs
// prints the displacement by the fairing of all samples, and its processor time.

#include "app/chart/plot.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/export/job.hpp"
#include "tests/export/job/sample_pots.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace clay;
using namespace clay::solid;

constexpr double kToleranceMm = 1e-4;  // the drawn curvature is that of the curve
constexpr std::size_t kRounds = 15, kManyRings = 100'000;

struct Comb {
  std::vector<double> height_mm, per_mm;

  [[nodiscard]] double largest() const {
    double most = 0.0;
    for (const double c : per_mm) most = std::max(most, std::abs(c));
    return most;
  }
  /// Largest change from one ring to the next.
  [[nodiscard]] double largest_change() const {
    double most = 0.0;
    for (std::size_t i = 1; i < per_mm.size(); ++i)
      most = std::max(most, std::abs(per_mm[i] - per_mm[i - 1]));
    return most;
  }
};

SmoothedProfile smoothed(const ClayStack& stack, double length_mm, double tolerance_mm) {
  SmoothingOptions options;
  options.tolerance_mm = tolerance_mm;
  options.smooth_length_mm = length_mm;
  return smooth_profile_of(stack, options).value();
}

/// The points of one wall from the bottom up: those of the outer wall rise, those of the bore fall.
Polygon wall_of(const SmoothedProfile& made, bool outside) {
  Polygon line, section = made.section.profile.pieces.at(0);
  if (!outside) std::reverse(section.begin(), section.end());
  const auto top = std::ranges::max(section, {}, &ProfilePoint::y).y;
  for (const ProfilePoint& p : section) {
    if (p.rho == 0.0) continue;
    if (line.empty() || p.y > line.back().y) line.push_back(p);
    if (p.y == top) break;
  }
  return line;
}

double radius_at(const Polygon& line, double y) {
  const auto above =
      std::ranges::lower_bound(line.begin() + 1, line.end() - 1, y, {}, &ProfilePoint::y);
  const ProfilePoint &a = *(above - 1), &b = *above;
  return a.rho + (b.rho - a.rho) * (y - a.y) / (b.y - a.y);
}

/// At the middles of the rings, without the ends of the wall, whose edges are round.
Comb comb_of(const Polygon& line, double h, double end_mm) {
  Comb comb;
  const double bottom = line.front().y, top = line.back().y;
  const auto rings = static_cast<std::size_t>((top - bottom) / h);
  for (std::size_t i = 1; i + 1 < rings; ++i) {
    const double y = bottom + (static_cast<double>(i) + 0.5) * h;
    if (y - bottom < end_mm || top - y < end_mm) continue;
    const double below = radius_at(line, y - h), at = radius_at(line, y),
                 above = radius_at(line, y + h);
    const double slope = (above - below) / (2.0 * h), bend = (above - 2.0 * at + below) / (h * h);
    comb.height_mm.push_back(y);
    comb.per_mm.push_back(bend / std::pow(1.0 + slope * slope, 1.5));
  }
  return comb;
}

int draw(const std::string& sample, double length_mm, const std::string& prefix) {
  const auto pot = samples::thrown_pot(sample);
  if (!pot) return std::fprintf(stderr, "%s\n", pot.error().message.c_str()), 3;
  const double h = pot->stack.ring_height_mm();
  for (const bool outside : {true, false}) {
    const std::string wall = outside ? "outside" : "inside";
    chart::Plot plot{.id = sample + "-" + wall,
                     .title = "Curvature of the " + sample + ", " + wall,
                     .x = {.label = "height [mm]"},
                     .y = {.label = "curvature [1/mm]"},
                     .curves = {},
                     .note = {}};
    for (const double length : {0.0, length_mm}) {
      const SmoothedProfile made = smoothed(pot->stack, length, kToleranceMm);
      const Comb comb = comb_of(wall_of(made, outside), h, length_mm);
      std::printf("%s, %s, %s: largest curvature %.3f /mm, largest change between rings %.3f /mm\n",
                  sample.c_str(), wall.c_str(), length == 0.0 ? "chords" : "faired", comb.largest(),
                  comb.largest_change());
      plot.curves.push_back({.name = length == 0.0 ? "straight from ring to ring" : "faired",
                             .x = comb.height_mm,
                             .y = comb.per_mm,
                             .low = {},
                             .high = {}});
    }
    const auto written = publish(prefix + "-" + wall + ".svg", svg_of(plot, chart::Place::alone));
    if (!written) return std::fprintf(stderr, "%s\n", written.error().message.c_str()), 3;
  }
  return 0;
}

/// Of the processor, the least of some rounds: other programs disturb it little.
double least_ms(const ClayStack& stack, double length_mm) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t round = 0; round < (stack.size() < kManyRings ? kRounds : 1); ++round) {
    const std::clock_t begin = std::clock();
    (void)smoothed(stack, length_mm, 0.02);
    least = std::min(least, 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return least;
}

/// A bellied wall of 100 mm or more with the kinks of strokes.
ClayStack bellied(std::size_t count) {
  const double h = std::max(0.001, 100.0 / static_cast<double>(count));
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < count; ++i) {
    const double y = h * (static_cast<double>(i) + 0.5);
    const double outer =
        40.0 + 6.0 * std::sin(0.05 * y) + 0.1 * std::abs(std::fmod(y, 20.0) - 10.0);
    rings.push_back({quanta_from_radius(outer), y < 6.0 ? 0 : quanta_from_radius(outer - 4.0)});
  }
  return ClayStack::from_rings(h, std::move(rings), 0).value();
}

void time(const char* name, const ClayStack& stack, double length_mm) {
  const double chords = least_ms(stack, 0.0), faired = least_ms(stack, length_mm);
  std::printf("%-20s %8.3f ms straight, %8.3f ms faired, ratio %.2f\n", name, chords, faired,
              faired / chords);
}

int table() {
  for (const char* sample : samples::kStandingPots) {
    const auto pot = samples::thrown_pot(sample);
    if (!pot) return std::fprintf(stderr, "%s\n", pot.error().message.c_str()), 3;
    for (const double length : {9.0, 18.0}) {
      const SmoothedProfile made = smoothed(pot->stack, length, 0.02);
      std::printf("%-9s %4.0f mm: moved %.3f mm at %.1f mm, wall %.3f mm (straight %.3f mm)\n",
                  sample, length, made.fairing.moved_mm, made.fairing.moved_at_mm,
                  min_wall_mm(made.section.profile),
                  min_wall_mm(smoothed(pot->stack, 0.0, 0.02).section.profile));
    }
    time(sample, pot->stack, 9.0);
  }
  for (const std::size_t count : {200u, 10'000u, 100'000u, 1'000'000u})
    time((std::to_string(count) + " rings").c_str(), bellied(count), 9.0);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1) return table();
  if (argc == 4) return draw(argv[1], std::atof(argv[2]), argv[3]);
  std::fprintf(stderr, "expected no arguments, or SAMPLE LENGTH_MM OUT_PREFIX\n");
  return 2;
}
