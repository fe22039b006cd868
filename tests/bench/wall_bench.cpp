// Times what is proved and measured of a profile: wall_bench [RUNS]. Medians, one process.

#include "claystack/export/certificate.hpp"
#include "claystack/export/clearance.hpp"
#include "claystack/export/wall_thickness.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

namespace {

using namespace clay::solid;

constexpr double kHeight = 200.0, kFloor = 6.0;

/// A bellied bowl of 3 mm along the radius, with a floor; its vertices stray by `noise_mm`.
Profile bowl(std::size_t rings, double noise_mm, bool hollow) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> stray(-noise_mm, noise_mm);
  const auto radius = [](double y) { return 50.0 + 20.0 * std::sin(0.018 * y - 0.6); };
  Polygon outer, bore;
  for (std::size_t i = 0; i <= rings; ++i) {
    const double y = kHeight * static_cast<double>(i) / static_cast<double>(rings);
    outer.push_back({radius(y) + stray(random), y});
    if (hollow && y >= kFloor) bore.push_back({radius(y) - 3.0 + stray(random), y});
  }
  if (hollow)
    bore.insert(bore.begin(), {0.0, bore.front().y});
  else
    bore.push_back({0.0, kHeight});
  bore.insert(bore.begin(), {0.0, 0.0});
  outer.insert(outer.end(), bore.rbegin(), bore.rend());
  return {{outer}};
}

/// The same bowl in steps.
Profile steps(std::size_t rings) {
  const Polygon smooth = bowl(rings, 0.0, true).pieces[0];
  Polygon stepped;
  for (std::size_t i = 0; i < smooth.size(); ++i) {
    const ProfilePoint& p = smooth[i];
    const ProfilePoint& next = smooth[i + 1 < smooth.size() ? i + 1 : 0];
    stepped.push_back(p);
    // Each ring has the radius of its lower end.
    if (next.y > p.y) stepped.push_back({p.rho, next.y});
    if (next.y < p.y && next.rho > 0.0) stepped.push_back({next.rho, p.y});
  }
  return {{stepped}};
}

template <class Work>
double median_ms(int runs, Work work) {
  std::vector<double> times;
  for (int i = 0; i < runs; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
            .count());
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void report(const char* name, const Profile& profile, int runs) {
  const auto certificate = certify(profile);
  if (!certificate) {
    std::printf("%-18s %s\n", name, certificate.error().message.c_str());
    return;
  }
  double wall = 0.0, clear = 0.0;
  std::size_t samples = 0;
  const double certify_ms = median_ms(runs, [&] { (void)certify(profile); });
  const double wall_ms = median_ms(runs, [&] { wall = min_wall_mm(profile); });
  const double clear_ms = median_ms(runs, [&] { clear = clearance_mm(profile); });
  const double field_ms = median_ms(1, [&] { samples = wall_field(profile, 0.5).size(); });
  std::printf("%-18s %8zu %10.3f %10.3f %10.3f %10.3f %9zu %12.6f %12.3g\n", name,
              profile.pieces[0].size(), certify_ms, wall_ms, clear_ms, field_ms, samples, wall,
              clear);
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  std::printf("%-18s %8s %10s %10s %10s %10s %9s %12s %12s\n", "profile", "vertices", "certify ms",
              "wall ms", "clear. ms", "field ms", "samples", "wall mm", "clearance mm");
  for (const std::size_t rings : {std::size_t{200}, std::size_t{20'000}, std::size_t{1'000'000}}) {
    const int repeats = rings == 200 ? 200 * runs : runs;
    report("bowl", bowl(rings, 0.0, true), repeats);
    report("bowl, noise 1e-4", bowl(rings, 1e-4, true), repeats);
    report("bowl in steps", steps(rings), repeats);
    report("solid", bowl(rings, 0.0, false), repeats);
    report("solid, noise 1e-4", bowl(rings, 1e-4, false), repeats);
  }
}
