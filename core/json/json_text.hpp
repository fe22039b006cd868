#pragma once
#include "core/json/json_builder.hpp"

#include <string>

namespace clay::inline json {

/// JSON for people: one member per line, numbers ten per row. The same value gives the same bytes
/// on every platform.
std::string json_text(const Json& value);

/// JSON on one line.
std::string json_line(const Json& value);

}  // namespace clay::inline json
