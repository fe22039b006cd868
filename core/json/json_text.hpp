#pragma once
#include "core/json/json_builder.hpp"

#include <string>

namespace clay::inline json {

/// JSON for people: one member per line, numbers ten per row. The same value gives the same bytes
/// on every platform.
std::string json_text(const Json& value);

/// JSON for reports and settings: one member or element per line. Invalid UTF-8, as of file names,
/// is replaced, because JSON cannot hold it.
std::string json_document(const Json& value);

/// The same on one line, without its end.
std::string json_line(const Json& value);

}  // namespace clay::inline json
