#include "app/studio/style.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

namespace clay::studio {
namespace {

constexpr float kTextPx = 16.0f, kTitlePx = 22.0f, kSmallPx = 12.0f;
constexpr std::string_view kInter = "/usr/share/fonts/opentype/inter/Inter-",
                           kDejaVu = "/usr/share/fonts/truetype/dejavu/DejaVuSans";

ImVec4 rgb(unsigned hex, float alpha = 1.0f) {
  return {static_cast<float>((hex >> 16) & 255u) / 255.0f,
          static_cast<float>((hex >> 8) & 255u) / 255.0f, static_cast<float>(hex & 255u) / 255.0f,
          alpha};
}

// Okabe and Ito's colours, which colour-blind people can distinguish.
const Palette kDark = {.accent = rgb(0xd98a5b),
                       .faint = rgb(0x9aa0a6),
                       .good = rgb(0x3fb68b),
                       .warning = rgb(0xe69f00),
                       .fault = rgb(0xe8683a),
                       .clay = rgb(0xc67a4e)};
const Palette kLight = {.accent = rgb(0xa9562a),
                        .faint = rgb(0x5f6368),
                        .good = rgb(0x00755a),
                        .warning = rgb(0x8f5d00),
                        .fault = rgb(0xb23c0a),
                        .clay = rgb(0xb5683e)};

/// The greys of a theme.
struct Greys {
  unsigned window, popup, frame, hovered, active, border, text, title;
};
constexpr Greys kDarkGreys = {0x202225, 0x26292d, 0x33373c, 0x3f444a,
                              0x4a5057, 0x3a3e44, 0xe8e6e3, 0x191b1e};
constexpr Greys kLightGreys = {0xf6f4f1, 0xffffff, 0xe4e0da, 0xd8d2ca,
                               0xcbc4ba, 0xcfc9c0, 0x26241f, 0xe9e5df};

void set_colours(const Greys& g, const Palette& p) {
  ImVec4* c = ImGui::GetStyle().Colors;
  const auto accent = [&](float alpha) {
    return ImVec4(p.accent.x, p.accent.y, p.accent.z, alpha);
  };
  c[ImGuiCol_Text] = rgb(g.text);
  c[ImGuiCol_TextDisabled] = p.faint;
  c[ImGuiCol_WindowBg] = c[ImGuiCol_ChildBg] = rgb(g.window);
  c[ImGuiCol_ChildBg].w = 0.0f;
  c[ImGuiCol_PopupBg] = rgb(g.popup);
  c[ImGuiCol_Border] = c[ImGuiCol_Separator] = rgb(g.border);
  c[ImGuiCol_FrameBg] = c[ImGuiCol_Button] = c[ImGuiCol_Tab] = rgb(g.frame);
  c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_ButtonHovered] = rgb(g.hovered);
  c[ImGuiCol_FrameBgActive] = c[ImGuiCol_ButtonActive] = rgb(g.active);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_MenuBarBg] = rgb(g.title);
  c[ImGuiCol_ScrollbarBg] = rgb(g.window, 0.0f);
  c[ImGuiCol_ScrollbarGrab] = rgb(g.hovered);
  c[ImGuiCol_ScrollbarGrabHovered] = c[ImGuiCol_ScrollbarGrabActive] = rgb(g.active);
  // The accent is for the main action alone.
  c[ImGuiCol_CheckMark] = rgb(g.text);
  // Translucent, because dialogs draw the value over it.
  c[ImGuiCol_SliderGrab] = ImVec4(p.faint.x, p.faint.y, p.faint.z, 0.55f);
  c[ImGuiCol_SliderGrabActive] = ImVec4(p.faint.x, p.faint.y, p.faint.z, 0.85f);
  c[ImGuiCol_PlotLines] = c[ImGuiCol_PlotHistogram] = p.accent;
  c[ImGuiCol_Header] = rgb(g.title);
  c[ImGuiCol_HeaderHovered] = c[ImGuiCol_TabHovered] = rgb(g.frame);
  c[ImGuiCol_HeaderActive] = c[ImGuiCol_TabActive] = rgb(g.hovered);
  c[ImGuiCol_TextSelectedBg] = accent(0.35f);
  c[ImGuiCol_NavHighlight] = p.accent;
  c[ImGuiCol_ModalWindowDimBg] = {0.0f, 0.0f, 0.0f, 0.45f};
}

void set_sizes(float scale, bool fingers) {
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowPadding = {12.0f, 10.0f};
  style.FramePadding = {8.0f, 5.0f};
  style.ItemSpacing = {8.0f, 7.0f};
  style.ItemInnerSpacing = {7.0f, 5.0f};
  style.ScrollbarSize = 12.0f;
  style.GrabMinSize = 14.0f;
  style.WindowRounding = 0.0f;
  style.PopupRounding = 6.0f;
  style.FrameRounding = 4.0f;
  style.GrabRounding = 4.0f;
  style.ScrollbarRounding = 6.0f;
  style.WindowBorderSize = 0.0f;
  style.PopupBorderSize = 1.0f;
  if (fingers) {
    style.FramePadding = {10.0f, 12.0f};
    style.ItemSpacing = {9.0f, 14.0f};
    style.ScrollbarSize = 14.0f;
    style.GrabMinSize = 26.0f;
  }
  style.ScaleAllSizes(scale);
}

/// All figures get the advance of the widest one, so that a changing number does not move.
void make_tabular(ImFont& font) {
  float widest = 0.0f;
  for (ImWchar figure = '0'; figure <= '9'; ++figure)
    widest = std::max(widest, font.FindGlyph(figure)->AdvanceX);
  for (ImWchar figure = '0'; figure <= '9'; ++figure) {
    auto& glyph = *const_cast<ImFontGlyph*>(font.FindGlyph(figure));
    const float shift = std::floor(0.5f * (widest - glyph.AdvanceX));
    glyph.X0 += shift;
    glyph.X1 += shift;
    glyph.AdvanceX = font.IndexAdvanceX[figure] = widest;
  }
}

/// Inter, or DejaVu Sans where that is missing, or the font of ImGui.
ImFont* load(const char* inter, const char* dejavu, float size_px, float scale) {
  ImGuiIO& io = ImGui::GetIO();
  // Latin, and the symbols used by units and buttons.
  static constexpr ImWchar kRanges[] = {0x20,   0x17f,  0x370,  0x3ff,  0x2010,
                                        0x2044, 0x2070, 0x209f, 0x2190, 0x21ff,
                                        0x2200, 0x22ff, 0x2600, 0x26ff, 0};
  const std::string paths[] = {std::string(kInter).append(inter).append(".otf"),
                               std::string(kDejaVu).append(dejavu).append(".ttf")};
  std::error_code ignored;
  for (const std::string& path : paths)
    if (std::filesystem::exists(path, ignored))
      if (ImFont* font = io.Fonts->AddFontFromFileTTF(path.c_str(), std::round(size_px * scale),
                                                      nullptr, kRanges))
        return font;
  ImFontConfig config;
  config.SizePixels = std::round(size_px * scale);
  return io.Fonts->AddFontDefault(&config);
}

}  // namespace

ImVec4 ink_on(const ImVec4& face) {
  const ImVec4 ground = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
  const auto light = [&](float over, float under) {
    return std::pow(face.w * over + (1.0f - face.w) * under, 2.2f);
  };
  const float luminance = 0.2126f * light(face.x, ground.x) + 0.7152f * light(face.y, ground.y) +
                          0.0722f * light(face.z, ground.z);
  // The luminance at which the contrasts to black and to white are equal (WCAG).
  constexpr float kEven = 0.179f;
  return luminance > kEven ? rgb(0x141414) : rgb(0xffffff);
}

const Palette& palette(Theme theme) { return theme == Theme::dark ? kDark : kLight; }

Fonts apply_style(Theme theme, float scale, bool fingers) {
  ImGui::GetStyle() = ImGuiStyle();
  set_sizes(scale, fingers);
  set_colours(theme == Theme::dark ? kDarkGreys : kLightGreys, palette(theme));
  ImGui::GetIO().Fonts->Clear();
  Fonts fonts;
  fonts.text = load("Medium", "", kTextPx, scale);
  fonts.title = load("SemiBold", "-Bold", kTitlePx, scale);
  fonts.small = load("Medium", "", kSmallPx, scale);
  ImGui::GetIO().Fonts->Build();
  for (ImFont* font : ImGui::GetIO().Fonts->Fonts) make_tabular(*font);
  return fonts;
}

}  // namespace clay::studio
