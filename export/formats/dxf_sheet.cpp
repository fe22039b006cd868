#include "core/svg_writer.hpp"
#include "export/formats/sheet.hpp"

namespace clay::solid::inline formats {
namespace {

/// ASCII of R12: the diameter sign is "%%c"; other characters become a question mark.
std::string in_dxf(std::string_view words) {
  constexpr std::string_view kDiameter = "\u2300";
  std::string text;
  while (!words.empty()) {
    if (words.starts_with(kDiameter)) {
      text += "%%c";
      words.remove_prefix(kDiameter.size());
      continue;
    }
    const auto c = static_cast<unsigned char>(words[0]);
    if (c < 0x80) text += c < ' ' ? ' ' : words[0];
    if (c >= 0xC0) text += '?';
    words.remove_prefix(1);
  }
  return text;
}

class DxfSheet {
 public:
  explicit DxfSheet(const Sheet& sheet) {
    group(999, in_dxf(sheet.title));
    header(sheet);
    tables();
    begin("ENTITIES");
    for (const SheetLines& lines : sheet.lines)
      for (const auto& line : lines.lines) add(lines, line);
    for (const SheetText& text : sheet.texts) add(text);
    end();
    group(0, "EOF");
  }

  std::string take() { return std::move(dxf_); }

 private:
  void group(int code, std::string_view value) {
    dxf_.append(std::to_string(code)).append("\n").append(value).append("\n");
  }
  void group(int code, double value) { group(code, fixed(value + 0.0, 6)); }
  void point(int code, const glm::dvec2& p) {
    group(code, p.x);
    group(code + 10, p.y);
    group(code + 20, 0.0);
  }
  void begin(std::string_view section) {
    group(0, "SECTION");
    group(2, section);
  }
  void end() { group(0, "ENDSEC"); }

  void header(const Sheet& sheet) {
    begin("HEADER");
    group(9, "$ACADVER");
    group(1, "AC1009");
    group(9, "$INSUNITS");
    group(70, "4");  // mm
    group(9, "$EXTMIN");
    point(10, sheet.low);
    group(9, "$EXTMAX");
    point(10, sheet.high);
    end();
  }

  void tables() {
    begin("TABLES");
    group(0, "TABLE");
    group(2, "LTYPE");
    group(70, "2");
    line_type("CONTINUOUS", "Solid", {});
    line_type("DASHDOT", "Dash dot", {8.0, -1.5, 1.0, -1.5});
    group(0, "ENDTAB");
    group(0, "TABLE");
    group(2, "LAYER");
    group(70, std::to_string(kLayerStyles.size()));
    for (const LayerStyle& style : kLayerStyles) {
      group(0, "LAYER");
      group(2, style.name);
      group(70, "0");
      group(62, std::to_string(style.dxf_colour));
      group(6, style.dash_dot ? "DASHDOT" : "CONTINUOUS");
    }
    group(0, "ENDTAB");
    end();
  }

  void line_type(std::string_view name, std::string_view title, const std::vector<double>& dashes) {
    group(0, "LTYPE");
    group(2, name);
    group(70, "0");
    group(3, title);
    group(72, "65");
    group(73, std::to_string(dashes.size()));
    double length = 0.0;
    for (const double dash : dashes) length += dash < 0.0 ? -dash : dash;
    group(40, length);
    for (const double dash : dashes) group(49, dash);
  }

  void add(const SheetLines& lines, const std::vector<glm::dvec2>& line) {
    const std::string_view layer = style_of(lines.layer).name;
    if (line.size() == 2 && !lines.closed) {
      group(0, "LINE");
      group(8, layer);
      point(10, line[0]);
      point(11, line[1]);
      return;
    }
    group(0, "POLYLINE");
    group(8, layer);
    group(66, "1");
    point(10, {0.0, 0.0});
    group(70, lines.closed ? "1" : "0");
    for (const glm::dvec2& p : line) {
      group(0, "VERTEX");
      group(8, layer);
      point(10, p);
    }
    group(0, "SEQEND");
    group(8, layer);
  }

  void add(const SheetText& text) {
    group(0, "TEXT");
    group(8, style_of(text.layer).name);
    point(10, text.at);
    group(40, text.height_mm);
    group(1, in_dxf(text.words));
    if (text.upright) group(50, 90.0);
    if (text.anchor == SheetText::Anchor::start) return;
    group(72, text.anchor == SheetText::Anchor::middle ? "1" : "2");
    point(11, text.at);
  }

  std::string dxf_;
};

}  // namespace

std::string dxf_of(const Sheet& sheet) { return DxfSheet(sheet).take(); }

}  // namespace clay::solid::inline formats
