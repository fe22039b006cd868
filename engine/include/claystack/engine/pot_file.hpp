#pragma once
// `*.pot.json` and `*.pot.cbor`: one schema (samples/schema/pot.schema.json), exact integers.
// JSON adds the radii in mm for people; a reader checks that they agree with the integers. Radii
// of a rounded pot are stored as second differences, a byte or two each in CBOR.

#include "claystack/engine/pot.hpp"
#include "claystack/engine/result.hpp"

#include <string>
#include <string_view>

namespace clay {

enum class PotEncoding { json, cbor };

/// Takes CBOR (first byte that of a map) or JSON. Errors name line (JSON) or field (CBOR). The
/// ledger must balance to the quantum, or the file is refused.
Result<Pot> parse_pot(std::string_view bytes, std::string_view name);
/// Equal pots give equal bytes. A pot whose radii are not the multiples that `Pot::rounding` says
/// is written as an exact one.
std::string write_pot(const Pot& pot, PotEncoding encoding);

}  // namespace clay
