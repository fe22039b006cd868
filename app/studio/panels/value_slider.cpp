#include "app/studio/panels/value_slider.hpp"

#include "app/studio/panels/widgets.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace clay::studio {
namespace {

/// States of the field of a slider, in ImGui's storage. It is drawn in the frame after it was asked
/// for, and has the keyboard one frame later.
namespace typing {
enum : int { closed, asked, opens, open };
}

ImGuiID field_of(const char* label) { return ImGui::GetID(fmt::format("{} typed", label).c_str()); }

/// Number and unit of a shown value: "70 %" of "70 % of the wall", "80 mm/s" of "at most 80 mm/s";
/// empty for "none".
std::string number_in(const std::string& text) {
  const std::size_t from = std::min(text.find_first_of("-0123456789"), text.size());
  const std::size_t gap = text.find(' ', from);
  return text.substr(from, gap == text.npos ? gap : text.find(' ', gap + 1) - from);
}

/// The unit of such a text, or else the usual one.
std::string_view unit_of(std::string_view number, const ValueUnits& units) {
  const std::string_view name = number.substr(std::min(number.find(' '), number.size() - 1) + 1);
  const bool known =
      std::ranges::any_of(units.all, [&](const cli::Unit& one) { return one.name == name; });
  return known ? name : units.usual;
}

/// The text of the value at the right of a line. A click opens the field. Keys go to the slider.
void value_text(const char* label, const std::string& text) {
  ImGui::TextUnformatted(text.c_str());
  const ImRect place(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
  const ImGuiID id = ImGui::GetID(fmt::format("{} value", label).c_str());
  // Adds no item to the layout, so that the line stays as the text made it.
  if (!ImGui::ItemAdd(place, id, nullptr, ImGuiItemFlags_NoNav)) return;
  bool hovered = false, held = false;
  const bool clicked = ImGui::ButtonBehavior(place, id, &hovered, &held);
  if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_TextInput);
  if (clicked) ImGui::GetStateStorage()->SetInt(field_of(label), typing::asked);
}

/// The field over the slider. It closes with Enter, or when it loses the keyboard.
bool typed_value(const char* label, float& value, const std::string& text,
                 const ValueUnits& units) {
  const ImGuiID field = field_of(label);
  ImGuiStorage& kept = *ImGui::GetStateStorage();
  const int state = kept.GetInt(field);
  if (state == typing::asked) ImGui::SetKeyboardFocusHere();
  const std::string shown = number_in(text);
  std::string typed = shown;
  const bool entered =
      ImGui::InputText(fmt::format("##{} typed", label).c_str(), &typed,
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  kept.SetInt(field, std::min(state + 1, static_cast<int>(typing::open)));
  if (!entered) {
    if (state == typing::open && !ImGui::IsItemActive()) kept.SetInt(field, typing::closed);
    return false;
  }
  const auto number = cli::number_with_unit(typed, units.all, unit_of(shown, units));
  // What cannot be read may be typed again.
  kept.SetInt(field, number || typed.empty() ? typing::closed : typing::asked);
  if (!number) return false;
  value = static_cast<float>(*number / units.per_value);
  return true;
}

/// The slider, or the field that is open over it.
bool slider(const char* label, float& value, float low, float high, const std::string& text,
            const ValueUnits& units, int flags) {
  ImGuiStorage& kept = *ImGui::GetStateStorage();
  const ImGuiID field = field_of(label);
  if (kept.GetInt(field) != typing::closed) {
    if (!typed_value(label, value, text, units)) return false;
    value = std::clamp(value, low, high);
    return true;
  }
  const std::string id = fmt::format("##{}", label);
  const bool moved =
      ImGui::SliderFloat(id.c_str(), &value, low, high, "",
                         flags | ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput);
  if (ImGui::IsItemFocused() && ImGui::IsKeyPressed(GLFW_KEY_F2, false))
    kept.SetInt(field, typing::asked);
  return moved;
}

}  // namespace

ValueUnits lengths_in(LengthUnit unit) {
  return {.all = cli::kLengthUnits, .usual = unit_text(unit).name};
}

bool panel_slider(const char* label, float& value, float low, float high, const std::string& text,
                  const ValueUnits& units, int flags) {
  ImGui::TextUnformatted(label);
  const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
  ImGui::SameLine();
  ImGui::SetCursorPosX(right - ImGui::CalcTextSize(text.c_str()).x);
  value_text(label, text);
  ImGui::SetNextItemWidth(kToEdge);
  return slider(label, value, low, high, text, units, flags);
}

bool form_slider(const char* label, float& value, float low, float high, const std::string& text,
                 const ValueUnits& units, int flags) {
  constexpr float kTextEm = 9.5f;
  if (narrow_form()) return panel_slider(label, value, low, high, text, units, flags);
  form_row(label);
  const float left = ImGui::GetCursorPosX(), room = ImGui::GetContentRegionAvail().x;
  ImGui::SetCursorPosX(left + room - ImGui::CalcTextSize(text.c_str()).x);
  value_text(label, text);
  ImGui::SameLine(left);
  ImGui::SetNextItemWidth(room - kTextEm * ImGui::GetFontSize());
  return slider(label, value, low, high, text, units, flags);
}

bool form_length(const char* label, double& mm, double low_mm, double high_mm, LengthUnit unit,
                 const char* none) {
  const int fine = high_mm <= 1.0 ? 2 : 0;  // more digits for a tolerance
  const std::string value =
      none != nullptr && mm <= 0.0
          ? std::string(none)
          : length_text(mm, unit, thickness_digits(unit) - unit_text(unit).digits + fine);
  // In mm whatever the unit, because a logarithmic slider takes less than a thousandth as 0.
  float shown_mm = static_cast<float>(mm);
  if (!form_slider(label, shown_mm, static_cast<float>(low_mm), static_cast<float>(high_mm), value,
                   lengths_in(unit),
                   low_mm > 0.0 ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None))
    return false;
  mm = std::clamp(static_cast<double>(shown_mm), low_mm, high_mm);
  return true;
}

bool length_slider(const char* label, double& mm, double low_mm, double high_mm, LengthUnit unit) {
  float shown_mm = static_cast<float>(mm);
  if (!panel_slider(label, shown_mm, static_cast<float>(low_mm), static_cast<float>(high_mm),
                    thickness_text(mm, unit), lengths_in(unit), ImGuiSliderFlags_Logarithmic))
    return false;
  mm = std::clamp(static_cast<double>(shown_mm), low_mm, high_mm);
  return true;
}

}  // namespace clay::studio
