#pragma once
// Our own reader, because the one of nlohmann-json 3.11.2 may not meet a stranger's bytes: nested
// indefinite strings (0x7f...) overflow its stack, it reads -2^64 as 0, and it lets malformed
// UTF-8 pass.

#include "core/json/json_builder.hpp"

#include <string_view>

namespace clay::inline json {

/// One CBOR item (RFC 8949) and nothing behind it, as events for `builder`. Definite lengths and
/// text keys only; no byte strings, no tags. False, with the reason in the builder, when refused.
bool read_cbor(std::string_view bytes, JsonBuilder& builder);

}  // namespace clay::inline json
