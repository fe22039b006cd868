#pragma once
// The manual pages, made from the table of options that the parser uses, so that they cannot differ
// from it.

#include <CLI/App.hpp>

#include <string>

namespace clay::cli {

/// The page of a command, or of the program if `command` is null, as roff for man(1).
[[nodiscard]] std::string manual_page(const CLI::App& app, const CLI::App* command);

}  // namespace clay::cli
