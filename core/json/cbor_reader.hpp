#pragma once
// Replaces the reader of nlohmann-json 3.11.2, which is not safe for untrusted input: nested
// indefinite strings (0x7f...) overflow its stack, it reads -2^64 as 0, and it accepts malformed
// UTF-8.

#include "core/json/json_builder.hpp"

#include <string_view>

namespace clay::inline json {

/// Reads exactly one CBOR item (RFC 8949) as events for `builder`. Definite lengths and text keys
/// only; no byte strings, no tags. Returns false when it refuses; the builder holds the reason.
bool read_cbor(std::string_view bytes, JsonBuilder& builder);

}  // namespace clay::inline json
