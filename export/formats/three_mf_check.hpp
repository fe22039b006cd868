#pragma once
#include "claystack/core/result.hpp"

#include <string_view>

namespace clay::solid::inline formats {

/// Whether the model part of a package is exactly this one: unpacked piece by piece, not kept in
/// memory. Errors as for `decode_3mf`; `unsound` if it is another one.
[[nodiscard]] Result<void> check_model_in_3mf(std::string_view bytes, std::string_view model,
                                              std::string_view name);

}  // namespace clay::solid::inline formats
