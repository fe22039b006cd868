// make_corpus FOLDER: writes valid files of every format to FOLDER/FORMAT for the fuzzers.

#include "tests/fuzz/mesh_promise.hpp"
#ifdef CLAYSTACK_APP
#include "tests/fuzz/program_readers.hpp"
#endif

#include <filesystem>
#include <fstream>
#include <iostream>

namespace {

/// False, with a message, if a file could not be written.
bool write_files(const std::filesystem::path& folder, const std::vector<std::string>& files) {
  std::filesystem::create_directories(folder);
  int number = 0;
  for (const std::string& bytes : files) {
    std::ofstream file(folder / std::to_string(++number), std::ios::binary);
    if ((file << bytes).flush()) continue;
    std::cerr << folder << ": could not write\n";
    return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace clay::solid;
  if (argc != 2) {
    std::cerr << "usage: make_corpus FOLDER\n";
    return 2;
  }
  const std::filesystem::path corpus = argv[1];
  for (const FormatFacts& facts : kFormatFacts)
    if (!write_files(corpus / name_of(facts.format), samples::good_files(facts.format))) return 3;
#ifdef CLAYSTACK_APP
  for (const clay::samples::TextReader& reader : clay::samples::program_readers(CLAYSTACK_SAMPLES))
    if (!write_files(corpus / reader.name, reader.good)) return 3;
#endif
  return 0;
}
