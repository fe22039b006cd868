#include "app/studio/script.hpp"

#include "app/render/image_file.hpp"
#include "app/studio/commands.hpp"
#include "claystack/core/atomic_file.hpp"

#include <fmt/format.h>
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
    Form{"scroll", 1, 1, "scroll STEPS"},
    Form{"key", 1, 1, "key CHORD"},
    Form{"type", 1, 1, "type TEXT"},
    Form{"do", 1, 1, "do ACTION"},
    Form{"open", 1, 2, "open FILE [fails]"},
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

/// What is wrong with the arguments of a command; empty: nothing. Their number is right.
std::string fault_of(const std::vector<std::string>& words) {
  const std::string_view command = words[0];
  const auto expected = [&](std::string_view what, std::size_t word = 1) {
    return fmt::format("expected {}, found {}", what, words[word]);
  };
  if (command == "move" || command == "point") {
    if (!number_of(words[1]) || !number_of(words[2]))
      return fmt::format("expected two numbers, found {} {}", words[1], words[2]);
    const bool over = words.size() == 5 && words[3] == "over" && is_number(words[4], 0.0);
    if (words.size() > 3 && !over) return expected("over SECONDS", 3);
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
  if (command == "open" && words.size() == 3 && words[2] != "fails") return expected("fails", 2);
  if (command != "expect") return {};
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
    studio_.take(PointerMoved{pointer_px_});
    frames(1);
  }
  return {};
}

Result<void> ScriptRunner::screenshot(const std::string& path) {
  host_.bind();
  studio_.frame(Painting::always);
  host_.bind();
  return publish(path, render::png_of(host_.read()));
}

Result<void> ScriptRunner::act(const Words& words) {
  using Verb = Result<void> (ScriptRunner::*)(const Words&);
  static constexpr std::array<std::pair<std::string_view, Verb>, kForms.size()> kVerbs = {{
      {"move", &ScriptRunner::point},
      {"point", &ScriptRunner::point},
      {"press", &ScriptRunner::button},
      {"release", &ScriptRunner::button},
      {"hold", &ScriptRunner::hold},
      {"scroll", &ScriptRunner::scroll},
      {"key", &ScriptRunner::key},
      {"type", &ScriptRunner::type},
      {"do", &ScriptRunner::run_command},
      {"open", &ScriptRunner::open},
      {"save", &ScriptRunner::save},
      {"close", &ScriptRunner::close},
      {"wait", &ScriptRunner::wait},
      {"screenshot", &ScriptRunner::picture},
      {"expect", &ScriptRunner::expect},
  }};
  const auto* verb = std::ranges::find(kVerbs, std::string_view(words.front()),
                                       &std::pair<std::string_view, Verb>::first);
  return (this->*verb->second)(words);  // parse_script has refused unknown commands
}

Result<void> ScriptRunner::point(const Words& words) {
  const double seconds = words.size() > 3 ? *number_of(words[4]) : 0.0;
  return place_of(words).and_then([&](glm::vec2 to) { return move(to, seconds); });
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
  studio_.take(KeyChanged{chord.key, false, false, chord.mods});
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
  studio_.take(FilesDropped{{words[1]}});
  frames(1);
  const bool expected = words.size() == 3;
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
