#pragma once
// Where the program was installed, for messages that name files.

#include <filesystem>

namespace clay::cli {

/// A file below the prefix, such as "share/claystack/samples": beside this program, wherever the
/// folder was moved to; otherwise below the prefix of the build.
[[nodiscard]] std::filesystem::path installed(const std::filesystem::path& below_prefix);

}  // namespace clay::cli
