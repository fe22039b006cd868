#pragma once
#include <string>
#include <string_view>

namespace clay::chart {

/// For the text and the attributes of SVG and HTML. What is no UTF-8, or no character that XML
/// allows, becomes U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace clay::chart
