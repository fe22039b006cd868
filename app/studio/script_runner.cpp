#include "app/studio/script_runner.hpp"

#include "app/cli/output_files.hpp"
#include "app/render/image_file.hpp"
#include "app/studio/commands.hpp"
#include "app/studio/script_facts.hpp"
#include "claystack/core/atomic_file.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace clay::studio {
namespace {

constexpr double kFrameS = 1.0 / 60.0;
constexpr std::int64_t kFrameNs = 1'000'000'000 / 60;

/// Duration of a command [s]: the command ends with `over SECONDS` from this word on, or has 0 s if
/// it ends before.
double over_s(const std::vector<std::string>& words, std::size_t from) {
  return words.size() > from ? *number_of(words[from + 1]) : 0.0;
}

/// Frames of a movement: one at least.
int steps_in(double seconds) { return std::max(1, static_cast<int>(std::ceil(seconds / kFrameS))); }

}  // namespace

std::span<const ScriptCommand> ScriptRunner::commands() noexcept {
  static constexpr auto kCommands = std::to_array<ScriptCommand>({
      {"move", 2, 4, "move X Y [over SECONDS]", &ScriptRunner::point},
      {"point", 2, 4, "point RHO_MM Y_MM [over SECONDS]", &ScriptRunner::point},
      {"press", 1, 1, "press left|right|middle", &ScriptRunner::button},
      {"release", 1, 1, "release left|right|middle", &ScriptRunner::button},
      {"hold", 0, 3, "hold [Ctrl] [Shift] [Alt]", &ScriptRunner::hold},
      {"pressure", 1, 3, "pressure PART|none [over SECONDS]", &ScriptRunner::pressure},
      {"gamepad", 1, 1, "gamepad NAME|none", &ScriptRunner::gamepad},
      {"stick", 3, 5, "stick left|right X Y [over SECONDS]", &ScriptRunner::stick},
      {"trigger", 2, 4, "trigger left|right PART [over SECONDS]", &ScriptRunner::trigger},
      {"pad", 1, 1, "pad BUTTON", &ScriptRunner::pad_button},
      {"scroll", 1, 1, "scroll STEPS", &ScriptRunner::scroll},
      {"key", 1, 1, "key CHORD", &ScriptRunner::key},
      {"type", 1, 1, "type TEXT", &ScriptRunner::type},
      {"do", 1, 1, "do ACTION", &ScriptRunner::run_command},
      {"open", 1, 9, "open FILE... [fails]", &ScriptRunner::open},
      {"save", 1, 1, "save FILE", &ScriptRunner::save},
      {"close", 0, 0, "close", &ScriptRunner::close},
      {"wait", 1, 1, "wait SECONDS", &ScriptRunner::wait},
      {"screenshot", 1, 1, "screenshot FILE.png", &ScriptRunner::picture},
      {"expect", 2, 3, "expect FACT VALUE | expect FACT below|above NUMBER", &ScriptRunner::expect},
  });
  return kCommands;
}

Result<void> ScriptRunner::run(const std::vector<ScriptLine>& lines, std::string_view name) {
  frames(2);
  for (const ScriptLine& line : lines) {
    if (studio_.done() && line.words.front() != "expect")
      return failure(
          ErrorKind::bad_input,
          fmt::format("{}:{}: expected an open window, found a closed one", name, line.number));
    if (auto done = (this->*line.command->run)(line.words); !done)
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

void ScriptRunner::move(glm::vec2 to_px, double seconds) {
  const glm::vec2 from = pointer_px_;
  const int steps = steps_in(seconds);
  for (int i = 1; i <= steps; ++i) {
    pointer_px_ = glm::mix(from, to_px, static_cast<float>(i) / static_cast<float>(steps));
    studio_.take(PointerMoved{pointer_px_, pressure_});
    frames(1);
  }
}

void ScriptRunner::drive(const GamepadState& to, double seconds) {
  const GamepadState from = pad_;
  pad_ = to;
  const int steps = steps_in(seconds);
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

Result<void> ScriptRunner::point(const Words& words) {
  return place_of(words).map([&](glm::vec2 to) { move(to, over_s(words, 3)); });
}

/// A pen reports its pressure with its place.
Result<void> ScriptRunner::pressure(const Words& words) {
  const double from = pressure_.value_or(0.0);
  if (words[1] == "none") {
    pressure_.reset();
    move(pointer_px_, 0.0);
    return {};
  }
  const double to = *number_of(words[1]);
  const int steps = steps_in(over_s(words, 2));
  for (int i = 1; i <= steps; ++i) {
    pressure_ = glm::mix(from, to, static_cast<double>(i) / static_cast<double>(steps));
    move(pointer_px_, 0.0);
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
  const Command& command = *find_command(words[1]);
  AppState& state = studio_.state();
  if (!clay::studio::run(command, state)) {
    const char* why = command.why_not != nullptr ? command.why_not(view_model(state)) : nullptr;
    return failure(ErrorKind::unsound,
                   fmt::format("expected {} to be enabled, found it disabled{}", words[1],
                               why != nullptr ? fmt::format(": {}", why) : ""));
  }
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
  if (!state.document.has_work())
    return failure(ErrorKind::bad_input, "expected a pot to save, found none");
  if (!save_document(state, words[1])) return tl::make_unexpected(*state.last_error);
  apply(state, CloseDialog{});
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
