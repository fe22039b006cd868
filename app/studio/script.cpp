#include "app/studio/script.hpp"

#include "app/cli/output_files.hpp"
#include "app/render/image_file.hpp"
#include "app/studio/commands.hpp"
#include "claystack/core/atomic_file.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace clay::studio {
namespace {

constexpr double kFrameS = 1.0 / 60.0;
constexpr std::int64_t kFrameNs = 1'000'000'000 / 60;
constexpr double kLongestWaitS = 3600.0;

struct Form {
  std::string_view name;
  std::size_t fewest, most;  // number of arguments
  const char* form;
};
constexpr std::array kForms = {
    Form{"move", 2, 4, "move X Y [over SECONDS]"},
    Form{"point", 2, 4, "point RHO_MM Y_MM [over SECONDS]"},
    Form{"press", 1, 1, "press left|right|middle"},
    Form{"release", 1, 1, "release left|right|middle"},
    Form{"hold", 0, 3, "hold [Ctrl] [Shift] [Alt]"},
    Form{"pressure", 1, 3, "pressure PART|none [over SECONDS]"},
    Form{"gamepad", 1, 1, "gamepad NAME|none"},
    Form{"stick", 3, 5, "stick left|right X Y [over SECONDS]"},
    Form{"trigger", 2, 4, "trigger left|right PART [over SECONDS]"},
    Form{"pad", 1, 1, "pad BUTTON"},
    Form{"scroll", 1, 1, "scroll STEPS"},
    Form{"key", 1, 1, "key CHORD"},
    Form{"type", 1, 1, "type TEXT"},
    Form{"do", 1, 1, "do ACTION"},
    Form{"open", 1, 9, "open FILE... [fails]"},
    Form{"save", 1, 1, "save FILE"},
    Form{"close", 0, 0, "close"},
    Form{"wait", 1, 1, "wait SECONDS"},
    Form{"screenshot", 1, 1, "screenshot FILE.png"},
    Form{"expect", 2, 3, "expect FACT VALUE | expect FACT below|above NUMBER"},
};

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

/// The end of a command: `over SECONDS`, from this word on, or nothing.
bool is_over(const std::vector<std::string>& words, std::size_t from) {
  return words.size() == from ||
         (words.size() == from + 2 && words[from] == "over" && is_number(words[from + 1], 0.0));
}
double over_s(const std::vector<std::string>& words, std::size_t from) {
  return words.size() > from ? *number_of(words[from + 1]) : 0.0;
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
    if (!is_over(words, 2)) return found("over SECONDS", 2);
  }
  if (command != "stick" && command != "trigger") return {};
  if (words[1] != "left" && words[1] != "right") return found("left or right", 1);
  const bool stick = command == "stick";
  const std::size_t numbers = stick ? 2 : 1;
  for (std::size_t word = 2; word < 2 + numbers; ++word)
    if (!is_part(words[word], stick ? -1.0 : 0.0)) return found(stick ? "-1 to 1" : "0 to 1", word);
  if (!is_over(words, 2 + numbers)) return found("over SECONDS", 2 + numbers);
  return {};
}

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 128; }

/// The fault of the arguments of a command; empty: none. Their number is right.
std::string fault_of(const std::vector<std::string>& words) {
  const std::string_view command = words[0];
  const auto expected = [&](std::string_view what, std::size_t word = 1) {
    return fmt::format("expected {}, found {}", what, words[word]);
  };
  if (command == "move" || command == "point") {
    if (!number_of(words[1]) || !number_of(words[2]))
      return fmt::format("expected two numbers, found {} {}", words[1], words[2]);
    if (!is_over(words, 3)) return expected("over SECONDS", 3);
  }
  if ((command == "press" || command == "release") && !button_of(words[1]))
    return expected("left, right or middle");
  if (command == "hold")
    for (std::size_t i = 1; i < words.size(); ++i)
      if (!modifier_of(words[i])) return expected("Ctrl, Shift or Alt", i);
  if (command == "scroll" && !is_number(words[1], -kLongestWaitS)) return expected("a number");
  if (command == "wait" && !is_number(words[1], 0.0)) return expected("a number of seconds");
  if (command == "key" && !chord_of(words[1])) return expected("a key");
  if (command == "do" && find_command(words[1]) == nullptr) return expected("an action");
  if (command == "type" && !std::ranges::all_of(words[1], is_ascii)) return expected("ASCII text");
  if (command != "expect") return fault_of_hand(words);
  if (!is_fact(words[1])) return expected("a fact");
  const bool limit = words.size() == 4;
  if (limit && ((words[2] != "below" && words[2] != "above") || !number_of(words[3])))
    return "expected below NUMBER or above NUMBER";
  return {};
}

}  // namespace

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
    const auto* command = std::ranges::find(kForms, words->front(), &Form::name);
    if (command == kForms.end())
      return bad(fmt::format("{}:{}: expected a command, found {}", name, number, words->front()));
    const std::size_t arguments = words->size() - 1;
    if (arguments < command->fewest || arguments > command->most)
      return bad(fmt::format("{}:{}: expected {}, found {} arguments", name, number, command->form,
                             arguments));
    if (const std::string fault = fault_of(*words); !fault.empty())
      return bad(fmt::format("{}:{}: {}", name, number, fault));
    lines.push_back({number, *words});
  }
  return lines;
}

Result<void> ScriptRunner::run(const std::vector<ScriptLine>& lines, std::string_view name) {
  frames(2);
  for (const ScriptLine& line : lines) {
    if (studio_.done() && line.words.front() != "expect")
      return bad(
          fmt::format("{}:{}: expected an open window, found a closed one", name, line.number));
    if (auto done = act(line.words); !done)
      return failure(done.error().kind,
                     fmt::format("{}:{}: {}", name, line.number, done.error().message));
  }
  return {};
}

void ScriptRunner::frames(int count) {
  for (int i = 0; i < count && !studio_.done(); ++i) {
    host_.advance(kFrameNs);
    studio_.frame(Painting::none);
  }
}

/// Arguments have been checked by parse_script, here and below.
Result<glm::vec2> ScriptRunner::place_of(const Words& words) const {
  const glm::dvec2 place(*number_of(words[1]), *number_of(words[2]));
  if (words[0] == "move") return glm::vec2(place);
  const auto pixel = studio_.state().scene.pixel_of(place);
  const ViewRect& view = studio_.state().scene.rect();
  if (!pixel || glm::any(glm::lessThan(*pixel, view.corner_px)) ||
      glm::any(glm::greaterThan(*pixel, view.corner_px + view.size_px)))
    return failure(ErrorKind::unsound,
                   fmt::format("expected a place in the view, found ({} mm, {} mm) outside it",
                               words[1], words[2]));
  return *pixel;
}

/// One step per frame, like a hand.
Result<void> ScriptRunner::move(glm::vec2 to_px, double seconds) {
  const glm::vec2 from = pointer_px_;
  const int steps = std::max(1, static_cast<int>(std::ceil(seconds / kFrameS)));
  for (int i = 1; i <= steps; ++i) {
    pointer_px_ = glm::mix(from, to_px, static_cast<float>(i) / static_cast<float>(steps));
    studio_.take(PointerMoved{pointer_px_, pressure_});
    frames(1);
  }
  return {};
}

void ScriptRunner::drive(const GamepadState& to, double seconds) {
  const GamepadState from = pad_;
  pad_ = to;
  const int steps = std::max(1, static_cast<int>(std::ceil(seconds / kFrameS)));
  for (int i = 1; i <= steps; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(steps);
    studio_.take(
        GamepadChanged{{glm::mix(from.left_stick, to.left_stick, part),
                        glm::mix(from.right_stick, to.right_stick, part),
                        glm::mix(from.left_trigger, to.left_trigger, part),
                        glm::mix(from.right_trigger, to.right_trigger, part), to.buttons}});
    frames(1);
  }
}

Result<void> ScriptRunner::screenshot(const std::string& path) {
  if (auto free = cli::check_outputs({{path, {".png"}}}, {}, {}); !free) return free;
  host_.bind();
  studio_.frame(Painting::always);
  host_.bind();
  return publish(path, render::png_of(host_.read()));
}

Result<void> ScriptRunner::act(const Words& words) {
  using Verb = Result<void> (ScriptRunner::*)(const Words&);
  static constexpr std::array<std::pair<std::string_view, Verb>, kForms.size()> kVerbs = {{
      {"move", &ScriptRunner::point},         {"point", &ScriptRunner::point},
      {"press", &ScriptRunner::button},       {"release", &ScriptRunner::button},
      {"hold", &ScriptRunner::hold},          {"pressure", &ScriptRunner::pressure},
      {"gamepad", &ScriptRunner::gamepad},    {"stick", &ScriptRunner::stick},
      {"trigger", &ScriptRunner::trigger},    {"pad", &ScriptRunner::pad_button},
      {"scroll", &ScriptRunner::scroll},      {"key", &ScriptRunner::key},
      {"type", &ScriptRunner::type},          {"do", &ScriptRunner::run_command},
      {"open", &ScriptRunner::open},          {"save", &ScriptRunner::save},
      {"close", &ScriptRunner::close},        {"wait", &ScriptRunner::wait},
      {"screenshot", &ScriptRunner::picture}, {"expect", &ScriptRunner::expect},
  }};
  const auto* verb = std::ranges::find(kVerbs, std::string_view(words.front()),
                                       &std::pair<std::string_view, Verb>::first);
  return (this->*verb->second)(words);  // parse_script has refused unknown commands
}

Result<void> ScriptRunner::point(const Words& words) {
  return place_of(words).and_then([&](glm::vec2 to) { return move(to, over_s(words, 3)); });
}

/// A pen reports its pressure with its place.
Result<void> ScriptRunner::pressure(const Words& words) {
  const double from = pressure_.value_or(0.0);
  if (words[1] == "none") {
    pressure_.reset();
    return move(pointer_px_, 0.0);
  }
  const double to = *number_of(words[1]);
  const int steps = std::max(1, static_cast<int>(std::ceil(over_s(words, 2) / kFrameS)));
  for (int i = 1; i <= steps; ++i) {
    pressure_ = glm::mix(from, to, static_cast<double>(i) / static_cast<double>(steps));
    if (auto moved = move(pointer_px_, 0.0); !moved) return moved;
  }
  return {};
}

Result<void> ScriptRunner::gamepad(const Words& words) {
  pad_ = {};
  studio_.take(GamepadPlugged{words[1] == "none" ? std::string() : words[1]});
  frames(1);
  return {};
}

Result<void> ScriptRunner::stick(const Words& words) {
  GamepadState to = pad_;
  glm::dvec2& moved = words[1] == "left" ? to.left_stick : to.right_stick;
  moved = glm::dvec2(*number_of(words[2]), *number_of(words[3]));
  drive(to, over_s(words, 4));
  return {};
}

Result<void> ScriptRunner::trigger(const Words& words) {
  GamepadState to = pad_;
  (words[1] == "left" ? to.left_trigger : to.right_trigger) = *number_of(words[2]);
  drive(to, over_s(words, 3));
  return {};
}

/// Presses and releases a button.
Result<void> ScriptRunner::pad_button(const Words& words) {
  GamepadState pressed = pad_;
  pressed.buttons |= bit_of(*pad_button_of(words[1]));
  const GamepadState released = pad_;
  drive(pressed, 0.0);
  drive(released, 0.0);
  return {};
}

Result<void> ScriptRunner::button(const Words& words) {
  const glm::vec2 size(host_.size_px());
  const bool press = words[0] == "press";
  if (press && (glm::any(glm::lessThan(pointer_px_, glm::vec2(0.0f))) ||
                glm::any(glm::greaterThanEqual(pointer_px_, size))))
    return failure(ErrorKind::unsound,
                   fmt::format("expected the pointer in the window, found it at {} {}",
                               pointer_px_.x, pointer_px_.y));
  studio_.take(ButtonChanged{*button_of(words[1]), press, mods_});
  frames(1);
  return {};
}

Result<void> ScriptRunner::hold(const Words& words) {
  mods_ = kNoMods;
  for (std::size_t i = 1; i < words.size(); ++i) mods_ |= *modifier_of(words[i]);
  return {};
}

Result<void> ScriptRunner::key(const Words& words) {
  const auto chord = *chord_of(words[1]);
  studio_.take(KeyChanged{chord.key, true, false, chord.mods});
  studio_.take(KeyChanged{chord.key, false, false, mods_});  // those of the chord are released too
  frames(1);
  return {};
}

Result<void> ScriptRunner::type(const Words& words) {
  for (const char c : words[1])
    studio_.take(TextTyped{static_cast<char32_t>(static_cast<unsigned char>(c))});
  frames(1);
  return {};
}

Result<void> ScriptRunner::scroll(const Words& words) {
  studio_.take(Scrolled{static_cast<float>(*number_of(words[1]))});
  frames(1);
  return {};
}

Result<void> ScriptRunner::wait(const Words& words) {
  frames(static_cast<int>(std::lround(*number_of(words[1]) / kFrameS)));
  return {};
}

Result<void> ScriptRunner::run_command(const Words& words) {
  if (!clay::studio::run(*find_command(words[1]), studio_.state()))
    return failure(ErrorKind::unsound,
                   fmt::format("expected {} to be enabled, found it disabled", words[1]));
  frames(1);
  return {};
}

Result<void> ScriptRunner::open(const Words& words) {
  std::optional<Error>& error = studio_.state().last_error;
  error.reset();
  const bool expected = words.size() > 2 && words.back() == "fails";
  studio_.take(FilesDropped{{words.begin() + 1, words.end() - (expected ? 1 : 0)}});
  frames(1);
  if (error && !expected) return tl::make_unexpected(*error);
  if (!error && expected)
    return failure(ErrorKind::unsound, fmt::format("{}: expected an error, found none", words[1]));
  return {};
}

Result<void> ScriptRunner::save(const Words& words) {
  AppState& state = studio_.state();
  if (!state.document.has_work()) return bad("expected a pot to save, found none");
  const bool saved = save_document(state, words[1]);
  if (saved) apply(state, CloseDialog{});
  if (!saved) return failure(ErrorKind::io, fmt::format("{}: could not be saved", words[1]));
  return {};
}

Result<void> ScriptRunner::close(const Words&) {
  studio_.take(CloseAsked{});
  frames(1);
  return {};
}

Result<void> ScriptRunner::expect(const Words& words) {
  const std::string found = *fact(studio_.state(), words[1]);
  const auto fails = [&](std::string_view expected) {
    return failure(ErrorKind::unsound,
                   fmt::format("{}: expected {}, found {}", words[1], expected, found));
  };
  if (words.size() == 3) {
    if (found != words[2]) return fails(words[2]);
    return {};
  }
  const double limit = *number_of(words[3]);
  const auto value = number_of(found);
  if (!value || (words[2] == "below" ? *value >= limit : *value <= limit))
    return fails(fmt::format("{} {}", words[2], words[3]));
  return {};
}

}  // namespace clay::studio
