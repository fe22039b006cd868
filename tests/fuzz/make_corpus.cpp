// make_corpus FOLDER: for the fuzzers, writes valid files of every format to FOLDER/FORMAT, and the
// words of formats other than JSON to FOLDER/FORMAT.dict.

#include "tests/fuzz/mesh_promise.hpp"
#include "tests/fuzz/mesh_words.hpp"
#ifdef CLAYSTACK_APP
#include "tests/fuzz/program_readers.hpp"
#endif
#ifdef CLAYSTACK_DRAWINGS
#include "tests/fuzz/drawing_promise.hpp"
#endif

#include <cstdio>
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

/// In the syntax of libFuzzer: all bytes as \xAB, so that no byte needs a special escape.
bool write_dictionary(const std::filesystem::path& path, const auto& words) {
  std::ofstream file(path);
  for (const std::string_view word : words) {
    file << '"';
    for (const char c : word) {
      char code[5];
      std::snprintf(code, sizeof code, "\\x%02X",
                    static_cast<unsigned>(static_cast<unsigned char>(c)));
      file << code;
    }
    file << "\"\n";
  }
  if (file.flush()) return true;
  std::cerr << path << ": could not write\n";
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace clay::solid;
  if (argc != 2) {
    std::cerr << "usage: make_corpus FOLDER\n";
    return 2;
  }
  const std::filesystem::path corpus = argv[1];
  for (const FormatFacts& facts : kFormatFacts) {
    const std::string name(name_of(facts.format));
    if (!write_files(corpus / name, samples::good_files(facts.format)) ||
        !write_dictionary(corpus / (name + ".dict"), samples::kMeshWords))
      return 3;
  }
#ifdef CLAYSTACK_APP
  for (const clay::samples::TextReader& reader : clay::samples::program_readers(CLAYSTACK_SAMPLES))
    if (!write_files(corpus / reader.name, reader.good)) return 3;
#endif
#ifdef CLAYSTACK_DRAWINGS
  namespace drawings = clay::importing::samples;
  for (const std::string format : {"svg", "dxf", "csv"})
    if (!write_files(corpus / ("drawing_" + format), drawings::good_drawings(format)) ||
        !write_dictionary(corpus / ("drawing_" + format + ".dict"),
                          drawings::hostile_words(format)))
      return 3;
#endif
  return 0;
}
