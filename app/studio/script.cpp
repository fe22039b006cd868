#include "app/studio/script.hpp"

#include "app/studio/commands.hpp"
#include "app/studio/script_facts.hpp"
#include "app/studio/script_runner.hpp"
#include "core/nearest_word.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace clay::studio {
namespace {

constexpr double kLongestWaitS = 3600.0;

tl::unexpected<Error> bad(std::string message) {
  return failure(ErrorKind::bad_input, std::move(message));
}

/// Splits at blanks outside quotes; empty for a quote that is not closed.
std::optional<std::vector<std::string>> words_of(std::string_view line) {
  std::vector<std::string> words;
  std::size_t i = 0;
  while (i < line.size()) {
    if (line[i] == ' ' || line[i] == '\t' || line[i] == '\r') {
      ++i;
    } else if (line[i] == '#') {
      break;
    } else if (line[i] == '"') {
      const std::size_t end = line.find('"', i + 1);
      if (end == std::string_view::npos) return std::nullopt;
      words.emplace_back(line.substr(i + 1, end - i - 1));
      i = end + 1;
    } else {
      const std::size_t end = std::min(line.find_first_of(" \t\r", i), line.size());
      words.emplace_back(line.substr(i, end - i));
      i = end;
    }
  }
  return words;
}

bool is_number(std::string_view text, double least) {
  const auto number = number_of(text);
  return number && *number >= least && *number <= kLongestWaitS;
}

/// The fault of the end of a command: `over SECONDS`, from this word on, or nothing.
std::string fault_of_over(const std::vector<std::string>& words, std::size_t from) {
  if (words.size() == from) return {};
  const std::size_t given = words.size() - from;
  if (given == 2 && words[from] == "over" && is_number(words[from + 1], 0.0)) return {};
  return fmt::format(
      "expected over 0 to 3600 seconds, found {}",
      fmt::join(words.begin() + static_cast<std::ptrdiff_t>(from), words.end(), " "));
}

bool is_part(std::string_view text, double least) {
  const auto number = number_of(text);
  return number && *number >= least && *number <= 1.0;
}

/// The fault of the arguments of a pen or gamepad command; empty: none.
std::string fault_of_hand(const std::vector<std::string>& words) {
  const std::string_view command = words[0];
  const auto found = [&](std::string_view what, std::size_t word) {
    return fmt::format("expected {}, found {}", what, words[word]);
  };
  if (command == "pad" && !pad_button_of(words[1])) return found("a button of a gamepad", 1);
  if (command == "pressure") {
    if (words[1] != "none" && !is_part(words[1], 0.0)) return found("0 to 1 or none", 1);
    return fault_of_over(words, 2);
  }
  if (command != "stick" && command != "trigger") return {};
  if (words[1] != "left" && words[1] != "right") return found("left or right", 1);
  const bool stick = command == "stick";
  const std::size_t numbers = stick ? 2 : 1;
  for (std::size_t word = 2; word < 2 + numbers; ++word)
    if (!is_part(words[word], stick ? -1.0 : 0.0)) return found(stick ? "-1 to 1" : "0 to 1", word);
  return fault_of_over(words, 2 + numbers);
}

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 128; }

std::vector<std::string_view> action_names() {
  std::vector<std::string_view> names;
  for (const Command& command : commands()) names.emplace_back(command.id);
  return names;
}

/// The fault of a name that is not one of these; empty: none.
std::string fault_of_name(std::string_view what, std::string_view word,
                          const std::vector<std::string_view>& names) {
  if (std::ranges::find(names, word) != names.end()) return {};
  return fmt::format("expected {}, found {}{}", what, word, suggestion(word, names));
}

/// The fault of the arguments of a command; empty: none. Their number is right.
std::string fault_of(const std::vector<std::string>& words) {
  const std::string_view command = words[0];
  const auto expected = [&](std::string_view what, std::size_t word = 1) {
    return fmt::format("expected {}, found {}", what, words[word]);
  };
  if (command == "move" || command == "point") {
    if (!number_of(words[1]) || !number_of(words[2]))
      return fmt::format("expected two numbers, found {} {}", words[1], words[2]);
    return fault_of_over(words, 3);
  }
  if ((command == "press" || command == "release") && !button_of(words[1]))
    return expected("left, right or middle");
  if (command == "hold")
    for (std::size_t i = 1; i < words.size(); ++i)
      if (!modifier_of(words[i])) return expected("Ctrl, Shift or Alt", i);
  if (command == "scroll" && !is_number(words[1], -kLongestWaitS))
    return expected("a number of steps");
  if (command == "wait" && !is_number(words[1], 0.0)) return expected("0 to 3600 seconds");
  if (command == "key" && !chord_of(words[1])) return expected("a key such as Ctrl+Z, F10 or Esc");
  if (command == "do") return fault_of_name("an action", words[1], action_names());
  if (command == "type" && !std::ranges::all_of(words[1], is_ascii)) return expected("ASCII text");
  if (command != "expect") return fault_of_hand(words);
  if (std::string fault = fault_of_name("a fact", words[1], fact_names()); !fault.empty())
    return fault;
  const bool limit = words.size() == 4;
  if (limit && ((words[2] != "below" && words[2] != "above") || !number_of(words[3])))
    return fmt::format("expected below NUMBER or above NUMBER, found {} {}", words[2], words[3]);
  return {};
}

}  // namespace

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::optional<MouseButton> button_of(std::string_view text) {
  if (text == "left") return MouseButton::left;
  if (text == "right") return MouseButton::right;
  if (text == "middle") return MouseButton::middle;
  return std::nullopt;
}

std::optional<unsigned> modifier_of(std::string_view text) {
  if (text == "Ctrl") return kControl;
  if (text == "Shift") return kShift;
  if (text == "Alt") return kAlt;
  return std::nullopt;
}

Result<std::vector<ScriptLine>> parse_script(std::string_view text, std::string_view name) {
  std::vector<ScriptLine> lines;
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const auto words = words_of(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (!words)
      return bad(fmt::format("{}:{}: expected a closing quote, found none", name, number));
    if (words->empty()) continue;
    const auto commands = ScriptRunner::commands();
    const auto command = std::ranges::find(commands, words->front(), &ScriptCommand::name);
    if (command == commands.end())
      return bad(fmt::format("{}:{}: expected a command, found {}", name, number, words->front()));
    const std::size_t arguments = words->size() - 1;
    if (arguments < command->fewest || arguments > command->most)
      return bad(fmt::format("{}:{}: expected {}, found {} argument{}", name, number, command->form,
                             arguments, arguments == 1 ? "" : "s"));
    if (const std::string fault = fault_of(*words); !fault.empty())
      return bad(fmt::format("{}:{}: {}", name, number, fault));
    lines.push_back({number, *words, &*command});
  }
  return lines;
}

}  // namespace clay::studio
