#pragma once
// Damaged mesh files: words that are hostile to the text formats, and the first mutant that breaks
// the guarantee.

#include "tests/fuzz/mesh_promise.hpp"
#include "tests/fuzz/mutator.hpp"

#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::samples {

inline constexpr std::array<std::string_view, 28> kMeshWords = {
    "nan",
    "inf",
    "-inf",
    "1e39",
    "1e-50",
    "0",
    "-1",
    "-99",
    "//",
    "/",
    "\\\n",
    "4294967296",
    "\n",
    " ",
    "#",
    "f",
    "v",
    "facet",
    "solid",
    "endsolid",
    "vertex",
    "\"count\"",
    "<triangle",
    "</mesh>",
    "property list uchar int vertex_index",
    "end_header",
    "[",
    std::string_view("\0", 1)};
/// Of numbers and words in STL, OBJ, PLY, OFF, the XML of 3MF and the JSON of GLB.
inline constexpr std::string_view kMeshDelimiters = " \n\"<>=,:[]{}/";

/// A GLB whose chunk of JSON was damaged gets its lengths back, or no mutant reaches the reader of
/// the JSON.
inline std::string with_glb_lengths(std::string bytes, std::size_t old_size) {
  constexpr std::size_t kLengthAt = 8, kJsonLengthAt = 12;
  if (bytes.size() < 20) return bytes;
  std::uint32_t json = 0;
  std::memcpy(&json, bytes.data() + kJsonLengthAt, 4);
  json += static_cast<std::uint32_t>(bytes.size() - old_size);
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(bytes.data() + kLengthAt, &size, 4);
  std::memcpy(bytes.data() + kJsonLengthAt, &json, 4);
  return bytes;
}

/// The first of `count` mutants that breaks the promise; empty if all keep it. `before` is called
/// with each first.
template <class Before>
std::optional<std::string> first_broken(MeshFormat format, unsigned seed, std::size_t count,
                                        Before before) {
  const std::vector<std::string> good = good_files(format);
  test::Mutator mutator(seed, kMeshWords, kMeshDelimiters);
  for (std::size_t run = 0; run < count; ++run) {
    const std::string& whole = good[mutator.below(good.size())];
    std::string bytes = mutator.mutate(whole);
    if (format == MeshFormat::glb && run % 2 == 0)
      bytes = with_glb_lengths(std::move(bytes), whole.size());
    before(bytes);
    if (auto broken = broken_promise(bytes, format))
      return *broken + " in run " + std::to_string(run);
  }
  return std::nullopt;
}

}  // namespace clay::solid::samples
