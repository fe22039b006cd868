// Pot to binary STL, whole process, compared with a program that only writes as many bytes, and
// with other programs if installed. Usage: export_bench [ROUNDS] [FOLDER]

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "tests/bench/process.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace clay::bench {
namespace {

namespace fs = std::filesystem;

/// A bellied vase with throwing marks, so that no two rings are equal.
Pot rippled_vase(std::size_t rings) {
  std::vector<Ring> stack;
  const double height_mm = 200.0;
  for (std::size_t i = 0; i < rings; ++i) {
    const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(rings);
    const double outer = 50.0 + 18.0 * std::sin(6.9 * t - 0.6) - 8.0 * t + 0.3 * std::sin(250 * t);
    stack.push_back({quanta_from_radius(outer), t < 0.03 ? 0 : quanta_from_radius(outer - 3.0)});
  }
  Pot pot;
  pot.stack =
      ClayStack::from_rings(height_mm / static_cast<double>(rings), std::move(stack), 0).value();
  pot.ledger.initial = pot.stack.volume();
  return pot;
}

/// The reference: writes as many bytes, syncs and renames.
int only_write(const std::string& path, std::size_t bytes, bool sync) {
  const std::vector<char> block(1 << 20, 'x');
  const std::string temporary = path + ".part";
  const int file = ::open(temporary.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0666);
  while (bytes > 0) {
    const ssize_t count = ::write(file, block.data(), std::min(bytes, block.size()));
    if (count <= 0) return 1;
    bytes -= static_cast<std::size_t>(count);
  }
  if (sync && ::fsync(file) != 0) return 1;
  ::close(file);
  return std::rename(temporary.c_str(), path.c_str());
}

void write_openscad(const fs::path& path, const Pot& pot, std::size_t segments) {
  std::ofstream file(path);
  file.precision(17);
  file << "$fn=" << segments << "; rotate_extrude() polygon([";
  const double h = pot.stack.ring_height_mm();
  double y = 0.0;
  std::string inside;
  for (const Ring& ring : pot.stack.rings()) {
    file << '[' << ring.outer_mm() << ',' << y << "],";
    y += h;
  }
  file << "[0," << y << "],[0,0]]);\n";
}

void compare(std::size_t rings, std::size_t segments, int rounds, const fs::path& folder,
             const std::string& self) {
  const Pot pot = rippled_vase(rings);
  const std::string name = (folder / std::to_string(rings)).string();
  if (!publish(name + ".pot.cbor", write_pot(pot, PotEncoding::cbor))) std::exit(3);
  const std::vector<std::string> exporting{
      CLAYSTACK_PROGRAM, "export",  "-q",         name + ".pot.cbor",      name + ".stl",
      "--tolerance",     "0.00005", "--segments", std::to_string(segments)};
  race({{"warm up", exporting}}, 1);
  const std::string bytes = std::to_string(fs::file_size(name + ".stl"));
  std::vector<Contestant> contestants{
      {"write, sync and rename only", {self, "--write", name + ".raw", bytes, "sync"}},
      {"write and rename only", {self, "--write", name + ".raw", bytes, "no"}},
      {"claystack export (proved, read back)", exporting}};
  if (installed("openscad") && rings <= 200) {
    write_openscad(name + ".scad", pot, segments);
    contestants.push_back({"openscad rotate_extrude (outside only)",
                           {"openscad", "-q", "--export-format", "binstl", "-o", name + ".scad.stl",
                            name + ".scad"}});
  }
  print(std::to_string(rings) + " rings x " + std::to_string(segments) + " segments, " + bytes +
            " bytes",
        race(contestants, rounds));
}

int main(int count, char** words) {
  if (count == 5 && std::string(words[1]) == "--write")
    return only_write(words[2], std::stoull(words[3]), std::string(words[4]) == "sync");
  const int rounds = count > 1 ? std::atoi(words[1]) : 9;
  if (rounds < 1) {
    std::fprintf(stderr, "export_bench: expected at least 1 round, found %s\n", words[1]);
    return 2;
  }
  const fs::path folder = count > 2 ? fs::path(words[2]) : fs::temp_directory_path() / "claystack";
  fs::create_directories(folder);
  print("start-up",
        race({{"true", {"true"}}, {"claystack --version", {CLAYSTACK_PROGRAM, "--version"}}},
             3 * rounds));
  compare(200, 256, 3 * rounds, folder, words[0]);
  compare(2000, 1024, rounds, folder, words[0]);
  if (count <= 2) fs::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace clay::bench

int main(int count, char** words) { return clay::bench::main(count, words); }
