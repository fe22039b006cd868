// make_corpus FOLDER: writes valid files of every format to FOLDER/FORMAT for the fuzzers.

#include "tests/fuzz/mesh_promise.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>

int main(int argc, char** argv) {
  using namespace clay::solid;
  if (argc != 2) {
    std::cerr << "usage: make_corpus FOLDER\n";
    return 2;
  }
  for (const FormatFacts& facts : kFormatFacts) {
    const MeshFormat format = facts.format;
    const auto folder = std::filesystem::path(argv[1]) / name_of(format);
    std::filesystem::create_directories(folder);
    int number = 0;
    for (const std::string& bytes : samples::good_files(format)) {
      std::ofstream file(folder / std::to_string(++number), std::ios::binary);
      if (!(file << bytes).flush()) {
        std::cerr << folder << ": could not write\n";
        return 3;
      }
    }
  }
}
