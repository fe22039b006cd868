#include "app/studio/script.hpp"

#include "app/render/image_file.hpp"
#include "app/studio/commands.hpp"
#include "claystack/core/atomic_file.hpp"

#include <fmt/format.h>

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
    Form{"open", 1, 1, "open FILE"},
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
    studio_.frame(false);
  }
}

Result<glm::vec2> ScriptRunner::place_of(const Words& words) const {
  const auto x = number_of(words[1]), y = number_of(words[2]);
  if (!x || !y) return bad(fmt::format("expected two numbers, found {} {}", words[1], words[2]));
  if (words[0] == "move") return glm::vec2(static_cast<float>(*x), static_cast<float>(*y));
  const auto pixel = studio_.state().scene.pixel_of({*x, *y});
  if (!pixel) return bad("expected a place before the camera");
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
  studio_.frame(true);
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
  double seconds = 0.0;
  if (words.size() > 3) {
    const auto given = words.size() == 5 && words[3] == "over" ? number_of(words[4]) : std::nullopt;
    if (!given || *given < 0.0 || *given > kLongestWaitS) return bad("expected over SECONDS");
    seconds = *given;
  }
  return place_of(words).and_then([&](glm::vec2 to) { return move(to, seconds); });
}

Result<void> ScriptRunner::button(const Words& words) {
  const auto button = button_of(words[1]);
  if (!button) return bad(fmt::format("expected left, right or middle, found {}", words[1]));
  studio_.take(ButtonChanged{*button, words[0] == "press", mods_});
  frames(1);
  return {};
}

Result<void> ScriptRunner::hold(const Words& words) {
  unsigned mods = kNoMods;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto mod = words[i] == "Ctrl"    ? kControl
                     : words[i] == "Shift" ? kShift
                     : words[i] == "Alt"   ? kAlt
                                           : kNoMods;
    if (mod == kNoMods) return bad(fmt::format("expected Ctrl, Shift or Alt, found {}", words[i]));
    mods |= mod;
  }
  mods_ = mods;
  return {};
}

Result<void> ScriptRunner::key(const Words& words) {
  const auto chord = chord_of(words[1]);
  if (!chord) return bad(fmt::format("expected a key, found {}", words[1]));
  studio_.take(KeyChanged{chord->key, true, false, chord->mods});
  studio_.take(KeyChanged{chord->key, false, false, chord->mods});
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
  const auto steps = number_of(words[1]);
  if (!steps || std::abs(*steps) > kLongestWaitS)
    return bad(fmt::format("expected a number, found {}", words[1]));
  studio_.take(Scrolled{static_cast<float>(*steps)});
  frames(1);
  return {};
}

Result<void> ScriptRunner::wait(const Words& words) {
  const auto seconds = number_of(words[1]);
  if (!seconds || std::abs(*seconds) > kLongestWaitS)
    return bad(fmt::format("expected a number, found {}", words[1]));
  frames(static_cast<int>(std::lround(*seconds / kFrameS)));
  return {};
}

Result<void> ScriptRunner::run_command(const Words& words) {
  const Command* command = find_command(words[1]);
  if (command == nullptr) return bad(fmt::format("expected an action, found {}", words[1]));
  if (!clay::studio::run(*command, studio_.state()))
    return failure(ErrorKind::unsound,
                   fmt::format("expected {} to be enabled, found it disabled", words[1]));
  frames(1);
  return {};
}

Result<void> ScriptRunner::open(const Words& words) {
  studio_.take(FilesDropped{{words[1]}});
  frames(1);
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
  const auto found = fact(studio_.state(), words[1]);
  if (!found) return bad(fmt::format("expected a fact, found {}", words[1]));
  const auto fails = [&](std::string_view expected) {
    return failure(ErrorKind::unsound,
                   fmt::format("{}: expected {}, found {}", words[1], expected, *found));
  };
  if (words.size() == 3) {
    if (*found != words[2]) return fails(words[2]);
    return {};
  }
  const auto limit = number_of(words[3]), value = number_of(*found);
  if (!limit || (words[2] != "below" && words[2] != "above"))
    return bad("expected below NUMBER or above NUMBER");
  if (!value || (words[2] == "below" ? *value >= *limit : *value <= *limit))
    return fails(fmt::format("{} {}", words[2], words[3]));
  return {};
}

}  // namespace clay::studio
