#include "app/cli/output_files.hpp"

#include "claystack/core/atomic_file.hpp"
#include "core/system_calls.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

namespace clay::cli {
namespace {

namespace fs = std::filesystem;

/// Endings in .json that belong to one kind.
constexpr std::array<std::string_view, 5> kOwnEndings = {
    ".scene.json", ".pot.json", ".process.json", ".certificate.json", ".strokes.json"};

bool names_the_kind(const OutputFile& file) {
  const auto ends = [&](std::string_view ending) { return ends_ignoring_case(file.path, ending); };
  const auto own = std::ranges::find_if(kOwnEndings, ends);
  if (own != kOwnEndings.end()) return std::ranges::find(file.endings, *own) != file.endings.end();
  return std::ranges::any_of(file.endings, ends);
}

/// A file by its path without links, and by its number if it is on disk.
struct Place {
  explicit Place(const std::string& name) {
    std::error_code ignored;
    path = fs::weakly_canonical(behind_links(fs::absolute(name, ignored)), ignored);
    struct stat status {};
    exists = ::stat(name.c_str(), &status) == 0;
    regular = exists && S_ISREG(status.st_mode);
    if (regular) number = {status.st_dev, status.st_ino};
  }
  [[nodiscard]] bool same_file(const Place& other) const {
    return path == other.path || (regular && other.regular && number == other.number);
  }

  fs::path path;
  bool exists = false, regular = false;
  std::pair<dev_t, ino_t> number{};
};

struct Taken {
  Place place;
  std::string text;  ///< "the input bowl.stl"
};

bool on_disk(const std::string& name) { return !name.empty() && name != "-"; }

Result<void> check_output(const OutputFile& file, const Place& place,
                          const std::vector<Taken>& taken, const Console& console) {
  const bool stream = place.exists && !place.regular && !fs::is_directory(place.path);
  if (!stream && !file.endings.empty() && !names_the_kind(file))
    return failure(ErrorKind::bad_input, fmt::format("{}: expected a name that ends in {}, found "
                                                     "the name of another kind of file",
                                                     file.path, fmt::join(file.endings, " or ")));
  for (const Taken& other : taken)
    if (place.same_file(other.place))
      return failure(ErrorKind::bad_input,
                     fmt::format("{}: expected a separate output file, found the same file as {}",
                                 file.path, other.text));
  if (place.regular && console.no_overwrite)
    return failure(ErrorKind::bad_input,
                   file.path + ": expected a new file with --no-overwrite, found an existing one");
  if (stream) return {};  // opening a pipe and closing it would end its reader
  return AtomicFile::create(file.path).map([](const AtomicFile&) {});
}

/// Each standard stream takes one document.
Result<void> check_streams(const std::vector<OutputFile>& outputs,
                           const std::vector<std::string>& inputs, const Console& console) {
  if (const auto read = std::ranges::count(inputs, "-"); read > 1)
    return failure(ErrorKind::bad_input,
                   fmt::format("-: expected at most one input on standard input, found {}", read));
  const auto streams = std::ranges::count(outputs, "-", &OutputFile::path);
  if (streams > 1)
    return failure(
        ErrorKind::bad_input,
        fmt::format("-: expected at most one output on standard output, found {}", streams));
  if (streams == 1 && console.json)
    return failure(ErrorKind::bad_input,
                   "-: expected no --json with it, because both write to standard output");
  return {};
}

}  // namespace

Result<void> check_outputs(const std::vector<OutputFile>& outputs,
                           const std::vector<std::string>& inputs, const Console& console) {
  if (auto streams = check_streams(outputs, inputs, console); !streams) return streams;
  std::vector<Taken> taken;
  for (const std::string& input : inputs)
    if (on_disk(input)) taken.push_back({Place(input), "the input " + input});
  for (const OutputFile& output : outputs) {
    if (!on_disk(output.path)) continue;
    const Place place(output.path);
    if (auto good = check_output(output, place, taken, console); !good) return good;
    taken.push_back({place, "the output " + output.path});
  }
  return {};
}

Result<void> check_output_folder(const std::string& folder, const Console& console) {
  std::error_code none;
  if (!console.no_overwrite || folder.empty() || !fs::exists(folder, none) ||
      fs::is_empty(folder, none) || none)
    return {};
  return failure(ErrorKind::bad_input,
                 folder + ": expected an empty folder with --no-overwrite, found files in it");
}

}  // namespace clay::cli
