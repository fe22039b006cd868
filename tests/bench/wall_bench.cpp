// Times the proofs and measurements of a profile: wall_bench [RUNS]. Medians, one process.

#include "claystack/export/proof.hpp"
#include "claystack/export/solid.hpp"
#include "claystack/export/walls.hpp"
#include "export/walls/clearance.hpp"
#include "tests/bench/cgal_peer.hpp"

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

double radius(double y) { return 50.0 + 20.0 * std::sin(0.018 * y - 0.6); }

/// A bellied bowl with a radial wall of 3 mm, and a floor. Its vertices are displaced by
/// `noise_mm`, except within 1 mm of its corners, where noise would make sharp edges of zero
/// thickness.
Profile bowl(std::size_t rings, double noise_mm, bool hollow) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-noise_mm, noise_mm);
  const auto noise_at = [&](double y) {
    const bool near_corner = y < 1.0 || y > kHeight - 1.0 || std::abs(y - kFloor) < 1.0;
    return near_corner ? 0.0 : uniform(random);
  };
  Polygon outer, bore;
  for (std::size_t i = 0; i <= rings; ++i) {
    const double y = kHeight * static_cast<double>(i) / static_cast<double>(rings);
    outer.push_back({radius(y) + noise_at(y), y});
    if (hollow && y >= kFloor) bore.push_back({radius(y) - 3.0 + noise_at(y), y});
  }
  bore.insert(bore.begin(), {0.0, hollow ? bore.front().y : kHeight});
  bore.insert(bore.begin(), {0.0, 0.0});
  outer.insert(outer.end(), bore.rbegin(), bore.rend());
  return {{outer}};
}

/// The same bowl as steps of rings.
Profile steps(std::size_t rings) {
  Polygon outer, bore;
  const double h = kHeight / static_cast<double>(rings);
  for (std::size_t i = 0; i < rings; ++i) {
    const double low = h * static_cast<double>(i), high = h * static_cast<double>(i + 1);
    const double r = radius(0.5 * (low + high));
    outer.insert(outer.end(), {{r, low}, {r, high}});
    if (low < kFloor) continue;
    if (bore.empty()) bore = {{0.0, 0.0}, {0.0, low}};
    bore.insert(bore.end(), {{r - 3.0, low}, {r - 3.0, high}});
  }
  outer.insert(outer.end(), bore.rbegin(), bore.rend());
  return {{outer}};
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

/// The proof in the plane compared with CGAL's test of the mesh.
void compare_with_cgal(const Profile& profile, std::size_t segments, int runs) {
  const TriangleMesh mesh = revolve(profile, segments);
  bool fault = false;
  const double plane_ms = median_ms(200 * runs, [&] {
    (void)certify(profile);
    (void)min_wall_mm(profile);
  });
  const double cgal_ms = median_ms(runs, [&] { fault = clay::bench::cgal_finds_defect(mesh); });
  std::printf(
      "%zu triangles: certificate and minimum wall %.3f ms; CGAL soup to mesh and "
      "self-intersection %.0f ms%s\n",
      mesh.triangles.size(), plane_ms, cgal_ms, fault ? ", which reports a defect" : "");
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  compare_with_cgal(bowl(200, 0.0, true), 256, runs);
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
