// Times check_mesh and CGAL's soup-to-mesh and self-intersection test alone on the same mesh,
// interleaved so that a busy machine slows both.
//
//   check_bench [TRIANGLES [SHELLS [ROUNDS]]]     default 1000000 1 5; at most 20 million triangles
//   check_bench fans [SEGMENTS]                   default 30000
//   check_bench repair [TRIANGLES]                default 1000000
//
// `fans` uses a cylinder and a cone, whose ends are fans about one vertex, and a tube, whose ends
// are rings of long triangles. The time of CGAL is quadratic, so it runs only up to 30000 segments.
//
// `repair` times repair_mesh on a vase with a hole, a duplicate triangle and a cube through its
// wall, and decimate of the result to a tenth of its triangles.

#include "tests/bench/cgal_peer.hpp"

#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/repair.hpp"
#include "claystack/export/solid.hpp"
#include "export/formats/file_floats.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace clay::solid;
using clay::bench::cgal_finds_defect;

struct Seconds {
  double wall = 0.0;
  double cpu = 0.0;  ///< summed over all threads
};

class Stopwatch {
 public:
  [[nodiscard]] Seconds read() const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_begin_;
    return {wall.count(), cpu() - cpu_begin_};
  }

 private:
  static double cpu() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  std::chrono::steady_clock::time_point wall_begin_ = std::chrono::steady_clock::now();
  double cpu_begin_ = cpu();
};

template <class Work>
Seconds timed(const Work& work) {
  const Stopwatch watch;
  work();
  return watch.read();
}

/// A bellied vase, 200 mm high, with a floor and a 3 mm wall.
TriangleMesh vase(std::size_t triangles) {
  // Two walls of `rings` bands with two triangles per step, and half as many steps as bands.
  const auto rings = static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles) / 2.0));
  const auto outer = [&](double t) { return 50.0 + 18.0 * std::sin(6.9 * t - 0.6) - 8.0 * t; };
  const auto at = [&](std::size_t i) {
    return static_cast<double>(i) / static_cast<double>(rings);
  };
  Polygon section{{0.0, 0.0}};
  for (std::size_t i = 0; i <= rings; ++i) section.push_back({outer(at(i)), 200.0 * at(i)});
  for (std::size_t i = rings; 200.0 * at(i) > 6.0; --i)
    section.push_back({outer(at(i)) - 3.0, 200.0 * at(i)});
  section.push_back({0.0, 6.0});
  const Profile profile{{section}};
  return revolve(profile, std::max<std::size_t>(triangles / triangle_count(profile, 1), 3));
}

/// Vases side by side: several shells need the nesting test.
TriangleMesh vases(std::size_t count, std::size_t triangles) {
  const TriangleMesh one = vase(triangles / count);
  TriangleMesh all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto offset = static_cast<std::uint32_t>(all.points.size());
    for (const glm::dvec3& p : one.points)
      all.points.push_back(p + glm::dvec3(150.0 * static_cast<double>(i), 0.0, 0.0));
    for (const auto& [a, b, c] : one.triangles)
      all.triangles.push_back({a + offset, b + offset, c + offset});
  }
  return all;
}

Seconds median(std::vector<Seconds> all) {
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end(),
                   [](const Seconds& a, const Seconds& b) { return a.wall < b.wall; });
  return *middle;
}

void print_times(const char* what, const Seconds& s) {
  std::printf("%-44s %8.3f s wall %8.3f s cpu\n", what, s.wall, s.cpu);
}

/// The stages of a repair, in their order; those of one name are added up.
class StageTimes {
 public:
  void begin(std::string_view stage) {
    if (stage == stage_) return;
    end();
    stage_ = stage;
    watch_ = Stopwatch();
  }
  void print() {
    end();
    for (const auto& [stage, spent] : spent_) print_times(("  " + stage).c_str(), spent);
  }

 private:
  void end() {
    if (stage_.empty()) return;
    auto at = std::find_if(spent_.begin(), spent_.end(),
                           [&](const auto& entry) { return entry.first == stage_; });
    if (at == spent_.end()) at = spent_.insert(spent_.end(), {stage_, {}});
    const Seconds now = watch_.read();
    at->second = {at->second.wall + now.wall, at->second.cpu + now.cpu};
    stage_.clear();
  }

  std::string stage_;
  Stopwatch watch_;
  std::vector<std::pair<std::string, Seconds>> spent_;
};

double peak_gb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1e6;
}

[[noreturn]] void fail(const char* what) {
  std::fprintf(stderr, "check_bench: %s\n", what);
  std::exit(1);
}

void compare(std::size_t shells, std::size_t triangles, std::size_t rounds) {
  const std::string stl = encode_stl_binary(vases(shells, triangles));
  std::vector<Seconds> decode, check, cgal;
  double check_peak_gb = 0.0;
  std::size_t found = 0;
  for (std::size_t round = 0; round < rounds; ++round) {
    TriangleMesh mesh;
    decode.push_back(timed([&] { mesh = decode_stl(stl, "vase.stl").value(); }));
    found = mesh.triangles.size();
    bool sound = false;
    check.push_back(timed([&] { sound = check_mesh(mesh).value().sound(); }));
    if (round == 0) check_peak_gb = peak_gb();
    if (!sound) fail("check_mesh reports a defect in a sound mesh");
    bool fault = true;
    cgal.push_back(timed([&] { fault = cgal_finds_defect(mesh); }));
    if (fault) fail("CGAL reports a defect in a sound mesh");
  }
  std::printf("%zu triangles, %zu shell(s), median of %zu; peak memory before CGAL %.2f GB\n",
              found, shells, rounds, check_peak_gb);
  print_times("decode_stl", median(decode));
  print_times("check_mesh", median(check));
  print_times("CGAL soup to mesh + does_self_intersect", median(cgal));
  std::printf("check_mesh / CGAL: %.2f wall, %.2f cpu\n", median(check).wall / median(cgal).wall,
              median(check).cpu / median(cgal).cpu);
}

void compare_fans(const char* what, const Profile& profile, std::size_t segments) {
  constexpr std::size_t kMaxForCgal = 30'000;
  const TriangleMesh mesh = revolve(profile, segments);
  std::printf("%s of %zu segments, %zu triangles\n", what, segments, mesh.triangles.size());
  bool sound = false;
  print_times("check_mesh", timed([&] { sound = check_mesh(mesh).value().sound(); }));
  if (!sound) fail("check_mesh reports a defect in a sound mesh");
  if (segments > kMaxForCgal) return;
  bool fault = true;
  print_times("CGAL soup to mesh + does_self_intersect",
              timed([&] { fault = cgal_finds_defect(mesh); }));
  if (fault) fail("CGAL reports a defect in a sound mesh");
}

void compare_fans(std::size_t segments) {
  compare_fans("cylinder", {{{{0, 0}, {50, 0}, {50, 80}, {0, 80}}}}, segments);
  compare_fans("cone", {{{{0, 0}, {50, 0}, {0, 80}}}}, segments);
  compare_fans("tube", {{{{30, 0}, {50, 0}, {40, 80}, {30, 80}}}}, segments);
}

void plant_faults(TriangleMesh& mesh) {
  mesh.triangles.push_back(mesh.triangles[mesh.triangles.size() / 3]);
  mesh.triangles.erase(mesh.triangles.begin() +
                       static_cast<std::ptrdiff_t>(mesh.triangles.size() / 2));
  const TriangleMesh cube = revolve({{{{0, 0}, {14, 0}, {14, 20}, {0, 20}}}}, 4);
  const auto offset = static_cast<std::uint32_t>(mesh.points.size());
  for (const glm::dvec3& p : cube.points) mesh.points.push_back(p + glm::dvec3(60.1, 0.2, 90.3));
  for (const auto& [a, b, c] : cube.triangles)
    mesh.triangles.push_back({a + offset, b + offset, c + offset});
}

void repair_and_decimate(std::size_t triangles) {
  TriangleMesh mesh = vase(triangles);
  plant_faults(mesh);
  round_to_file(mesh.points);
  std::printf("%zu triangles with a hole, a duplicate and a cube through the wall\n",
              mesh.triangles.size());
  TriangleMesh result;
  StageTimes stages;
  RepairOptions options;
  options.progress = [&](std::string_view stage, double) { stages.begin(stage); };
  const Seconds repair = timed([&] {
    auto repaired = repair_mesh(mesh, options);
    if (!repaired) fail(repaired.error().message.c_str());
    result = std::move(repaired->mesh);
  });
  print_times("repair_mesh", repair);
  stages.print();
  std::printf("peak memory %.2f GB\n", peak_gb());
  print_times("decimate to a tenth", timed([&] {
                if (const auto done = decimate(result, result.triangles.size() / 10); !done)
                  fail(done.error().message.c_str());
              }));
  std::printf("peak memory %.2f GB\n", peak_gb());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "fans") {
    const std::size_t segments = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 30'000;
    if (segments < 3 || segments > kMaxTriangles / 8) fail("expected 3 to 2500000 segments");
    compare_fans(segments);
    return 0;
  }
  if (argc > 1 && std::string(argv[1]) == "repair") {
    const std::size_t triangles = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1'000'000;
    if (triangles < 1000 || triangles > kMaxTriangles / 2)
      fail("expected 1000 to 10000000 triangles");
    repair_and_decimate(triangles);
    return 0;
  }
  const std::size_t triangles = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 1'000'000;
  const std::size_t shells = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1;
  const std::size_t rounds = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 5;
  if (shells == 0 || triangles / shells < 1000 || triangles > kMaxTriangles || rounds == 0)
    fail(
        "expected at least 1000 triangles per shell, at most 20000000 in total, and at least 1 "
        "round");
  compare(shells, triangles, rounds);
}
