#pragma once
// Usage errors in the form of all other errors: what was expected, and what was found.

#include "claystack/core/result.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace clay::cli {

/// Checks of the value of an option: an empty text, or what was expected and found.
using ValueCheck = std::function<std::string(const std::string&)>;

/// Help lists the options that are added from now on under this heading.
inline void begin_group(CLI::App& command, const char* heading) {
  command.option_defaults()->group(heading);
}

/// Accepts a finite number within the range; errors show the bounds in short form.
[[nodiscard]] ValueCheck in_range(double low, double high);
/// For a setting whose 0 means its default: refuses 0 from the user.
[[nodiscard]] ValueCheck above_zero();
/// Accepts a whole number within the range.
[[nodiscard]] ValueCheck in_whole_range(std::uint64_t low, std::uint64_t high);
/// Accepts one of these words. Help and completions list them.
[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& words);

/// The name of a value that is a file, in the help. Completions offer files for it alone.
inline constexpr const char* kFileName = "FILE";

/// Adds an option, or an argument without dashes, whose value is a file.
template <class Value>
CLI::Option* add_file(CLI::App& command, const std::string& name, Value& value,
                      const std::string& help) {
  return command.add_option(name, value, help)->type_name(kFileName);
}

/// Refuses empty values, such as that of an unset variable in a script, which the parser would take
/// for the number 0. Call it when the command has all its options.
void refuse_empty_values(CLI::App& command);

/// The layout of `--help`: "NUMBER" for numbers of every kind, and the words of a choice without
/// their type.
[[nodiscard]] std::shared_ptr<CLI::Formatter> help_format();

/// The error for an option that has no effect without another one.
[[nodiscard]] Error no_effect_without(std::string_view option, std::string_view other);

/// The message for an error of the parser, without the name of the program.
[[nodiscard]] std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace clay::cli
