#pragma once
// Numbers with a unit on the command line: "350ml", "1.5 kg", "10mm".

#include "claystack/core/result.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace clay::cli {

/// A unit and its factor.
struct Unit {
  std::string_view name;
  double factor;
};

/// Factors to mm.
inline constexpr std::array kLengthUnits{Unit{"mm", 1.0}, Unit{"cm", 10.0}, Unit{"in", 25.4}};
/// Factors to ml; the ounce is the fluid ounce of the US.
inline constexpr std::array kVolumeUnits{Unit{"ml", 1.0}, Unit{"cl", 10.0}, Unit{"l", 1000.0},
                                         Unit{"oz", 29.5735295625}};
/// Factors to g; the pound and the ounce are those of shops (avoirdupois).
inline constexpr std::array kWeightUnits{Unit{"g", 1.0}, Unit{"kg", 1000.0},
                                         Unit{"oz", 28.349523125}, Unit{"lb", 453.59237}};

/// A number in the unit that it names, in capitals or not, or else in `usual`, one of the units
/// (empty: the first); in the first unit. Empty for any other text.
[[nodiscard]] std::optional<double> number_with_unit(std::string_view text,
                                                     std::span<const Unit> units,
                                                     std::string_view usual = {});

/// "350ml", "0.35 l", "350": a number above 0 in the first of the units, or in the one that it
/// names, in capitals or not. Errors of kind `bad_input` list the units.
Result<double> quantity_of(std::string_view text, std::span<const Unit> units);

/// "10mm", "1 cm", "0.4in", or "10", which is in mm: a length within these limits [mm]. Errors of
/// kind `bad_input` state limits and units.
Result<double> length_of(std::string_view text, double low_mm, double high_mm);

/// "expected 0 or a length ...": the error of an option that takes a word, too.
[[nodiscard]] Error or_else(std::string_view word, const Error& error);

/// Whether 0 is read, too: the part is absent.
enum class OrNone : bool { no, yes };

/// Replaces a text by the length in mm, as a number.
[[nodiscard]] CLI::Validator length_within(double low_mm, double high_mm, OrNone zero = OrNone::no);
/// The name of a value of a length in the help.
inline constexpr const char* kLengthName = "LENGTH";

/// Adds an option for a length. Every length of the command line is read by it or by `length_of`,
/// and may have a unit. `value`: a double or an optional of it [mm]. Without limits any finite
/// length is read.
template <class Value>
CLI::Option* add_length(CLI::App& command, const std::string& name, Value& value,
                        const std::string& help,
                        double low_mm = std::numeric_limits<double>::lowest(),
                        double high_mm = std::numeric_limits<double>::max()) {
  return command.add_option(name, value, help)
      ->type_name(kLengthName)
      ->transform(length_within(low_mm, high_mm));
}

}  // namespace clay::cli
