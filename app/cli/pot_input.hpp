#pragma once
// Pots as input files: commands and window read them here.

#include "app/cli/console.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/files.hpp"
#ifdef CLAYSTACK_EXPORT
#include "claystack/export/solid.hpp"

#include <optional>
#endif

#include <string>
#include <string_view>

namespace clay::cli {

/// The kinds of files that hold a pot, for help texts.
inline constexpr std::string_view kPotInputs = ".pot.json, .pot.cbor, or a .3mf by Claystack";

/// By the file name's extension, ignoring case.
[[nodiscard]] bool is_3mf(std::string_view path);

/// A pot file, or the pot that a 3MF carries (by its first bytes).
Result<Pot> pot_from(std::string_view bytes, std::string_view name);
Result<Pot> read_pot(const std::string& path);
/// The same; of a 3MF with a note on the pot inside, and a warning if its mesh is no longer that of
/// the pot.
Result<Pot> read_pot(const std::string& path, const Console& console);

#ifdef CLAYSTACK_EXPORT
/// Whether the file is a 3MF that carries its pot.
[[nodiscard]] bool carries_pot(const std::string& path);

/// The difference in words if the mesh beside a pot cannot be of that pot: another program may have
/// scaled or cut it, or added other objects. Empty if it may be, in its own size or enlarged
/// for a shrinkage of up to 20 %, as clays have: the file does not state the shrinkage of the
/// export. The mesh may be moved, or turned about the vertical.
[[nodiscard]] std::optional<std::string> mesh_differs(const solid::TriangleMesh& mesh,
                                                      const Pot& pot);
/// "77.1 mm wide and 129.7 mm high; the mesh is 84.6 mm wide and 143.6 mm high, 1.10 and 1.11 times
/// as much";
/// empty if the mesh is as large as the pot, within a hundredth.
[[nodiscard]] std::optional<std::string> other_size(const solid::TriangleMesh& mesh,
                                                    const Pot& pot);
#endif

}  // namespace clay::cli
