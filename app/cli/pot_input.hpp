#pragma once
// Pots as input files: the one way in which commands and window read them.

#include "claystack/core/result.hpp"
#include "claystack/engine/files.hpp"

#include <string>
#include <string_view>

namespace clay::cli {

/// What a pot may be read from, for help texts.
inline constexpr std::string_view kPotInputs = ".pot.json, .pot.cbor, or a .3mf by Claystack";

/// By the file name's extension, ignoring case.
[[nodiscard]] bool is_3mf(std::string_view path);

/// A pot file, or the pot that a 3MF carries (by its first bytes).
Result<Pot> pot_from(std::string_view bytes, std::string_view name);
Result<Pot> read_pot(const std::string& path);

}  // namespace clay::cli
