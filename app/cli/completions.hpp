#pragma once
// The completions of shells, made from the table of options that the parser uses.

#include <CLI/App.hpp>

#include <string>

namespace clay::cli {

[[nodiscard]] std::string bash_completions(const CLI::App& app);
[[nodiscard]] std::string zsh_completions(const CLI::App& app);
[[nodiscard]] std::string fish_completions(const CLI::App& app);

}  // namespace clay::cli
