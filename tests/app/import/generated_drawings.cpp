#include "tests/app/import/generated_drawings.hpp"

#include "app/import/drawn_pot.hpp"
#include "tests/app/import/raster.hpp"
#include "tests/support/run_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clay::importing::generated {
namespace {

constexpr double kPixelsPerMm = 25.0;
constexpr double kMarginMm = 2.0;

/// The standard's distributions differ between libraries.
double between(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
}
bool toss(std::mt19937& random) { return (random() >> 16) % 2 == 0; }

/// One side of the wall, upward: radii that change smoothly enough to leave a wall between.
std::vector<Piece> side(std::mt19937& random, bool curves, const std::vector<glm::dvec2>& corners) {
  std::vector<Piece> pieces;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const glm::dvec2 from = corners[i - 1], to = corners[i];
    Piece piece{to, 0.0, false, {}, {}};
    if (curves && toss(random)) {
      piece.bulge = between(random, -0.12, 0.12);
    } else if (curves) {
      piece.cubic = true;
      piece.steer_1 = from + 0.3 * (to - from) + glm::dvec2{between(random, -0.7, 0.7), 0.0};
      piece.steer_2 = from + 0.7 * (to - from) + glm::dvec2{between(random, -0.7, 0.7), 0.0};
    }
    pieces.push_back(piece);
  }
  return pieces;
}

void append(std::vector<Piece>& all, const std::vector<Piece>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

std::string svg_point(glm::dvec2 p) { return fmt::format("{:.9g} {:.9g}", p.x, p.y); }

/// The radius of an arc by its bulge.
double radius_of(glm::dvec2 from, const Piece& piece) {
  const double chord = std::hypot(piece.to.x - from.x, piece.to.y - from.y);
  return chord * (1.0 + piece.bulge * piece.bulge) / (4.0 * std::abs(piece.bulge));
}

/// Commands in coordinates with y up: a group with scale(1 -1) puts them on the page.
std::string path_of(const Outline& outline) {
  std::string d = "M 0 0";
  glm::dvec2 from{0.0};
  for (const Piece& piece : outline.pieces) {
    const std::string to = svg_point(piece.to);
    if (piece.cubic)
      d += " C " + svg_point(piece.steer_1) + " " + svg_point(piece.steer_2) + " " + to;
    else if (piece.bulge != 0.0)
      d += fmt::format(" A {0:.9g} {0:.9g} 0 0 {1} {2}", radius_of(from, piece),
                       piece.bulge > 0.0 ? 1 : 0, to);
    else
      d += " L " + to;
    from = piece.to;
  }
  return d + " Z";
}

glm::ivec2 pixels_of(const Outline& outline) {
  const auto size = [](double mm) {
    return static_cast<int>(std::ceil((mm + 2.0 * kMarginMm) * kPixelsPerMm));
  };
  return {size(outline.width_mm), size(outline.height_mm)};
}

std::string page(const Outline& outline, const std::string& content) {
  const glm::dvec2 mm = glm::dvec2(pixels_of(outline)) / kPixelsPerMm;
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0}mm' height='{1}mm' viewBox='0 0 {0} {1}'>"
      "{2}</svg>",
      mm.x, mm.y, content);
}

std::string to_page(const Outline& outline) {
  return fmt::format("translate({} {}) scale(1 -1)", kMarginMm, kMarginMm + outline.height_mm);
}

}  // namespace

Outline outline(std::mt19937& random, bool curves) {
  const double wall = between(random, 2.5, 5.0), floor = between(random, 2.0, 5.5);
  const int parts = 1 + static_cast<int>(random() % 4);
  Outline result;
  std::vector<glm::dvec2> outer{{between(random, 12.0, 22.0), 0.0}};
  for (int i = 0; i < parts; ++i)
    outer.emplace_back(std::clamp(outer.back().x + between(random, -5.0, 5.0), 9.0, 30.0),
                       outer.back().y + between(random, 6.0, 12.0));
  // The bore is the outside, moved in; a lip slants to either side.
  std::vector<glm::dvec2> inner;
  for (const glm::dvec2& p : outer) inner.emplace_back(p.x - wall, p.y);
  inner.back().y += between(random, -1.5, 1.5);
  const double part = floor / inner[1].y;
  inner.front() = {inner[0].x + part * (inner[1].x - inner[0].x), floor};
  std::reverse(inner.begin(), inner.end());
  result.pieces.push_back({outer.front(), 0.0, false, {}, {}});
  append(result.pieces, side(random, curves, outer));
  result.pieces.push_back({inner.front(), 0.0, false, {}, {}});
  append(result.pieces, side(random, curves, inner));
  result.pieces.push_back({{0.0, floor}, 0.0, false, {}, {}});
  result.width_mm = 34.0;
  result.height_mm = std::max(outer.back().y, inner.front().y);
  return result;
}

std::string plain_svg(const Outline& outline) {
  return page(outline, "<path transform='" + to_page(outline) + "' d='" + path_of(outline) + "'/>");
}

std::string svg_file(const Outline& outline, std::mt19937& random) {
  // The inverse of a transform on the group is on the shape.
  const double s = between(random, 0.4, 3.0), x = between(random, -9.0, 9.0);
  const std::string group = fmt::format("{} translate({} 5) scale({})", to_page(outline), x, s);
  const std::string own = fmt::format("scale({:.15g}) translate({} -5)", 1.0 / s, -x);
  const std::string hidden = "<rect class='off' width='9' height='90'/>";
  const bool lines = std::none_of(outline.pieces.begin(), outline.pieces.end(),
                                  [](const Piece& p) { return p.cubic || p.bulge != 0.0; });
  std::string shape = fmt::format("<path id='p' transform='{}' style='paint-order:fill' d='{}'/>",
                                  own, path_of(outline));
  if (lines && toss(random)) {
    std::string points = "0,0";
    for (const Piece& piece : outline.pieces) points += " " + svg_point(piece.to);
    shape = fmt::format("<polygon id='p' transform='{}' points='{}'/>", own, points);
  }
  const std::string style = "<style>.off{display:none}</style>";
  if (toss(random))
    return page(outline, style + "<defs>" + shape + "</defs><g transform='" + group +
                             "'><use href='#p'/>" + hidden + "</g>");
  return page(outline, style + "<g transform='" + group + "'>" + hidden + shape + "</g>");
}

std::string dxf_file(const Outline& outline, std::mt19937& random) {
  const bool block = toss(random), one = toss(random);
  const double s = block ? between(random, 0.5, 2.0) : 1.0;
  std::string entities;
  const auto add = [&](const std::vector<std::pair<int, double>>& numbers) {
    for (const auto& [code, value] : numbers) entities += fmt::format("{}\n{:.12g}\n", code, value);
  };
  const auto begin = [&](const char* type) {
    entities += fmt::format("0\n{}\n100\nAcDbEntity\n8\n0\n", type);
  };
  glm::dvec2 from{0.0};
  for (const Piece& piece : outline.pieces) {
    const glm::dvec2 a = from / s, b = piece.to / s;
    if (piece.cubic) {
      begin("SPLINE");
      add({{70, 8}, {71, 3}, {72, 8}, {73, 4}, {74, 0}});
      for (int i = 0; i < 8; ++i) add({{40, i < 4 ? 0.0 : 1.0}});
      for (const glm::dvec2 p : {a, piece.steer_1 / s, piece.steer_2 / s, b})
        add({{10, p.x}, {20, p.y}, {30, 0.0}});
    } else if (piece.bulge != 0.0 || one) {
      begin("LWPOLYLINE");
      add({{90, 2}, {70, 0}, {10, a.x}, {20, a.y}, {42, piece.bulge}, {10, b.x}, {20, b.y}});
    } else {
      begin("LINE");
      // In either direction.
      const bool back = toss(random);
      const glm::dvec2 p = back ? b : a, q = back ? a : b;
      add({{10, p.x}, {20, p.y}, {11, q.x}, {21, q.y}});
    }
    from = piece.to;
  }
  std::string file = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n";
  if (!block) return file + "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
  file += "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n8\n0\n2\npot\n10\n0\n20\n0\n" + entities +
          "0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
  return file +
         fmt::format("0\nINSERT\n8\n0\n2\npot\n10\n{}\n20\n{}\n41\n{:.15g}\n42\n{:.15g}\n",
                     between(random, -50.0, 50.0), between(random, -50.0, 50.0), s, s) +
         "0\nENDSEC\n0\nEOF\n";
}

std::string csv_file(const Outline& outline, std::mt19937& random) {
  const bool inches = toss(random), swapped = toss(random), comma = toss(random);
  const std::string unit = inches ? "in" : "mm", mark = comma ? ";" : ",";
  std::string file = swapped ? "height_" + unit + mark + "radius_" + unit
                             : "radius_" + unit + mark + "height_" + unit;
  const auto add = [&](glm::dvec2 p) {
    if (inches) p /= 25.4;
    if (swapped) std::swap(p.x, p.y);
    std::string x = fmt::format("{:.9f}", p.x), y = fmt::format("{:.9f}", p.y);
    if (comma) {
      std::replace(x.begin(), x.end(), '.', ',');
      std::replace(y.begin(), y.end(), '.', ',');
    }
    file += "\n" + x + mark + y;
  };
  add({0.0, 0.0});
  for (const Piece& piece : outline.pieces) add(piece.to);
  return file + "\n";
}

std::string difference(const std::string& format, unsigned number) {
  std::mt19937 random(1000 * number + static_cast<unsigned>(format.front()));
  const Outline drawn = outline(random, format != "csv" && number % 4 != 0);
  const std::string bytes = format == "svg"   ? svg_file(drawn, random)
                            : format == "dxf" ? dxf_file(drawn, random)
                                              : csv_file(drawn, random);
  const std::string name = "drawing." + format, which = fmt::format("{} {}: ", format, number);
  const auto pot =
      read_drawing(bytes, name)
          .and_then([&](Drawing&& drawing) {
            return half_section(std::move(drawing), {AxisRule::left, 0.0, {}}, name);
          })
          .and_then([&](HalfSection&& section) { return drawn_pot(section, {}, name); });
  if (!pot) return which + pot.error().message;
  if (pot->deviation.mm > kDrawnDeviationMm)
    return which + fmt::format("deviates by {} mm", pot->deviation.mm);
  const ClayStack& stack = pot->pot.stack;
  std::vector<Line> rings;
  for (std::size_t i = 0; i < stack.size(); ++i) {
    const double r = kMarginMm + stack.rings()[i].inner_mm();
    const double outer = kMarginMm + stack.rings()[i].outer_mm();
    const double top = kMarginMm + drawn.height_mm;
    const double low = static_cast<double>(i) * stack.ring_height_mm() - top;
    const double high = low + stack.ring_height_mm();
    rings.push_back({{{r, low}, {outer, low}, {outer, high}, {r, high}}, true});
  }
  const test::ScratchFolder folder;
  test::write_text(folder.file("peer.svg"), format == "svg" ? bytes : plain_svg(drawn));
  const glm::ivec2 size = pixels_of(drawn);
  const auto own = raster::drawn(rings, size.x, size.y, kPixelsPerMm);
  const auto peer = raster::rendered(folder.file("peer.svg"), size.x, size.y, folder.path());
  if (peer.width != size.x || peer.height != size.y) return which + "not painted";
  // Within the deviation of an outline of at most 200 mm, of which a tenth is all to one side.
  const double area_mm2 = std::abs(own.area() - peer.area()) / (kPixelsPerMm * kPixelsPerMm);
  if (area_mm2 > 0.1 * 200.0 * kDrawnDeviationMm)
    return which + fmt::format("the area differs by {} mm2", area_mm2);
  constexpr int kMargin = 2;  // pixels: more than the deviation, and one for the edge itself
  static_assert(kMargin > kDrawnDeviationMm * kPixelsPerMm + 1.0);
  const long far = raster::differing_far_from_edges(peer, own, kMargin);
  return far == 0 ? "" : which + fmt::format("{} pixels away from the outline differ", far);
}

}  // namespace clay::importing::generated
