#pragma once
// The guarantee of `import` for arbitrary bytes, and initial files.

#include "app/import/drawn_pot.hpp"
#include "tests/fuzz/mutator.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::importing::samples {

/// Empty if the guarantee holds: an error with a message that names the file, or a pot whose ledger
/// balances. `name` ends in the extension of the format.
inline std::optional<std::string> broken_promise(std::string_view bytes, const std::string& name) {
  const auto pot =
      read_drawing(bytes, name)
          .and_then([&](Drawing&& drawing) { return half_section(std::move(drawing), {}, name); })
          .and_then([&](HalfSection&& section) { return drawn_pot(section, {}, name); });
  if (!pot)
    return pot.error().message.starts_with(name)
               ? std::nullopt
               : std::optional("unnamed error: " + pot.error().message);
  if (pot->pot.stack.recount() != pot->pot.ledger.initial)
    return "a pot whose ledger does not balance";
  return std::nullopt;
}

/// "code value code value ..." as a DXF file.
inline std::string dxf_of(std::string_view words) {
  std::string text;
  for (const char c : words) text += c == ' ' ? '\n' : c;
  return text + "\n";
}

/// Small drawings that use most features of a reader: their mutations reach deep code.
inline std::vector<std::string> good_drawings(std::string_view format) {
  if (format == "csv")
    return {"radius_mm,height_mm\n30,0\n32,4\n33.5,40\n36,80\n", "0,0\n30,0\n30,60\n26,60\n26,5\n",
            "Height (cm);Note;Radius (in)\n0;a;1,5\n5,5;b;1,25\n",
            "# two\n0;0\n40;0\n\n40;0\n35;70 # rim\n"};
  if (format == "svg")
    return {
        "<svg xmlns='http://www.w3.org/2000/svg' width='90mm' height='90mm' viewBox='0 0 90 90'>"
        "<style>.a{display:inline} .b{display:none}</style><defs><symbol id='s' viewBox='0 0 9 9'>"
        "<rect width='4' height='9' rx='1'/></symbol></defs><g transform='translate(5 3) scale(2)'>"
        "<path class='a' transform='scale(1 -1)' d='M 0 0 H 30 C 32 10 33 20 30 30 q 2 5 0 9 A 9 5 "
        "3 "
        "0 1 "
        "20 40 L 0 40 z m 1 1'/></g><use href='#s' x='3' class='b'/><circle cx='5' cy='5' r='0.5' "
        "visibility='hidden'/></svg>",
        "<svg xmlns='http://www.w3.org/2000/svg'><polygon points='0,0 30,0 25,60 0,60'/></svg>"};
  return {
      dxf_of(
          "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 TABLES 0 TABLE 2 LAYER 0 LAYER "
          "2 Hidden 70 1 62 7 0 ENDTAB 0 ENDSEC 0 SECTION 2 BLOCKS 0 BLOCK 8 0 2 foot 10 0 20 0 0 "
          "LINE 8 0 10 0 20 0 11 30 21 0 0 ENDBLK 0 ENDSEC 0 SECTION 2 ENTITIES 0 INSERT 8 0 2 "
          "foot "
          "10 0 20 0 41 1 42 1 50 0 0 LWPOLYLINE 8 0 90 4 70 0 10 30 20 0 42 0.3 10 60 20 55 42 0 "
          "10 "
          "56 20 55 42 -0.3 10 28 20 5 0 LINE 8 0 10 28 20 5 11 0 21 5 0 LINE 8 Hidden 10 3 20 4 "
          "11 "
          "5 21 6 0 LEADER 8 0 76 2 10 1 20 2 10 3 20 4 0 ENDSEC 0 EOF"),
      dxf_of(
          "0 SECTION 2 ENTITIES 0 POLYLINE 8 0 66 1 70 0 0 VERTEX 8 0 10 0 20 0 0 VERTEX 8 0 10 30 "
          "20 0 42 0.1 0 VERTEX 8 0 10 30 20 60 0 SEQEND 0 ARC 8 0 10 20 20 60 40 10 50 0 51 90 0 "
          "SPLINE 8 0 70 0 71 2 72 6 73 3 40 0 40 0 40 0 40 1 40 1 40 1 10 20 20 70 10 10 20 75 10 "
          "0 "
          "20 70 0 ENDSEC 0 EOF"),
      dxf_of("0 SECTION 2 ENTITIES 0 ELLIPSE 8 0 10 0 20 0 11 0 21 60 40 0.5 41 3.14159265 42 "
             "6.28318531 0 ENDSEC 0 EOF")};
}

/// Hostile words for mutations of each format.
inline std::vector<std::string_view> hostile_words(std::string_view format) {
  if (format == "csv") return {"nan", "-inf", "1e39", ";", ",", "#", "\n\n", "cm", "1,5", "0"};
  if (format == "svg")
    return {"nan", "1e308", "-",    "z",   "M", "A",      "<use href='#s'/>",
            "<g",  "</g>",  "&lt;", "]]>", "'", "id='s'", "scale(1e9)",
            "e",   "0"};
  return {"nan",
          "1e308",
          "-1",
          "4294967296",
          "0\nPOLYLINE\n",
          "0\nSEQEND\n",
          "0\nINSERT\n2\nfoot\n",
          "73\n9\n",
          "90\n0\n",
          "0\nLEADER\n",
          "\n",
          "EOF",
          "SPLINE",
          "999\n",
          "0"};
}

/// The first of `count` mutants that breaks the promise; empty if all keep it. `before` is called
/// with each first.
template <class Before>
std::optional<std::string> first_broken(const std::string& format, unsigned seed, std::size_t count,
                                        Before before) {
  const auto good = good_drawings(format);
  const auto words = hostile_words(format);
  test::Mutator mutator(seed, words);
  for (std::size_t run = 0; run < count; ++run) {
    const std::string bytes = mutator.mutate(good[mutator.below(good.size())]);
    before(bytes);
    if (auto broken = broken_promise(bytes, "mutant." + format))
      return *broken + " in run " + std::to_string(run) + ":\n" + bytes;
  }
  return std::nullopt;
}

}  // namespace clay::importing::samples
