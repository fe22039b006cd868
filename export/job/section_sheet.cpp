#include "export/job/section_sheet.hpp"

#include "core/size_text.hpp"
#include "core/svg_writer.hpp"
#include "export/section/stack_section.hpp"
#include "export/smoothing/wall_guard.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace clay::solid::inline job {
namespace {

using Outline = std::vector<glm::dvec2>;
using Anchor = SheetText::Anchor;

constexpr double kScaleBarMm = 100.0;
constexpr double kArrowMm = 2.5;

Outline right_of(const Polygon& line) {
  Outline outline;
  for (const ProfilePoint& p : line) outline.emplace_back(p.rho, p.y);
  return outline;
}

Outline mirrored(Outline outline) {
  for (glm::dvec2& p : outline) p.x = -p.x;
  std::ranges::reverse(outline);
  return outline;
}

/// The cut faces on both sides of the axis, joined where clay reaches it.
std::vector<Outline> cut_faces(const Profile& profile) {
  std::vector<Outline> faces;
  for (const Polygon& polygon : profile.pieces) {
    for (const Chain& chain : chains_of(polygon)) {
      Polygon line;
      for (std::size_t i = 0; i < chain.edges + (chain.round ? 0 : 1); ++i)
        line.push_back(polygon[(chain.first + i) % polygon.size()]);
      Outline right = right_of(line), left = mirrored(right);
      if (chain.round) {
        faces.push_back(std::move(right));
        faces.push_back(std::move(left));
        continue;
      }
      // Both poles are in both halves.
      right.insert(right.end(), left.begin() + 1, left.end() - 1);
      faces.push_back(std::move(right));
    }
  }
  return faces;
}

/// Number of characters in UTF-8.
double letters_in(std::string_view words) {
  const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  return static_cast<double>(std::ranges::count_if(words, begins));
}

/// Of the words of a dimension, 3 mm high in DejaVu Sans: a little more than they take [mm].
double length_of(std::string_view words) {
  constexpr double kLetterMm = 2.15, kMoreMm = 1.5;
  return kMoreMm + kLetterMm * letters_in(words);
}

class SheetMaker {
 public:
  SheetMaker(const ExportReport& report, const ExportOptions& options)
      : report_(report),
        profile_(report.section.profile()),
        measures_(profile_),
        numbers_(*report.maker),
        // The set-back for the glaze makes a round edge sharper.
        lip_mm_(report.section.smoothed.lip_fillet_mm - options.finish.glaze_mm),
        shrinkage_(options.shrinkage),
        goal_(options.met_goal) {
    sheet_.title = options.name;
  }

  Sheet make() {
    draw_pot();
    draw_diameters();
    draw_heights();
    draw_rib();
    draw_scale();
    write_table(write_facts(-38.0));
    choose_paper();
    return std::move(sheet_);
  }

 private:
  // ---- lines and texts ----

  void add(SheetLayer layer, std::vector<Outline> lines, bool closed) {
    for (const Outline& line : lines)
      for (const glm::dvec2& p : line) reach(p);
    sheet_.lines.push_back({layer, std::move(lines), closed});
  }
  void line(SheetLayer layer, glm::dvec2 from, glm::dvec2 to) { add(layer, {{from, to}}, false); }

  void write(SheetLayer layer, glm::dvec2 at, const std::string& words, Anchor anchor,
             double height = 3.0, bool upright = false) {
    const double length = 0.85 * height * letters_in(words);  // a wide letter
    const double before = length * 0.5 * static_cast<double>(anchor);
    const glm::dvec2 way = upright ? glm::dvec2{0.0, 1.0} : glm::dvec2{1.0, 0.0};
    reach(at - before * way);
    reach(at + (length - before) * way + glm::dvec2{0.0, height});
    sheet_.texts.push_back({layer, at, words, height, anchor, upright});
  }

  void reach(const glm::dvec2& p) {
    low_ = glm::min(low_, p);
    high_ = glm::max(high_, p);
  }

  /// A line with an arrow at each end.
  void arrows(glm::dvec2 from, glm::dvec2 to) {
    line(SheetLayer::dimensions, from, to);
    const glm::dvec2 way = glm::normalize(to - from) * kArrowMm;
    const glm::dvec2 side{-0.2 * way.y, 0.2 * way.x};
    add(SheetLayer::dimensions, {{from + way + side, from, from + way - side}}, false);
    add(SheetLayer::dimensions, {{to - way + side, to, to - way - side}}, false);
  }

  /// "174.5", with the fired size if the shrinkage is known.
  [[nodiscard]] std::string size(double mm) const {
    std::string text = size_text(mm, 1);
    if (shrinkage_ > 0.0) text += " (fired " + size_text((1.0 - shrinkage_) * mm, 1) + ")";
    return text;
  }

  // ---- the pot ----

  void draw_pot() {
    for (const Polygon& piece : profile_.pieces) {
      Outline right = right_of(lines_of(piece).outer), left = mirrored(right);
      right.insert(right.end(), left.begin(), left.end());
      add(SheetLayer::outside, {std::move(right)}, true);
    }
    add(SheetLayer::section, cut_faces(profile_), true);
    line(SheetLayer::axis, {0.0, -6.0}, {0.0, top_ + 6.0});
  }

  void diameter(double diameter_mm, double at_height, double line_height) {
    const double r = 0.5 * diameter_mm, way = line_height > at_height ? 1.0 : -1.0;
    for (const double side : {-1.0, 1.0})
      line(SheetLayer::dimensions, {side * r, at_height + way},
           {side * r, line_height + 1.5 * way});
    arrows({-r, line_height}, {r, line_height});
    // Beside the axis, or outside if the words would reach the right arrow.
    const std::string words = "\u2300 " + size(diameter_mm);
    if (2.0 + length_of(words) < r - kArrowMm)
      return write(SheetLayer::dimensions, {2.0, line_height + 1.0}, words, Anchor::start);
    // Above the pot, beyond the lines that rise from its widest place.
    const double end = way > 0.0 ? radius_ : r;
    if (end > r) line(SheetLayer::dimensions, {r, line_height}, {end + 2.0, line_height});
    write(SheetLayer::dimensions, {end + 3.0, line_height - 1.0}, words, Anchor::start);
  }

  void draw_diameters() {
    diameter(2.0 * radius_, measures_.widest_at_mm(), top_ + 19.0);
    if (const double mouth = measures_.mouth_mm(); mouth > 0.0)
      diameter(2.0 * mouth, top_, top_ + 10.0);
    diameter(numbers_.thrown.size.foot_diameter_mm, 0.0, -10.0);
  }

  void height(double from, double to, double at, double reach_from, double reach_to) {
    line(SheetLayer::dimensions, {reach_from + 1.0, from}, {at + 1.5, from});
    line(SheetLayer::dimensions, {reach_to + 1.0, to}, {at + 1.5, to});
    arrows({at, from}, {at, to});
    write(SheetLayer::dimensions, {at - 1.0, 0.5 * (from + to)}, size(to - from), Anchor::middle,
          3.0, true);
  }

  void draw_heights() {
    const double foot = 0.5 * numbers_.thrown.size.foot_diameter_mm;
    const double rim = lines_of(profile_.pieces.back()).outer.back().rho;
    if (numbers_.thrown.capacity_ml > 0.0) {
      const double floor = measures_.floor_mm();
      height(floor, top_, radius_ + 12.0, measures_.bore_at_mm(floor), rim);
      write_floor(floor);
    }
    height(0.0, top_, radius_ + 22.0, foot, rim);
    constexpr double kLeastLipMm = 0.05;  // a smaller one would be written as 0.0
    if (lip_mm_ >= kLeastLipMm) {
      // Between the line of the height and the words of the mouth.
      line(SheetLayer::dimensions, {rim, top_}, {radius_ + 5.0, top_ + 3.0});
      write(SheetLayer::dimensions, {radius_ + 6.0, top_ + 2.5}, "lip R " + size(lip_mm_),
            Anchor::start);
    }
    for (const CaliperRow& row : caliper_rows(profile_)) {
      line(SheetLayer::dimensions, {-0.5 * row.outer - 1.0, row.height},
           {-radius_ - 6.0, row.height});
      write(SheetLayer::dimensions, {-radius_ - 7.0, row.height - 1.5}, size(row.wall()),
            Anchor::end);
    }
  }

  /// In the bore above the floor, on two lines if one is too long; beside the foot if the bore is
  /// too narrow for both.
  void write_floor(double floor) {
    constexpr double kLine = 4.5, kGap = 2.0;
    std::string words = "floor " + size(floor - measures_.below_floor_mm());
    std::string second;
    const auto fits = [&](double height) {
      return kGap + std::max(length_of(words), length_of(second)) + kGap <
             measures_.bore_between_mm(floor, floor + height);
    };
    if (fits(kLine + 5.0))
      return write(SheetLayer::dimensions, {kGap, floor + 5.0}, words, Anchor::start);
    if (const std::size_t fired = words.find(" ("); fired != std::string::npos) {
      second = words.substr(fired + 1);
      words.resize(fired);
      if (fits(2.0 * kLine + 5.0)) {
        write(SheetLayer::dimensions, {kGap, floor + 5.0 + kLine}, words, Anchor::start);
        return write(SheetLayer::dimensions, {kGap, floor + 5.0}, second, Anchor::start);
      }
      words += " " + second;
    }
    const double foot = 0.5 * numbers_.thrown.size.foot_diameter_mm;
    write(SheetLayer::dimensions, {-foot - 3.0, -5.0}, words, Anchor::end);
  }

  /// A template whose left edge shapes the outside.
  void draw_rib() {
    const Polygon wall = lines_of(profile_.pieces.back()).outer;
    double narrowest = radius_;
    for (const ProfilePoint& p : wall) narrowest = std::min(narrowest, p.rho);
    const double shift = radius_ + 34.0 - narrowest, back = radius_ + shift + 15.0;
    Outline rib;
    for (const ProfilePoint& p : wall) rib.emplace_back(p.rho + shift, p.y);
    rib.emplace_back(back, wall.back().y);
    rib.emplace_back(back, wall.front().y);
    add(SheetLayer::rib, {std::move(rib)}, true);
    write(SheetLayer::text, {back - 3.0, 0.5 * top_}, "rib, outside", Anchor::middle, 3.0, true);
  }

  // ---- words ----

  void draw_scale() {
    const glm::dvec2 from{-radius_, -24.0};
    line(SheetLayer::scale, from, from + glm::dvec2{kScaleBarMm, 0.0});
    for (int tick = 0; tick <= 10; ++tick) {
      const glm::dvec2 at = from + glm::dvec2{0.1 * kScaleBarMm * tick, 0.0};
      line(SheetLayer::scale, at, at + glm::dvec2{0.0, tick % 5 == 0 ? 3.0 : 1.5});
    }
    write(SheetLayer::scale, from + glm::dvec2{0.0, -4.5}, "100 mm if printed at 100 %",
          Anchor::start);
  }

  [[nodiscard]] static std::string state(std::string_view name, const PotState& pot) {
    return std::string(name) + ": " + size_text(pot.size.diameter_mm, 1) + " x " +
           size_text(pot.size.height_mm, 1) + " mm, " + size_text(pot.weight_g, 0) + " g" +
           (pot.capacity_ml > 0.0 ? ", holds " + size_text(pot.capacity_ml, 0) + " ml" : "");
  }

  /// On two lines, which are as long as the others.
  void add_assumptions(std::vector<std::string>& facts) const {
    std::string lines[2] = {"assumed: ", ""};
    const auto rows = assumptions_of(numbers_.clay);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      std::string& line = lines[2 * i < rows.size() + 1 ? 0 : 1];
      line += rows[i].first + " " + rows[i].second + (i + 1 < rows.size() ? ", " : "");
    }
    for (std::string& line : lines) facts.push_back(std::move(line));
  }

  /// Returns the height below the last line.
  double write_facts(double y) {
    const double left = -radius_;
    write(SheetLayer::text, {left, y}, sheet_.title, Anchor::start, 4.0);
    std::vector<std::string> facts{state("wet (drawn)", numbers_.thrown)};
    if (numbers_.dry) facts.push_back(state("dry", *numbers_.dry));
    if (numbers_.fired) facts.push_back(state("fired", *numbers_.fired));
    if (numbers_.glazed) facts.push_back(state("glazed", *numbers_.glazed));
    if (goal_) facts.push_back("scaled to: " + text_of(*goal_));
    if (shrinkage_ > 0.0) add_assumptions(facts);
    facts.push_back("thinnest wall " + size_text(report_.walls.thinnest.thickness_mm, 1) +
                    " at a height of " + size_text(report_.walls.thinnest.from.y, 1) +
                    "; all sizes in mm");
    for (const std::string& fact : facts)
      write(SheetLayer::text, {left, y -= 5.5}, fact, Anchor::start, 2.5);
    return y - 8.0;
  }

  void write_table(double y) {
    std::vector<std::string> heads{"height", "outside \u2300", "inside \u2300", "wall"};
    std::vector<double> factors{1.0};
    if (shrinkage_ > 0.0) {
      for (const char* head : {"fired height", "outside \u2300", "inside \u2300", "wall"})
        heads.emplace_back(head);
      factors.push_back(1.0 - shrinkage_);
    }
    const auto row = [&](const std::vector<std::string>& cells) {
      for (std::size_t i = 0; i < cells.size(); ++i)
        write(SheetLayer::text,
              {-radius_ + 22.0 * static_cast<double>(i + 1) + (i < 4 ? -2.0 : 6.0), y}, cells[i],
              Anchor::end, 2.5);
      y -= 4.5;
    };
    row(heads);
    for (const CaliperRow& caliper : caliper_rows(profile_)) {
      std::vector<std::string> cells;
      for (const double factor : factors)
        for (const double mm : {caliper.height, caliper.outer, caliper.bore, caliper.wall()})
          cells.push_back(size_text(factor * mm, 1));
      row(cells);
    }
  }

  /// The smallest paper of ISO 216 that holds the drawing, or its own size; the drawing is centred.
  void choose_paper() {
    constexpr std::array<glm::dvec2, 5> kPapers{
        {{210, 297}, {297, 420}, {420, 594}, {594, 841}, {841, 1189}}};
    const glm::dvec2 need = high_ - low_ + glm::dvec2(16.0);
    glm::dvec2 paper = need;
    for (auto at = kPapers.rbegin(); at != kPapers.rend(); ++at) {
      if (need.x <= at->x && need.y <= at->y)
        paper = *at;
      else if (need.x <= at->y && need.y <= at->x)
        paper = {at->y, at->x};
    }
    sheet_.low = 0.5 * (low_ + high_ - paper);
    sheet_.high = sheet_.low + paper;
  }

  const ExportReport& report_;
  const Profile& profile_;
  SectionMeasures measures_;
  double radius_ = measures_.radius_mm(), top_ = measures_.top_mm();
  const MakerNumbers& numbers_;
  double lip_mm_, shrinkage_;
  const std::optional<MetGoal>& goal_;
  glm::dvec2 low_{0.0}, high_{0.0};  ///< of everything drawn
  Sheet sheet_;
};

}  // namespace

std::string drawing_svg(const ExportReport& report, const ExportOptions& options) {
  return svg_of(section_sheet(report, options));
}

Sheet section_sheet(const ExportReport& report, const ExportOptions& options) {
  return SheetMaker(report, options).make();
}

}  // namespace clay::solid::inline job
