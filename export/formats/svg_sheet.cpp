#include "core/svg_writer.hpp"
#include "export/formats/sheet.hpp"

#include <cmath>

namespace clay::solid::inline formats {
namespace {

std::string mm(double length) { return fixed(length + 0.0, 4); }

std::string colour(const LayerStyle& style) {
  const auto byte = [](double part) { return std::to_string(std::lround(255.0 * part)); };
  return "rgb(" + byte(style.red) + "," + byte(style.green) + "," + byte(style.blue) + ")";
}

class SvgSheet {
 public:
  explicit SvgSheet(const Sheet& sheet) : sheet_(sheet) {
    const glm::dvec2 size = sheet.high - sheet.low;
    const std::string width = mm(size.x), height = mm(size.y);
    svg_.open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                      {"width", width + "mm"},
                      {"height", height + "mm"},
                      {"viewBox", "0 0 " + width + " " + height},
                      {"font-family", "DejaVu Sans, Helvetica, Arial, sans-serif"}});
    svg_.element("title", {}, sheet.title);
    svg_.element("rect", {{"id", "paper"},
                          {"width", width},
                          {"height", height},
                          {"fill", "white"},
                          {"stroke", "none"}});
    for (std::size_t i = 0; i < kLayerStyles.size(); ++i) layer(static_cast<SheetLayer>(i));
    svg_.close("svg");
  }

  std::string take() { return svg_.take(); }

 private:
  [[nodiscard]] std::string at(const glm::dvec2& p) const {
    return mm(p.x - sheet_.low.x) + " " + mm(sheet_.high.y - p.y);
  }

  void layer(SheetLayer layer) {
    const LayerStyle& style = style_of(layer);
    svg_.open("g", {{"id", style.name},
                    {"stroke", colour(style)},
                    {"stroke-width", fixed(style.width_mm, 2)},
                    {"stroke-dasharray", style.dash_dot ? "8 1.5 1 1.5" : ""},
                    {"stroke-linejoin", "round"},
                    {"fill", style.filled ? colour(style) : "none"},
                    {"fill-opacity", style.filled ? "0.25" : ""},
                    {"fill-rule", "evenodd"}});
    for (const SheetLines& lines : sheet_.lines)
      if (lines.layer == layer) path(lines);
    for (const SheetText& text : sheet_.texts)
      if (text.layer == layer) words(text, style);
    svg_.close("g");
  }

  void path(const SheetLines& lines) {
    std::string d;
    for (const auto& line : lines.lines) {
      for (const glm::dvec2& p : line) d.append(&p == &line.front() ? "M" : "L").append(at(p));
      if (lines.closed) d += "Z";
    }
    svg_.element("path", {{"d", d}, {"fill", lines.closed ? "" : "none"}});
  }

  void words(const SheetText& text, const LayerStyle& style) {
    constexpr std::array<std::string_view, 3> kAnchors{"", "middle", "end"};
    const std::string turn = text.upright ? " rotate(-90)" : "";
    svg_.element("text",
                 {{"transform", "translate(" + at(text.at) + ")" + turn},
                  {"font-size", fixed(text.height_mm * 1.37, 3)},
                  {"text-anchor", kAnchors[static_cast<std::size_t>(text.anchor)]},
                  {"fill", colour(style)},
                  {"fill-opacity", "1"},
                  {"stroke", "none"}},
                 text.words);
  }

  const Sheet& sheet_;
  SvgWriter svg_;
};

}  // namespace

std::string svg_of(const Sheet& sheet) { return SvgSheet(sheet).take(); }

}  // namespace clay::solid::inline formats
