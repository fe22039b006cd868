#include "app/studio/panels/text.hpp"

#include "core/text.hpp"

#include <fmt/chrono.h>

#include <algorithm>
#include <cmath>

namespace clay::studio {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether a line may end between these words: not between a number and a unit.
bool may_part(std::string_view before, std::string_view after) {
  constexpr std::size_t kLongestUnit = 6;  // "N/mm\xc2\xb2", punctuation apart
  const std::size_t end = after.find_last_not_of(".,;:)");
  return before.empty() || !is_digit(before.back()) || end == std::string_view::npos ||
         end >= kLongestUnit || is_digit(after.front());
}

}  // namespace

std::string wrapped(std::string_view text, float width_px) {
  std::string done, line, piece;  // a piece is never broken
  const auto fits = [&](const std::string& part) {
    return ImGui::CalcTextSize(part.c_str()).x <= width_px;
  };
  const auto place = [&] {
    if (piece.empty()) return;
    const std::string longer = line.empty() ? piece : line + ' ' + piece;
    if (line.empty() || fits(longer)) {
      line = longer;
    } else {
      done += line + '\n';
      line = piece;
    }
    piece.clear();
  };
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find_first_of(" \n", from), text.size());
    const std::string_view word = text.substr(from, to - from);
    if (may_part(piece, word)) place();
    piece.append(piece.empty() ? "" : " ").append(word);
    if (to < text.size() && text[to] == '\n') {
      place();
      done += line + '\n';
      line.clear();
    }
    from = to + 1;
  }
  place();
  return done + line;
}

std::string shortened(const std::string& text, float width_px) {
  constexpr const char* kGap = "\xe2\x80\xa6";  // ...
  const auto fits = [&](const std::string& part) {
    return ImGui::CalcTextSize(part.c_str()).x <= width_px;
  };
  if (fits(text)) return text;
  // Whole characters: the bytes after the first of one are 10xxxxxx.
  const auto begins = [&](std::size_t at) {
    return at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xC0) != 0x80;
  };
  std::string best = kGap;
  for (std::size_t left = 1, right = text.size() - 1; left < right;) {
    while (!begins(left)) ++left;
    while (right > left && !begins(right)) --right;
    const std::string longer = text.substr(0, left) + kGap + text.substr(right);
    if (left >= right || !fits(longer)) break;
    best = longer;
    ++left;
    --right;
  }
  return best;
}

void wrapped_text(std::string_view text, const ImVec4& colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  // ImGui breaks words that are longer than a line.
  ImGui::TextWrapped("%s", wrapped(text, ImGui::GetContentRegionAvail().x).c_str());
  ImGui::PopStyleColor();
}

void wrapped_text(std::string_view text) {
  wrapped_text(text, ImGui::GetStyleColorVec4(ImGuiCol_Text));
}

void faint_text(const Palette& colours, const std::string& text) {
  wrapped_text(text, colours.faint);
}

void problem_text(const std::string& problem, const ImVec4& colour) {
  constexpr float kWidestEm = 24.0f;
  const std::string whole = sentence(problem);
  std::string shown = whole;
  for (std::size_t from = shown.find(" ("); from != std::string::npos; from = shown.find(" (")) {
    const std::size_t to = shown.find(')', from);
    if (to == std::string::npos) break;
    shown.erase(from, to + 1 - from);
  }
  wrapped_text(shown, colour);
  if (shown != whole && ImGui::IsItemHovered())
    ImGui::SetTooltip("%s", wrapped(whole, kWidestEm * ImGui::GetFontSize()).c_str());
}

void value_row(const Palette& colours, const char* name, const std::string& value) {
  const float left = ImGui::GetCursorPosX();
  const float gap = 0.5f * ImGui::GetFontSize();
  const float name_end = left + ImGui::CalcTextSize(name).x + gap;
  const float right = ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(value.c_str()).x;
  ImGui::TextColored(colours.faint, "%s", name);
  // A value that does not fit beside the name is below it.
  if (right >= name_end)
    ImGui::SameLine(right);
  else
    ImGui::SetCursorPosX(std::max(left, right));
  ImGui::TextUnformatted(value.c_str());
}

std::string time_text(std::chrono::system_clock::time_point when) {
  return fmt::format("{:%d %b %H:%M}", fmt::localtime(std::chrono::system_clock::to_time_t(when)));
}

void shaded_text(ImDrawList* draw, ImVec2 at, const std::string& text, const ImVec4& colour) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float pad = 0.25f * ImGui::GetFontSize();
  draw->AddRectFilled({at.x - pad, at.y - 0.5f * pad},
                      {at.x + size.x + pad, at.y + size.y + 0.5f * pad},
                      ImGui::GetColorU32(ImGuiCol_PopupBg, kOverView), pad);
  draw->AddText(at, ImGui::GetColorU32(colour), text.c_str());
}

}  // namespace clay::studio
