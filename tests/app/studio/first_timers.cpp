// first_timers [NOISE_MM [SEEDS [SAMPLE|all [FIRST_SEED]]]]: pots thrown by simulated newcomers who
// only follow the guide of the window; a table by sample. `ready` is the verdict of the window for
// filament; `printable` is that of `claystack bench --only hands`, which allows no wall below 2 mm
// and no ledge of 2 mm.

#include "app/bench/hands/pot_measures.hpp"
#include "app/studio/samples.hpp"
#include "tests/app/studio/first_timer.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

int main(int argc, char** argv) {
  const double noise_mm = argc > 1 ? std::atof(argv[1]) : 2.5;
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 20;
  const std::string_view only = argc > 3 ? argv[3] : "all";
  const int first = argc > 4 ? std::atoi(argv[4]) : 1;
  constexpr double kMostS = 120.0;
  std::printf("%-9s %5s %8s %8s %9s %8s %9s %9s %9s %9s\n", "sample", "pots", "success", "ready",
              "printable", "strokes", "median_s", "worst_s", "wall_mm", "height");
  for (std::size_t sample = 0; sample < clay::studio::samples().size(); ++sample) {
    const clay::studio::Sample& facts = clay::studio::samples()[sample];
    if (only != "all" && facts.name != only) continue;
    int ready = 0, success = 0, strokes = 0, printable = 0;
    double wall_mm = 1e9, height = 0.0;
    std::vector<double> seconds;
    for (int seed = first; seed < first + seeds; ++seed) {
      const auto pot =
          clay::test::throw_first_pot(sample, static_cast<std::uint64_t>(seed), noise_mm);
      const bool good = pot.ready && pot.is_pot() && pot.finished;
      ready += good ? 1 : 0;
      success += good && pot.stroke_s <= kMostS ? 1 : 0;
      strokes += pot.strokes;
      const auto measures = clay::bench::measure(pot.pot->stack);
      const bool prints = good && pot.stroke_s <= kMostS && measures.printable();
      printable += prints ? 1 : 0;
      wall_mm = std::min(wall_mm, pot.thinnest_mm);
      height += pot.height_mm / pot.sample_height_mm / seeds;
      seconds.push_back(pot.stroke_s);
      std::printf(
          "#  %s %d: %.0f s, %d strokes, %s%s, wall %.1f, height %.0f of %.0f mm, %.0f of %.0f ml, "
          "ledge %.1f mm, %s; %s\n",
          facts.title, seed, pot.stroke_s, pot.strokes, pot.finished ? "finished" : "unfinished",
          pot.fallen ? ", fallen" : "", pot.thinnest_mm, pot.height_mm, pot.sample_height_mm,
          pot.capacity_ml, pot.sample_capacity_ml, measures.ledge_mm,
          prints ? "printable" : "not printable", pot.verdict.c_str());
    }
    std::ranges::sort(seconds);
    std::printf("%-9s %5d %8d %8d %9d %8.1f %9.0f %9.0f %9.1f %8.0f%%\n", facts.title, seeds,
                success, ready, printable, static_cast<double>(strokes) / seeds,
                seconds[seconds.size() / 2], seconds.back(), wall_mm, 100.0 * height);
  }
  return 0;
}
