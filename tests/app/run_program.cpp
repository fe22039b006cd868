#include "run_program.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace clay::test {

Ran shell(const std::string& command) {
  const ScratchFolder folder;
  const std::string out = folder.file("out"), err = folder.file("err");
  const std::string line =
      "timeout 300 sh -c '" + command + "' >" + out + " 2>" + err + " </dev/null";
  const int status = std::system(line.c_str());
  Ran run{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_text(out),
          read_text(err)};
  return run;
}

Ran claystack(const std::string& arguments) {
  return shell(std::string(CLAYSTACK_PROGRAM) + " " + arguments);
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "claystack-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no scratch folder: " + pattern);
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string sample(const std::string& name) { return std::string(CLAYSTACK_SAMPLES) + "/" + name; }

}  // namespace clay::test
