#pragma once
// Base64 (RFC 4648) for bytes inside XML and HTML.

#include <optional>
#include <string>
#include <string_view>

namespace clay {

[[nodiscard]] std::string to_base64(std::string_view bytes);
/// Ignores white space; empty if anything else does not fit.
[[nodiscard]] std::optional<std::string> from_base64(std::string_view text);

}  // namespace clay
