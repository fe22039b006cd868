#include "app/studio/input.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace clay::studio {

namespace {

struct NamedKey {
  std::string_view name;
  int key;
};

// Letters and digits have their ASCII codes as GLFW's.
constexpr std::array kNamedKeys = {
    NamedKey{"Space", GLFW_KEY_SPACE},
    NamedKey{"Esc", GLFW_KEY_ESCAPE},
    NamedKey{"Enter", GLFW_KEY_ENTER},
    NamedKey{"Tab", GLFW_KEY_TAB},
    NamedKey{"Backspace", GLFW_KEY_BACKSPACE},
    NamedKey{"Delete", GLFW_KEY_DELETE},
    NamedKey{"Home", GLFW_KEY_HOME},
    NamedKey{"End", GLFW_KEY_END},
    NamedKey{"PageUp", GLFW_KEY_PAGE_UP},
    NamedKey{"PageDown", GLFW_KEY_PAGE_DOWN},
    NamedKey{"Left", GLFW_KEY_LEFT},
    NamedKey{"Right", GLFW_KEY_RIGHT},
    NamedKey{"Up", GLFW_KEY_UP},
    NamedKey{"Down", GLFW_KEY_DOWN},
    NamedKey{"F1", GLFW_KEY_F1},
    NamedKey{"F2", GLFW_KEY_F2},
    NamedKey{"F6", GLFW_KEY_F6},
    NamedKey{"F10", GLFW_KEY_F10},
    NamedKey{"Num1", GLFW_KEY_KP_1},
    NamedKey{"Num3", GLFW_KEY_KP_3},
    NamedKey{"Num7", GLFW_KEY_KP_7},
    NamedKey{"[", GLFW_KEY_LEFT_BRACKET},
    NamedKey{"]", GLFW_KEY_RIGHT_BRACKET},
    NamedKey{"/", GLFW_KEY_SLASH},
    NamedKey{"-", GLFW_KEY_MINUS},
    NamedKey{"=", GLFW_KEY_EQUAL},
    NamedKey{",", GLFW_KEY_COMMA},
    NamedKey{".", GLFW_KEY_PERIOD},
};

struct NamedMod {
  std::string_view name;
  unsigned mod;
};
constexpr std::array kNamedMods = {NamedMod{"Ctrl+", kControl}, NamedMod{"Shift+", kShift},
                                   NamedMod{"Alt+", kAlt}};

bool is_character(int key) { return (key >= 'A' && key <= 'Z') || (key >= '0' && key <= '9'); }

}  // namespace

int key_of_layout(int key, std::string_view printed, unsigned mods) noexcept {
  constexpr std::string_view kSigns = "[]/-=,.";  // those of commands; their codes are ASCII
  const bool control = (mods & kControl) != 0;
  if (key == GLFW_KEY_KP_ENTER) return GLFW_KEY_ENTER;
  if (key == GLFW_KEY_KP_SUBTRACT && control) return GLFW_KEY_MINUS;
  if (key == GLFW_KEY_KP_ADD && control) return GLFW_KEY_EQUAL;   // as + in other programs
  if (key >= GLFW_KEY_ESCAPE || printed.size() != 1) return key;  // from Esc on: no signs
  const char sign = printed.front();
  if (sign == '+' && control) return GLFW_KEY_EQUAL;
  if (sign >= 'a' && sign <= 'z') return sign - 'a' + GLFW_KEY_A;
  return kSigns.find(sign) != std::string_view::npos ? sign : key;
}

std::string text_of(const KeyChord& chord) {
  if (chord.key == 0) return {};
  // The printed name of the key comes first, because users look for it.
  if (chord == KeyChord{GLFW_KEY_SLASH, kShift}) return "?";
  std::string text;
  for (const NamedMod& mod : kNamedMods)
    if ((chord.mods & mod.mod) != 0) text += mod.name;
  if (is_character(chord.key)) return text + static_cast<char>(chord.key);
  const auto* named = std::ranges::find(kNamedKeys, chord.key, &NamedKey::key);
  if (named != kNamedKeys.end()) text += named->name;
  return text;
}

std::optional<KeyChord> chord_of(std::string_view text) {
  if (text == "?") return KeyChord{GLFW_KEY_SLASH, kShift};
  KeyChord chord;
  for (bool found = true; found;) {
    found = false;
    for (const NamedMod& mod : kNamedMods) {
      if (!text.starts_with(mod.name)) continue;
      chord.mods |= mod.mod;
      text.remove_prefix(mod.name.size());
      found = true;
    }
  }
  if (text.size() == 1 && std::isalnum(static_cast<unsigned char>(text[0])) != 0) {
    chord.key = std::toupper(static_cast<unsigned char>(text[0]));
    return chord;
  }
  const auto* named = std::ranges::find(kNamedKeys, text, &NamedKey::name);
  if (named == kNamedKeys.end()) return std::nullopt;
  chord.key = named->key;
  return chord;
}

}  // namespace clay::studio
