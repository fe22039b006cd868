#pragma once
#include <string>
#include <string_view>

namespace clay::chart {

/// For text and attributes of SVG and HTML. Invalid UTF-8, and characters that XML forbids, become
/// U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace clay::chart
