#pragma once
// Output as JSON, for scripts.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace clay::cli {

using Json = nlohmann::ordered_json;

/// One JSON document to standard output.
void print_json(const Json& data);
[[nodiscard]] bool json_printed() noexcept;  ///< whether print_json was called
/// The fields of samples/schema/error.schema.json, for the summary of a command that fails late.
[[nodiscard]] Json error_json(const Error& error);
/// As `report(error)`; the object on stdout also has these fields.
int report(const Error& error, Json fields);

/// The field of an object, which is a number.
[[nodiscard]] double number_field(const Json& object, const char* field);

/// A count for JSON: a number if it fits into 64 bits, otherwise decimal digits in a string.
[[nodiscard]] Json json_count(WideQuanta count);

}  // namespace clay::cli
