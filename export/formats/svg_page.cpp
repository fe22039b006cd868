#include "export/formats/svg_page.hpp"

#include <array>
#include <glm/geometric.hpp>

namespace clay::solid::inline formats {
namespace {

constexpr std::string_view kStyle = R"svg(<style>
text { font: 14px "Helvetica Neue", Helvetica, Arial, sans-serif; fill: #3b332c; }
.paper { fill: #faf6ef; stroke: #e2d9cb; }
.beyond { fill: #ecd5bf; stroke: #b98d6a; stroke-width: 1; stroke-linejoin: round; }
.ghost { fill: none; stroke: #b98d6a; stroke-width: 1; stroke-dasharray: 5 4; }
.cut { fill: #b8683c; fill-rule: evenodd; stroke: #5d2f17; stroke-width: 1.4; stroke-linejoin: round; }
.axis { stroke: #3b332c; stroke-width: 0.9; stroke-dasharray: 16 4 2.5 4; }
.ground { fill: url(#hatch); }
.bold { stroke: #3b332c; stroke-width: 2; stroke-linecap: round; }
.thin { stroke: #7d7063; stroke-width: 0.8; }
.arrows { stroke: #7d7063; stroke-width: 0.8; marker-start: url(#arrow); marker-end: url(#arrow); }
</style>
<defs>
<marker id="arrow" viewBox="0 0 10 6" refX="10" refY="3" markerWidth="10" markerHeight="6"
 markerUnits="userSpaceOnUse" orient="auto-start-reverse"><path d="M0 0 10 3 0 6Z" fill="#7d7063"/></marker>
<pattern id="hatch" width="7" height="7" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
<path d="M0 0V7" stroke="#9b8e7f" stroke-width="1.6"/></pattern>
</defs>
)svg";

constexpr double kInvisible = 0.15;  // px: steps of rings far thinner than a pixel

std::string px(double length) { return fixed(length, 2); }
std::string at(glm::dvec2 p) { return px(p.x) + " " + px(p.y); }

}  // namespace

SvgPage::SvgPage(glm::dvec2 size, std::string_view title) {
  const std::string width = fixed(size.x, 0), height = fixed(size.y, 0);
  svg_.open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                    {"width", width},
                    {"height", height},
                    {"viewBox", "0 0 " + width + " " + height},
                    {"role", "img"}});
  svg_.element("title", {}, title);
  svg_.raw(kStyle);
  svg_.element("rect", {{"class", "paper"},
                        {"x", "0.5"},
                        {"y", "0.5"},
                        {"rx", "10"},
                        {"width", px(size.x - 1.0)},
                        {"height", px(size.y - 1.0)}});
}

void SvgPage::fill(std::string_view style, const std::vector<std::vector<glm::dvec2>>& outlines) {
  std::string d;
  for (const auto& outline : outlines) {
    glm::dvec2 last{0.0};
    for (const glm::dvec2& p : outline) {
      const bool first = &p == &outline.front();
      if (!first && glm::distance(p, last) < kInvisible) continue;
      d.append(first ? "M" : " ").append(at(p));
      last = p;
    }
    d += "Z";
  }
  svg_.element("path", {{"class", style}, {"d", d}});
}

void SvgPage::rectangle(std::string_view style, glm::dvec2 corner, glm::dvec2 size) {
  svg_.element("rect", {{"class", style},
                        {"x", px(corner.x)},
                        {"y", px(corner.y)},
                        {"width", px(size.x)},
                        {"height", px(size.y)}});
}

void SvgPage::line(std::string_view style, glm::dvec2 from, glm::dvec2 to) {
  svg_.element("line", {{"class", style},
                        {"x1", px(from.x)},
                        {"y1", px(from.y)},
                        {"x2", px(to.x)},
                        {"y2", px(to.y)}});
}

void SvgPage::dimension(glm::dvec2 from, glm::dvec2 to) { line("arrows", from, to); }

void SvgPage::text(glm::dvec2 where, std::string_view words, Anchor anchor) {
  constexpr std::array<std::string_view, 3> kAnchors{"start", "middle", "end"};
  svg_.element("text",
               {{"x", px(where.x)},
                {"y", px(where.y)},
                {"text-anchor", kAnchors[static_cast<std::size_t>(anchor)]}},
               words);
}

void SvgPage::upright_text(glm::dvec2 where, std::string_view words) {
  svg_.element(
      "text",
      {{"text-anchor", "middle"}, {"transform", "translate(" + at(where) + ") rotate(-90)"}},
      words);
}

std::string SvgPage::finish() {
  svg_.close("svg");
  return svg_.take();
}

}  // namespace clay::solid::inline formats
