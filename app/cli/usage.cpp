#include "app/cli/usage.hpp"

#include "app/cli/choice_text.hpp"

#include "core/nearest_word.hpp"
#include "core/number_parsing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

namespace clay::cli {
namespace {

/// The command that was parsed, or the program if there is none.
const CLI::App& command_of(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  return parsed.empty() ? app : *parsed.front();
}

/// The text after the first `mark`; empty if it is not there.
std::string_view after(std::string_view text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  return at == std::string_view::npos ? std::string_view() : text.substr(at + mark.size());
}

std::string_view before(std::string_view text, std::string_view mark) {
  return text.substr(0, text.find(mark));
}

/// An unknown argument: the first unknown option, because other arguments may be its values;
/// without an option, the first argument.
std::string unknown_word(const CLI::App& command) {
  const std::vector<std::string> words = command.remaining();
  const auto is_option = [](const std::string& word) {
    return word.size() > 1 && word.starts_with('-');
  };
  const auto option = std::ranges::find_if(words, is_option);
  if (option != words.end()) return *option;
  return words.empty() ? std::string() : words.front();
}

/// A check, an import or a picture of several files is a likely mistake. The window is a separate
/// program, which batch does not run.
std::string_view hint_for_files(const CLI::App& command) {
  const auto files = command.get_options([](const CLI::Option* option) {
    return option->get_positional() && option->get_type_name() == kFileName;
  });
  if (files.size() != 1 || command.get_name() == "batch") return {};
  return command.get_name() == "claystack studio"
             ? "; the window opens one file"
             : "; the command takes one file, and claystack batch runs it on many";
}

std::string unknown_argument(const CLI::App& command, std::string_view word) {
  if (word.empty()) return "expected the options after the command, found one before it";
  if (!word.starts_with('-'))
    return fmt::format("unexpected argument {}{}", word, hint_for_files(command));
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  std::error_code ignored;
  if (std::filesystem::exists(word, ignored))
    return fmt::format("unknown option {}; write ./{} for the file of this name", word, word);
  const std::string_view option = word.substr(0, word.find_first_of("=,]"));
  return fmt::format("unknown option {}{}", word, suggestion(option, {names.begin(), names.end()}));
}

/// "expected pot (NAME.pot.json or - for standard input), found none": of an argument without
/// dashes the first clause of its help.
std::string missing(const CLI::App& command, const std::string& name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  if (!option || !option->get_positional()) return fmt::format("expected {}, found none", name);
  const std::string help = option->get_description();
  return fmt::format("expected {} ({}), found none", name,
                     help.substr(0, help.find_first_of(":;")));
}

/// "Could not convert: --at = abc" of the parser.
std::string not_a_number(std::string_view text) {
  const std::string_view rest = after(text, ": ");
  return fmt::format("{}: expected a number, found {}", before(rest, " = "), after(rest, " = "));
}

std::string message_of(const CLI::App& app, const CLI::ParseError& error) {
  const std::string_view text = error.what();
  switch (static_cast<CLI::ExitCodes>(error.get_exit_code())) {
    case CLI::ExitCodes::RequiredError:
      // A typo in a required option leaves it unset, and so does a file whose name begins with a
      // dash.
      if (const auto word = unknown_word(command_of(app)); word.starts_with('-'))
        return unknown_argument(command_of(app), word);
      if (app.get_require_subcommand_min() > 0 && app.get_subcommands().empty())
        return "expected a command, found none";
      return missing(command_of(app), std::string(before(text, " is required")));
    case CLI::ExitCodes::ExtrasError:
      return unknown_argument(command_of(app), unknown_word(command_of(app)));
    case CLI::ExitCodes::ConversionError:
      return not_a_number(text);
    case CLI::ExitCodes::ArgumentMismatch:
      return text.find("At Most") == std::string_view::npos
                 ? fmt::format("{}: expected a value, found none", before(text, ": "))
                 : fmt::format("{}: expected once, found more than once", before(text, ": "));
    case CLI::ExitCodes::RequiresError:
      return fmt::format("{}: expected {} too, found none", before(text, " requires "),
                         after(text, " requires "));
    case CLI::ExitCodes::ExcludesError:
      return fmt::format("{}: expected no {} with it", before(text, " excludes "),
                         after(text, " excludes "));
    default:
      return std::string(text);
  }
}

class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat() {
    for (const char* number : {"FLOAT", "UINT", "INT"}) label(number, "NUMBER");
  }

  std::string make_option_opts(const CLI::Option* option) const override {
    constexpr std::string_view kChoice = " TEXT:{";
    std::string text = CLI::Formatter::make_option_opts(option);
    if (text.starts_with(kChoice)) text.replace(0, kChoice.size(), " {");
    return text;
  }
};

}  // namespace

std::shared_ptr<CLI::Formatter> help_format() { return std::make_shared<HelpFormat>(); }

ValueCheck in_range(double low, double high) {
  return [=](const std::string& text) -> std::string {
    const auto value = parse_number<double>(text);
    // Not (value < low): NaN must fail.
    if (value && *value >= low && *value <= high) return {};
    return fmt::format("expected a number from {:g} to {:g}, found {}", low, high, text);
  };
}

ValueCheck above_zero() {
  return [](const std::string& text) -> std::string {
    const auto value = parse_number<double>(text);
    if (!value || *value != 0.0) return {};  // the settings check the rest
    return "expected a number above 0, found " + text;
  };
}

ValueCheck in_whole_range(std::uint64_t low, std::uint64_t high) {
  return [=](const std::string& text) -> std::string {
    const auto value = parse_number<std::uint64_t>(text);
    if (value && *value >= low && *value <= high) return {};
    return fmt::format("expected a whole number from {} to {}, found {}", low, high, text);
  };
}

void refuse_empty_values(CLI::App& command) {
  const ValueCheck check = [](const std::string& value) {
    return value.empty() ? "expected a value, found nothing" : std::string();
  };
  for (CLI::Option* option : command.get_options())
    if (option->get_items_expected_max() > 0) option->check(check);
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  return {[words](const std::string& text) {
            if (std::ranges::find(words, text) != words.end()) return std::string();
            return fmt::format("expected {}, found {}{}", choice_of(words), text,
                               suggestion(text, {words.begin(), words.end()}));
          },
          fmt::format("{{{}}}", fmt::join(words, ","))};
}

Error no_effect_without(std::string_view option, std::string_view other) {
  return {ErrorKind::bad_input,
          fmt::format("{}: expected {} too; without it the option has no effect", option, other)};
}

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const std::string message = message_of(app, error);
  return message.ends_with("found ") ? message + "nothing" : message;  // the value is empty
}

}  // namespace clay::cli
