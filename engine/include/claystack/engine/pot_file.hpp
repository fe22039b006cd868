#pragma once
// `*.pot.json` and `*.pot.cbor`: one schema (samples/schema/pot.schema.json), exact integers.
// JSON adds the radii in mm for people; a reader checks that they agree with the integers.

#include "claystack/engine/pot.hpp"
#include "claystack/engine/result.hpp"

#include <string>
#include <string_view>

namespace clay {

enum class PotEncoding { json, cbor };

/// Takes CBOR (first byte that of a map) or JSON. Errors name line (JSON) or field (CBOR). The
/// ledger must balance to the quantum, or the file is refused.
Result<Pot> parse_pot(std::string_view bytes, std::string_view name);
/// Equal pots give equal bytes.
std::string write_pot(const Pot& pot, PotEncoding encoding);

}  // namespace clay
