#pragma once
// The table of options that the parser uses, for manual pages and completions.

#include <CLI/App.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace clay::cli {

[[nodiscard]] bool is_flag(const CLI::Option& option);
/// "FILE", "NUMBER", "LENGTH"; "WORD" for one of several words.
[[nodiscard]] std::string value_name(const CLI::Option& option);
/// The values that the option takes, if they are listed.
[[nodiscard]] std::vector<std::string> choices_of(const CLI::Option& option);
/// "-o", "--output".
[[nodiscard]] std::vector<std::string> names_of(const CLI::Option& option);
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view between);

/// Without hidden ones.
[[nodiscard]] std::vector<const CLI::App*> commands_of(const CLI::App& app);
[[nodiscard]] std::vector<std::string> names_of_commands(const CLI::App& app);
/// The options of a command, or its positional arguments; without hidden ones.
[[nodiscard]] std::vector<const CLI::Option*> options_of(const CLI::App& command, bool positional);

}  // namespace clay::cli
