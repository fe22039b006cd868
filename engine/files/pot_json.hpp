#pragma once
#include "claystack/engine/clay.hpp"
#include "core/json/json_builder.hpp"
#include "core/json/located_json.hpp"

namespace clay::files {

/// Four numbers a ring, and the rest.
inline constexpr std::size_t kMaxPotValues = 4 * kMaxRings + 1000;

/// The pot as a file of JSON holds it, with radii for people where asked for.
Json pot_json(const Pot& pot, bool for_people);
Result<Pot> pot_of(const LocatedJson& document);

}  // namespace clay::files
