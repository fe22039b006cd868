#pragma once
#include "claystack/core/result.hpp"

#include <filesystem>
#include <string_view>

namespace clay::cli {

/// Saves a pot that could not be written to `wanted`, under a name that marks it as rescued: in the
/// folder of `wanted` if `beside`, else in the state folder, else in the temporary folder. Returns
/// its path, or the error of the last attempt.
Result<std::filesystem::path> rescue(const std::filesystem::path& wanted, bool beside,
                                     std::string_view bytes);

}  // namespace clay::cli
