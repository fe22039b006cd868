#include "app/cli/rescue.hpp"

#include "claystack/core/atomic_file.hpp"
#include "core/user_folder.hpp"

#include <algorithm>
#include <string>
#include <system_error>

namespace clay::cli {
namespace {

namespace fs = std::filesystem;

/// "bowl.pot.json" becomes "bowl.rescued-20261121T230307-4711.pot.json": with time and process.
std::string rescued_name(const fs::path& wanted) {
  const std::string name = wanted == "-" ? "pot.pot.json" : wanted.filename().string();
  const std::size_t stem = std::min(name.find(".pot."), name.size());
  return name.substr(0, stem) + ".rescued-" + time_and_process() + name.substr(stem);
}

}  // namespace

Result<fs::path> rescue(const fs::path& wanted, bool beside, std::string_view bytes) {
  const std::string name = rescued_name(wanted);
  const auto keep_in = [&](const fs::path& folder) -> Result<fs::path> {
    return publish(folder / name, bytes).map([&] { return folder / name; });
  };
  if (beside)
    if (auto kept = keep_in(wanted.has_parent_path() ? wanted.parent_path() : ".")) return kept;
  std::error_code ignored;
  if (const fs::path state = user_folder(UserFolder::state); !state.empty()) {
    fs::create_directories(state / "rescued", ignored);
    if (auto kept = keep_in(state / "rescued")) return kept;
  }
  return keep_in(fs::temp_directory_path(ignored));
}

}  // namespace clay::cli
