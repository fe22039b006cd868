#pragma once
// Texts in the parts of a 3MF package.

#include <cstddef>
#include <string>
#include <string_view>

namespace clay::solid::inline formats::three_mf {

inline constexpr std::string_view kDeclaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

/// One line of XML, for attributes and text.
[[nodiscard]] std::string xml_escaped(std::string_view text);

/// The name of a body, counted from 1: that of the object, unless it has several bodies.
[[nodiscard]] std::string body_name(const std::string& name, std::size_t number,
                                    std::size_t bodies);

}  // namespace clay::solid::inline formats::three_mf
