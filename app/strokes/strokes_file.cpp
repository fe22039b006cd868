#include "app/strokes/strokes.hpp"
#include "core/json/located_json.hpp"
#include "core/text.hpp"

#include "claystack/engine/files.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace clay::strokes {
namespace {

/// The reason for refusing a script; does not leave parse_strokes.
struct Refusal {
  std::string message;
};

[[noreturn]] void refuse(const std::string& place, const std::string& expected, const Json& found) {
  const std::string what = found.is_object()  ? "an object"
                           : found.is_array() ? "an array of " + std::to_string(found.size())
                                              : printable(found.dump());
  throw Refusal{(place.empty() ? "" : place + ": ") + "expected " + expected + ", found " + what};
}

struct Range {
  double low, high;
};
constexpr Range kPositionMm{-1000.0, 1000.0}, kSpeedMmS{1.0, 10000.0}, kRateHz{200.0, 10000.0},
    kTremorMm{0.0, 10.0}, kHoldS{0.0, 60.0}, kGapMm{0.0, 1000.0}, kHeightMm{0.0, 1000.0};
struct IntegerRange {
  std::uint64_t low, high;
};
constexpr IntegerRange kPasses{1, 100}, kSeed{0, std::numeric_limits<std::uint64_t>::max()};

void read(const Json& json, const std::string& place, double& value, Range range) {
  if (!json.is_number() || json < range.low || json > range.high)
    refuse(place, "a number from " + Json(range.low).dump() + " to " + Json(range.high).dump(),
           json);
  value = json.get<double>();
}

template <std::integral Integer>
void read(const Json& json, const std::string& place, Integer& value, IntegerRange range) {
  // Only negative integers are not unsigned.
  if (!json.is_number_unsigned() || json < range.low || json > range.high)
    refuse(place,
           "an integer from " + std::to_string(range.low) + " to " + std::to_string(range.high),
           json);
  value = json.get<Integer>();
}

void read(const Json& json, const std::string& place, bool& value) {
  if (!json.is_boolean()) refuse(place, "true or false", json);
  value = json.get<bool>();
}

void read(const Json& json, const std::string& place, std::string& value) {
  constexpr std::size_t kMostBytes = 200;
  if (!json.is_string() || json.get_ref<const std::string&>().size() > kMostBytes)
    refuse(place, "a text of at most " + std::to_string(kMostBytes) + " bytes", json);
  value = json.get<std::string>();
}

void read(const Json& json, const std::string& place, glm::dvec2& value) {
  if (!json.is_array() || json.size() != 2) refuse(place, "an array of 2 numbers", json);
  for (int axis = 0; axis < 2; ++axis)
    read(json[static_cast<std::size_t>(axis)], place + "[" + std::to_string(axis) + "]",
         value[axis], kPositionMm);
}

void read(const Json& json, const std::string& place, StrokeKind& kind) {
  constexpr std::array kNames = {"path", "shape", "pull", "lip"};
  const auto found = std::ranges::find(kNames, json);
  if (found == kNames.end()) refuse(place, "path, shape, pull or lip", json);
  kind = static_cast<StrokeKind>(found - kNames.begin());
}

/// One gap for a whole stroke, or one per point.
void read(const Json& json, const std::string& place, std::vector<double>& gap_mm) {
  gap_mm.assign(json.is_array() ? json.size() : 1, 0.0);
  if (!json.is_array()) return read(json, place, gap_mm[0], kGapMm);
  for (std::size_t i = 0; i < gap_mm.size(); ++i)
    read(json[i], place + "[" + std::to_string(i) + "]", gap_mm[i], kGapMm);
}

void read(const Json& json, const std::string& place, Stroke& stroke);

/// At least `fewest` elements, each read by the overload for its type.
template <class T>
void read(const Json& json, const std::string& place, std::vector<T>& values, std::size_t fewest) {
  if (!json.is_array() || json.size() < fewest)
    refuse(place, "an array of " + std::to_string(fewest) + " at least", json);
  values.resize(json.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    read(json[i], place + "[" + std::to_string(i) + "]", values[i]);
}

/// The members of an object: all of `required`, and no others than those named by the calls.
class Members {
 public:
  Members(const Json& object, std::string place, const std::vector<const char*>& required)
      : object_(object), place_(std::move(place)) {
    if (!object.is_object()) refuse(place_, "an object", object);
    for (const char* name : required)
      if (!object.contains(name)) throw Refusal{at(name) + ": expected a field, found none"};
  }

  /// An absent member leaves its value unchanged.
  template <class... Arguments>
  Members& field(const char* name, Arguments&&... arguments) {
    known_.emplace_back(name);
    if (const auto found = object_.find(name); found != object_.end())
      read(*found, at(name), std::forward<Arguments>(arguments)...);
    return *this;
  }

  void refuse_others() const {
    for (const auto& [name, value] : object_.items())
      if (std::ranges::find(known_, name) == known_.end())
        throw Refusal{at(printable(name)) + ": unknown field"};
  }

 private:
  [[nodiscard]] std::string at(const std::string& name) const {
    return place_.empty() ? name : place_ + "." + name;
  }

  const Json& object_;
  std::string place_;
  std::vector<std::string> known_;
};

/// The fields that a stroke of a kind needs.
std::vector<const char*> required_of(const Json& json, const Stroke& stroke) {
  const char* outline = json.contains("outline_mm") ? "outline_mm" : "outline";
  switch (stroke.kind) {
    case StrokeKind::path:
      return {"through_mm"};
    case StrokeKind::shape:
      return {outline};
    case StrokeKind::pull:
      return {outline, "gap_mm", "from_mm"};
    case StrokeKind::lip:
      return {};
  }
  return {};
}

void check_path(const Json& json, const std::string& place, const Stroke& stroke) {
  // A spline has no direction between equal points.
  if (std::ranges::adjacent_find(stroke.through_mm) != stroke.through_mm.end())
    throw Refusal{place + ".through_mm: expected neighbours apart, found two equal"};
  if (const std::size_t gaps = stroke.gap_mm.size(), points = stroke.through_mm.size();
      json.contains("gap_mm") && json["gap_mm"].is_array() && gaps != points)
    throw Refusal{place + ".gap_mm: expected a number or an array of " + std::to_string(points) +
                  ", as many as through_mm, found an array of " + std::to_string(gaps)};
}

void check_outline(const Json& json, const std::string& place, const Stroke& stroke) {
  const auto& outline = stroke.outline;
  const double way = outline.back().y - outline.front().y;
  for (std::size_t k = 1; k < outline.size(); ++k)
    if (!((outline[k].y - outline[k - 1].y) * way > 0.0))
      throw Refusal{place + (stroke.outline_in_mm ? ".outline_mm" : ".outline") +
                    ": expected heights in strictly ascending or descending order, found " +
                    Json(outline[k - 1].y).dump() + " before " + Json(outline[k].y).dump()};
  if (stroke.kind == StrokeKind::pull && stroke.gap_mm.size() > 2)
    throw Refusal{place + ".gap_mm: expected a number or an array of 2, found an array of " +
                  std::to_string(json["gap_mm"].size())};
}

void read(const Json& json, const std::string& place, Stroke& stroke) {
  if (json.is_object() && json.contains("kind")) read(json["kind"], place + ".kind", stroke.kind);
  stroke.outline_in_mm = json.is_object() && json.contains("outline_mm");
  Members(json, place, required_of(json, stroke))
      .field("name", stroke.name)
      .field("hint", stroke.hint)
      .field("kind", stroke.kind)
      .field("through_mm", stroke.through_mm, std::size_t{2})
      .field(stroke.outline_in_mm ? "outline_mm" : "outline", stroke.outline, std::size_t{2})
      .field("inside", stroke.inside)
      .field("from_mm", stroke.from_mm, kHeightMm)
      .field("ease_mm", stroke.ease_mm, kHeightMm)
      .field("speed_mm_s", stroke.speed_mm_s, kSpeedMmS)
      .field("passes", stroke.passes, kPasses)
      .field("step_mm", stroke.step_mm)
      .field("hold_s", stroke.hold_s, kHoldS)
      .field("trim", stroke.trim)
      .field("gap_mm", stroke.gap_mm)
      .refuse_others();
  if (stroke.kind == StrokeKind::path) check_path(json, place, stroke);
  if (stroke.kind == StrokeKind::shape || stroke.kind == StrokeKind::pull)
    check_outline(json, place, stroke);
}

void read(const Json& json, StrokeScript& script) {
  Members(json, "", {"start_mm", "strokes"})
      .field("seed", script.seed, kSeed)
      .field("rate_hz", script.rate_hz, kRateHz)
      .field("tremor_mm", script.tremor_mm, kTremorMm)
      .field("travel_mm_s", script.travel_mm_s, kSpeedMmS)
      .field("start_mm", script.start_mm)
      .field("strokes", script.strokes, std::size_t{1})
      .refuse_others();
}

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

void refuse_endless(const StrokeScript& script) {
  double poses = 0.0;
  for (const Stroke& stroke : script.strokes) poses += poses_of(script, stroke);
  if (poses > static_cast<double>(kMaxPoses))
    throw Refusal{"strokes: expected at most " + std::to_string(kMaxPoses) +
                  " poses in a session, found about " + std::to_string(std::llround(poses)) +
                  ", which would take " +
                  std::to_string(std::llround(poses * sizeof(Pose) / 0x1p20)) + " MiB of memory"};
}

}  // namespace

Result<StrokeScript> parse_strokes(std::string_view text, std::string_view name) {
  const auto refused = [&](const std::string& message) {
    return tl::make_unexpected(
        kind_error({ErrorKind::bad_input, std::string(name) + ": " + message}, text, name,
                   "a stroke script (.strokes.json)"));
  };
  constexpr std::size_t kMostValues = 1'000'000;
  const auto document = LocatedJson::from_json(text, name, kMostValues);
  if (!document)
    return tl::make_unexpected(
        kind_error(document.error(), text, name, "a stroke script (.strokes.json)"));
  try {
    StrokeScript script;
    read(document->root(), script);
    refuse_endless(script);
    return script;
  } catch (const Refusal& refusal) {
    return refused(refusal.message);
  }
}

}  // namespace clay::strokes
