#pragma once
#include "claystack/engine/clay.hpp"
#include "core/json/json_builder.hpp"
#include "core/json/located_json.hpp"

namespace clay::files {

/// Four numbers per ring, plus the other fields.
inline constexpr std::size_t kMaxPotValues = 4 * kMaxRings + 1000;

/// The JSON document of a pot, optionally with radii for people.
Json pot_json(const Pot& pot, bool for_people);
Result<Pot> pot_of(const LocatedJson& document);

}  // namespace clay::files
