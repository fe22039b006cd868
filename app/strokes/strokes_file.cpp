#include "app/strokes/strokes.hpp"

#include "core/json/object_reader.hpp"
#include "core/text.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace clay::strokes {
namespace {

constexpr Range kPositionMm = from(-1000).to(1000), kSpeedMmS = from(1).to(10'000),
                kRateHz = from(200).to(10'000), kTremorMm = from(0).to(10), kHoldS = from(0).to(60),
                kGapMm = from(0).to(1000), kHeightMm = from(0).to(1000);
constexpr std::int64_t kMostPasses = 100;
constexpr std::size_t kMostTextBytes = 200, kMostPathPoints = 100'000, kMostOutlinePoints = 1000;
constexpr std::array<std::string_view, 4> kKinds = {"path", "shape", "pull", "lip"};

/// For people: a name, a hint.
void read_text(ObjectReader& io, std::string_view name, std::string& text) {
  io.text(name, text);
  io.check([&](ObjectReader& reader) {
    reader.expect(text.size() <= kMostTextBytes, name,
                  "a text of at most " + std::to_string(kMostTextBytes) + " bytes");
  });
}

void check_path(ObjectReader& io, const Stroke& stroke) {
  const auto& points = stroke.through_mm;
  // A spline has no direction between equal points.
  if (const auto equal = std::ranges::adjacent_find(points); equal != points.end())
    io.refuse_element("through_mm", static_cast<std::size_t>(equal + 1 - points.begin()),
                      "expected a point apart from the one before it, found the same one");
  io.expect(stroke.gap_mm.size() <= 1 || stroke.gap_mm.size() == points.size(), "gap_mm",
            "a number or an array of " + std::to_string(points.size()) + ", as many as through_mm");
}

void read_path(ObjectReader& io, Stroke& stroke) {
  io.require({"through_mm"});
  io.points("through_mm", stroke.through_mm, kPositionMm, 2, kMostPathPoints);
  io.vector("step_mm", stroke.step_mm, kPositionMm);
  io.series("gap_mm", stroke.gap_mm, kGapMm);
  io.check([&](ObjectReader& reader) { check_path(reader, stroke); });
}

void check_heights(ObjectReader& io, std::string_view name,
                   const std::vector<glm::dvec2>& outline) {
  const bool rises = outline.back().y > outline.front().y;
  for (std::size_t k = 1; k < outline.size(); ++k) {
    const double below = outline[k - 1].y, height = outline[k].y;
    if (rises ? height > below : height < below) continue;
    return io.refuse_element(
        name, k,
        std::string("expected a height ") + (rises ? "above " : "below ") + number_text(below) +
            ", because heights ascend or descend, found " + number_text(height));
  }
}

void read_outline(ObjectReader& io, Stroke& stroke) {
  std::vector<glm::dvec2> in_mm;
  io.points("outline", stroke.outline, kPositionMm, 2, kMostOutlinePoints);
  io.points("outline_mm", in_mm, kPositionMm, 2, kMostOutlinePoints);
  stroke.outline_in_mm = !in_mm.empty();
  io.check([&](ObjectReader& reader) {
    reader.expect(stroke.outline.empty() || in_mm.empty(), "outline_mm", "no outline beside it");
    if (stroke.outline_in_mm)
      stroke.outline = std::move(in_mm);
    else
      reader.require({"outline"});
  });
  io.check([&](ObjectReader& reader) {
    check_heights(reader, stroke.outline_in_mm ? "outline_mm" : "outline", stroke.outline);
  });
}

void read_pull(ObjectReader& io, Stroke& stroke) {
  read_outline(io, stroke);
  io.require({"gap_mm", "from_mm"});
  io.series("gap_mm", stroke.gap_mm, kGapMm);
  io.number("from_mm", stroke.from_mm, kHeightMm);
  io.number("ease_mm", stroke.ease_mm, kHeightMm);
  io.check([&](ObjectReader& reader) {
    reader.expect(stroke.gap_mm.size() <= 2, "gap_mm", "a number or an array of 2");
  });
}

/// The fields of one kind; those of the other kinds would have no effect, and are unknown.
void read_kind(ObjectReader& io, Stroke& stroke) {
  switch (stroke.kind) {
    case StrokeKind::path:
      return read_path(io, stroke);
    case StrokeKind::shape:
      read_outline(io, stroke);
      return io.flag("inside", stroke.inside);
    case StrokeKind::pull:
      return read_pull(io, stroke);
    case StrokeKind::lip:
      return;
  }
}

}  // namespace

static void describe(ObjectReader& io, Stroke& stroke) {
  read_text(io, "name", stroke.name);
  read_text(io, "hint", stroke.hint);
  io.choice("kind", stroke.kind, kKinds);
  io.number("speed_mm_s", stroke.speed_mm_s, kSpeedMmS);
  io.integer("passes", stroke.passes, 1, kMostPasses);
  io.number("hold_s", stroke.hold_s, kHoldS);
  io.flag("trim", stroke.trim);
  read_kind(io, stroke);
}

static void describe(ObjectReader& io, StrokeScript& script) {
  io.require({"start_mm", "strokes"});
  io.natural("seed", script.seed);
  io.number("rate_hz", script.rate_hz, kRateHz);
  io.number("tremor_mm", script.tremor_mm, kTremorMm);
  io.number("travel_mm_s", script.travel_mm_s, kSpeedMmS);
  io.vector("start_mm", script.start_mm, kPositionMm);
  io.parts("strokes", script.strokes);
  io.check([&](ObjectReader& reader) {
    reader.expect(!script.strokes.empty(), "strokes", "one stroke at least");
  });
}

namespace {

/// Estimated maximum of the poses of a stroke, from the distances between its points; the hand's
/// mean speed is 8/15 of its peak, and varies by a tenth. The length of a stroke that is planned on
/// the pot is not known yet: a metre, and another between strokes.
double poses_of(const StrokeScript& script, const Stroke& stroke) {
  constexpr double kSlowest = 1.875 / 0.9, kPlannedMm = 1000.0;
  if (stroke.kind != StrokeKind::path)
    return script.rate_hz * stroke.passes *
           (kSlowest * kPlannedMm * (1.0 / stroke.speed_mm_s + 1.0 / script.travel_mm_s) +
            stroke.hold_s);
  const auto shift = [&](int pass) { return static_cast<double>(pass) * stroke.step_mm; };
  double path_mm = 0.0, poses = 0.0;
  for (std::size_t k = 1; k < stroke.through_mm.size(); ++k)
    path_mm += glm::distance(stroke.through_mm[k - 1], stroke.through_mm[k]);
  for (int pass = 0; pass < stroke.passes; ++pass) {
    const double travel_mm =
        glm::distance(script.start_mm, stroke.through_mm.front() + shift(pass)) +
        glm::distance(script.start_mm, stroke.through_mm.back() + shift(pass));
    const double moving_s =
        kSlowest * (path_mm / stroke.speed_mm_s + travel_mm / script.travel_mm_s);
    poses += script.rate_hz * (moving_s + stroke.hold_s);
  }
  return poses;
}

/// Refuses an endless script before the hand moves; play() counts exactly.
Result<StrokeScript> refuse_endless(const LocatedJson& document, StrokeScript script) {
  double poses = 0.0;
  for (const Stroke& stroke : script.strokes) poses += poses_of(script, stroke);
  if (poses <= static_cast<double>(kMaxPoses)) return script;
  return tl::make_unexpected(document.field_error(
      {"strokes"},
      "expected at most " + std::to_string(kMaxPoses) + " poses in a session, found about " +
          std::to_string(std::llround(poses)) + ", which would take " +
          std::to_string(std::llround(poses * sizeof(Pose) / 0x1p20)) + " MiB of memory"));
}

}  // namespace

Result<StrokeScript> parse_strokes(std::string_view text, std::string_view name) {
  constexpr std::size_t kMostValues = 1'000'000;
  return LocatedJson::from_json(text, name, kMostValues)
      .and_then([](const LocatedJson& document) {
        return ObjectReader::read(document, StrokeScript{}).and_then([&](StrokeScript script) {
          return refuse_endless(document, std::move(script));
        });
      })
      .map_error([&](Error error) {
        return kind_error(std::move(error), text, name, "a stroke script (.strokes.json)");
      });
}

}  // namespace clay::strokes
