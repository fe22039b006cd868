#pragma once
#include "claystack/core/result.hpp"

#include <filesystem>
#include <string_view>

namespace clay::cli {

/// Keeps a pot that could not be written to `wanted`, under a name that says so: in `wanted`'s own
/// folder where `beside`, else in the state folder, else in the temporary one. Where it is; or the
/// error of the last attempt.
Result<std::filesystem::path> rescue(const std::filesystem::path& wanted, bool beside,
                                     std::string_view bytes);

}  // namespace clay::cli
