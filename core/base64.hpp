#pragma once
// Base64 (RFC 4648) for bytes inside XML and HTML.

#include <optional>
#include <string>
#include <string_view>

namespace clay {

[[nodiscard]] std::string to_base64(std::string_view bytes);
/// Ignores white space; empty if the rest is not Base64.
[[nodiscard]] std::optional<std::string> from_base64(std::string_view text);

}  // namespace clay
