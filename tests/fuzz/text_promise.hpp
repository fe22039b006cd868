#pragma once
// The guarantee of the readers of Claystack's own files for arbitrary bytes, and initial files.

#include "app/strokes/strokes.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/walls.hpp"
#include "tests/fuzz/mutator.hpp"

#include <array>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

namespace clay::samples {

/// The name of every damaged file; errors begin with it.
inline constexpr std::string_view kFuzzed = "fuzzed";

/// A reader with the files that it is tried on.
struct TextReader {
  std::string name;
  std::vector<std::string> good;
  /// Reads the bytes; a file that was read is written and read again.
  std::function<std::optional<std::string>(std::string_view)> broken_promise;
  /// Of a format whose lines have checksums: the message of its error, empty for a value.
  std::function<std::string(std::string_view)> error = {};

  /// A damaged file, whose lines get the checksums that the reader expects: otherwise the reader
  /// would refuse every such line before it reads the contents.
  [[nodiscard]] std::string with_checksums(std::string bytes) const {
    static const std::regex wrong(
        "expected ([0-9a-f]{16}) for th(?:ese poses|is line), found \"?([0-9a-f]{16})");
    for (int line = 0; error && line < 20; ++line) {
      std::smatch found;
      const std::string message = error(bytes);
      if (!std::regex_search(message, found, wrong)) break;
      const std::size_t at = bytes.find(found.str(2));
      if (at == std::string::npos) break;
      bytes.replace(at, found.length(2), found.str(1));
    }
    return bytes;
  }
};

/// The message of a reader's error; empty for a value.
template <class Parse>
auto error_of(Parse parse) {
  return [parse](std::string_view bytes) {
    const auto value = parse(bytes, kFuzzed);
    return value ? std::string() : value.error().message;
  };
}

/// Empty if the guarantee holds: an error that names the file, or a value whose file is read back
/// and written to the same bytes.
template <class Parse, class Write>
std::optional<std::string> round_trip(std::string_view bytes, Parse parse, Write write) {
  const auto value = parse(bytes, kFuzzed);
  if (!value)
    return value.error().message.starts_with(kFuzzed)
               ? std::nullopt
               : std::optional("unnamed error: " + value.error().message);
  const std::string written = write(*value);
  const auto again = parse(written, kFuzzed);
  if (!again) return "its own output is refused: " + again.error().message;
  if (write(*again) != written) return "a second write gives other bytes";
  return std::nullopt;
}

inline std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A few lines of a file of lines; `last` is the end of the last one.
inline std::string first_lines(const std::string& text, std::size_t lines) {
  std::size_t end = 0;
  while (lines-- > 0 && end != std::string::npos) end = text.find('\n', end + 1);
  return end == std::string::npos ? text : text.substr(0, end + 1);
}

/// Pots of few rings: exact, rounded and in both encodings.
inline std::vector<std::string> good_pots(PotEncoding encoding) {
  const ClayStack stack = ClayStack::cylinder(6, 2.5, 40.0, 30.0, 20).value();
  Pot pot{stack, Ledger{.initial = stack.recount()}, Model::conserving, 1.9, {}, {}};
  std::vector<std::string> files{write_pot(pot, encoding)};
  pot.collapse = Collapse{.failed_ring = 2, .pivot_mm = {0, 5, 0}, .axis = {1, 0, 0}};
  files.push_back(write_pot(pot, encoding));
  if (const auto rounded = rounded_pot(pot, 0.001)) files.push_back(write_pot(*rounded, encoding));
  return files;
}

inline std::string good_certificate() {
  solid::SolidCertificate certificate;
  certificate.format = "stl_binary";
  certificate.content_hash = certificate.profile_hash = std::string(32, '0');
  certificate.segments = 64;
  certificate.profile.pieces = {{{0, 0}, {30, 0}, {32, 40}, {28, 40}, {27, 4}, {0, 4}}};
  return solid::write_certificate(certificate);
}

/// The promise of a reader without a writer.
template <class Parse>
auto read_only(Parse parse) {
  return [parse](std::string_view bytes) -> std::optional<std::string> {
    const auto value = parse(bytes, kFuzzed);
    if (value || value.error().message.starts_with(kFuzzed)) return std::nullopt;
    return "unnamed error: " + value.error().message;
  };
}

/// Those of engine, export and strokes; `folder` is samples/.
inline std::vector<TextReader> text_readers(const std::string& folder) {
  const auto pot = [](PotEncoding encoding) {
    return [encoding](std::string_view bytes) {
      return round_trip(bytes, parse_pot,
                        [&](const Pot& value) { return write_pot(value, encoding); });
    };
  };
  const auto work = [](std::string_view bytes) {
    return round_trip(
        bytes,
        [](std::string_view text, std::string_view name) {
          (void)salvage_work(text, name);
          return parse_work(text, name);
        },
        [](const WorkReading& reading) { return write_work(reading.work); });
  };
  return {
      {"scene",
       {text_of(folder + "/bowl.scene.json"), text_of(folder + "/paper/collapse.scene.json")},
       [](std::string_view bytes) { return round_trip(bytes, parse_scene, write_scene); }},
      {"session",
       {first_lines(text_of(folder + "/bowl.session"), 3)},
       [](std::string_view bytes) { return round_trip(bytes, parse_session, write_session); },
       error_of(parse_session)},
      {"pot_json", good_pots(PotEncoding::json), pot(PotEncoding::json)},
      {"pot_cbor", good_pots(PotEncoding::cbor), pot(PotEncoding::cbor)},
      {"work", {first_lines(text_of(folder + "/mouse.work"), 8)}, work, error_of(parse_work)},
      {"process", {text_of(folder + "/workshop.process.json")}, read_only(solid::parse_process)},
      {"certificate",
       {good_certificate()},
       [](std::string_view bytes) {
         return round_trip(bytes, solid::parse_certificate, solid::write_certificate);
       }},
      {"strokes",
       {text_of(folder + "/strokes/bowl.strokes.json")},
       read_only(strokes::parse_strokes)}};
}

/// JSON's own, and hostile to it; a word may end one value and begin another.
inline constexpr std::array<std::string_view, 20> kJsonWords = {
    "null",
    "true",
    "-1",
    "0",
    "1e308",
    "1e-320",
    "18446744073709551616",
    "{}",
    "[]",
    "\"\"",
    "\"x\"",
    "[[[[[[[[[[",
    "{\"a\":{\"a\":",
    "-9223372036854775808",
    "\"\\u0000\"",
    ",",
    "\"\xFF\"",
    "2.5",
    "\n",
    "99999999999999999999999999999999999999999"};
inline constexpr std::string_view kJsonDelimiters = " \n,:[]{}\"";

/// The first of `count` mutants that breaks the promise; empty if all keep it. `before` is called
/// with each first.
template <class Before>
std::optional<std::string> first_broken(const TextReader& reader, unsigned seed, std::size_t count,
                                        Before before) {
  test::Mutator mutator(seed, kJsonWords, kJsonDelimiters);
  for (std::size_t run = 0; run < count; ++run) {
    std::string bytes = mutator.mutate(reader.good[mutator.below(reader.good.size())]);
    if (run % 2 == 0) bytes = reader.with_checksums(std::move(bytes));
    before(bytes);
    if (auto broken = reader.broken_promise(bytes))
      return *broken + " in run " + std::to_string(run) + ":\n" + bytes;
  }
  return std::nullopt;
}

}  // namespace clay::samples
