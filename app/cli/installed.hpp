#pragma once
// Paths of the installed program, for messages that name files.

#include <filesystem>

namespace clay::cli {

/// A file below the prefix, such as "share/claystack/samples": relative to this program, even if
/// its folder was moved; otherwise below the prefix of the build.
[[nodiscard]] std::filesystem::path installed(const std::filesystem::path& below_prefix);

}  // namespace clay::cli
