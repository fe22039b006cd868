#pragma once
// The manual pages and the completions of shells, made from the table of options that the parser
// uses, so that they cannot differ from it.

#include "claystack/core/result.hpp"

#include <CLI/App.hpp>

#include <string>
#include <string_view>

namespace clay::cli {

/// The page of a command, or of the program if `command` is null, as roff for man(1).
[[nodiscard]] std::string manual_page(const CLI::App& app, const CLI::App* command);

[[nodiscard]] std::string bash_completions(const CLI::App& app);
[[nodiscard]] std::string zsh_completions(const CLI::App& app);
[[nodiscard]] std::string fish_completions(const CLI::App& app);

}  // namespace clay::cli
