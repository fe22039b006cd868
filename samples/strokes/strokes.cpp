#include "strokes.hpp"

#include "claystack/engine/session_file.hpp"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>

namespace clay::samples {
namespace {

using Path = std::vector<glm::dvec2>;

/// Uniform in [-1, 1).
double noise(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
}

/// Band-limited noise of unit root mean square: a resonator at 9 Hz that white noise rings.
class Tremor {
 public:
  explicit Tremor(double rate_hz) {
    const double w = 2.0 * std::numbers::pi * 9.0 / rate_hz, damping = 3.0 / rate_hz;
    const double radius = 1.0 - 2.0 * std::numbers::pi * damping;
    const double cosine = 1.0 - w * w / 2.0 + w * w * w * w / 24.0;
    a1_ = 2.0 * radius * cosine;
    a2_ = -radius * radius;
    // Variance of a second-order recursion driven by variance 1/3.
    const double variance =
        (1.0 - a2_) / ((1.0 + a2_) * ((1.0 - a2_) * (1.0 - a2_) - a1_ * a1_)) / 3.0;
    gain_ = 1.0 / std::sqrt(variance);
  }
  double next(std::mt19937_64& random) {
    const double y = a1_ * y1_ + a2_ * y2_ + gain_ * noise(random);
    y2_ = y1_;
    return y1_ = y;
  }

 private:
  double a1_ = 0.0, a2_ = 0.0, gain_ = 1.0, y1_ = 0.0, y2_ = 0.0;
};

/// A centripetal Catmull-Rom spline by Barry and Goldman's pyramid (SIGGRAPH 1988): unlike the
/// uniform one it does not swing out where long and short spans meet.
Path spline(const Path& through) {
  constexpr int kPieces = 32;
  const auto lerp = [](glm::dvec2 a, double ta, glm::dvec2 b, double tb, double t) {
    return (a * (tb - t) + b * (t - ta)) / (tb - ta);
  };
  Path path{through.front()};
  for (std::size_t k = 0; k + 1 < through.size(); ++k) {
    // Beyond its ends the path runs on as it begins and ends.
    const glm::dvec2 p1 = through[k], p2 = through[k + 1];
    const glm::dvec2 p0 = k > 0 ? through[k - 1] : 2.0 * p1 - p2;
    const glm::dvec2 p3 = k + 2 < through.size() ? through[k + 2] : 2.0 * p2 - p1;
    const double t1 = std::sqrt(glm::distance(p0, p1));
    const double t2 = t1 + std::sqrt(glm::distance(p1, p2));
    const double t3 = t2 + std::sqrt(glm::distance(p2, p3));
    for (int piece = 1; piece <= kPieces; ++piece) {
      const double t = t1 + (t2 - t1) * piece / kPieces;
      const glm::dvec2 a1 = lerp(p0, 0.0, p1, t1, t), a2 = lerp(p1, t1, p2, t2, t);
      const glm::dvec2 a3 = lerp(p2, t2, p3, t3, t);
      path.push_back(lerp(lerp(a1, 0.0, a2, t2, t), t1, lerp(a2, t1, a3, t3, t), t2, t));
    }
  }
  return path;
}

/// The hand: where it is, and what it has played so far.
class Hand {
 public:
  explicit Hand(const StrokeScript& script)
      : script_(script),
        random_(script.seed),
        at_(script.start_mm),
        radial_(script.rate_hz),
        vertical_(script.rate_hz),
        sideways_(script.rate_hz) {}

  /// Along a path in minimum-jerk time (Flash and Hogan, J. Neurosci. 5(7) 1985), whose
  /// greatest speed is 15/8 of the mean.
  void move(const Path& path, double speed_mm_s, bool trim) {
    std::vector<double> length{0.0};
    for (std::size_t k = 1; k < path.size(); ++k)
      length.push_back(length.back() + glm::distance(path[k - 1], path[k]));
    // No two strokes of a hand are equally fast.
    const double speed = speed_mm_s * (0.95 + 0.05 * noise(random_));
    const auto ticks =
        static_cast<std::int64_t>(length.back() * 1.875 / speed * script_.rate_hz) + 1;
    std::size_t k = 0;
    for (std::int64_t n = 1; n <= ticks; ++n) {
      const double u = static_cast<double>(n) / static_cast<double>(ticks);
      const double s = length.back() * u * u * u * (10.0 + u * (6.0 * u - 15.0));
      while (k + 2 < path.size() && length[k + 1] < s) ++k;
      const double piece = length[k + 1] - length[k];
      emit(piece > 0.0 ? path[k] + (path[k + 1] - path[k]) * ((s - length[k]) / piece) : path[k],
           trim);
    }
  }
  void hold(double seconds, bool trim) {
    const auto ticks = static_cast<int>(seconds * script_.rate_hz);
    for (int n = 0; n < ticks; ++n) emit(at_, trim);
  }
  [[nodiscard]] glm::dvec2 at() const { return at_; }
  std::vector<Pose> take() { return std::move(poses_); }

 private:
  void emit(glm::dvec2 at, bool trim) {
    at_ = at;
    // One after another: compilers differ in the order in which they evaluate arguments.
    glm::dvec3 hip(at, 0.0);
    hip.x += script_.tremor_mm * radial_.next(random_);
    hip.y += script_.tremor_mm * vertical_.next(random_);
    hip.z += script_.tremor_mm * sideways_.next(random_);
    const auto time =
        static_cast<std::int64_t>(static_cast<double>(poses_.size()) * 1e6 / script_.rate_hz);
    poses_.push_back(quantized({time, hip, trim}));
  }

  const StrokeScript& script_;
  std::mt19937_64 random_;
  glm::dvec2 at_;
  Tremor radial_, vertical_, sideways_;
  std::vector<Pose> poses_;
};

using Json = nlohmann::json;

/// Why a script is refused; never leaves parse_strokes.
struct Refusal {
  std::string message;
};

[[noreturn]] void refuse(const std::string& place, const std::string& expected, const Json& found) {
  const std::string what = found.is_object()  ? "an object"
                           : found.is_array() ? "an array of " + std::to_string(found.size())
                                              : found.dump();
  throw Refusal{(place.empty() ? "" : place + ": ") + "expected " + expected + ", found " + what};
}

struct Range {
  double low, high;
};
constexpr Range kPositionMm{-1000.0, 1000.0}, kSpeedMmS{1.0, 10000.0}, kRateHz{200.0, 10000.0},
    kTremorMm{0.0, 10.0}, kHoldS{0.0, 60.0};
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
  // A negative integer is the only one that is not unsigned.
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

void read(const Json& json, const std::string& place, glm::dvec2& value) {
  if (!json.is_array() || json.size() != 2) refuse(place, "an array of 2 numbers", json);
  for (int axis = 0; axis < 2; ++axis)
    read(json[static_cast<std::size_t>(axis)], place + "[" + std::to_string(axis) + "]",
         value[axis], kPositionMm);
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

/// The members of an object: all of `required`, and none that the calls have not named.
class Members {
 public:
  Members(const Json& object, std::string place, std::initializer_list<const char*> required)
      : object_(object), place_(std::move(place)) {
    if (!object.is_object()) refuse(place_, "an object", object);
    for (const char* name : required)
      if (!object.contains(name)) throw Refusal{at(name) + ": expected a field, found none"};
  }

  /// A member that is absent leaves its value as it was.
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
        throw Refusal{at(name) + ": unknown field"};
  }

 private:
  [[nodiscard]] std::string at(const std::string& name) const {
    return place_.empty() ? name : place_ + "." + name;
  }

  const Json& object_;
  std::string place_;
  std::vector<std::string> known_;
};

void read(const Json& json, const std::string& place, Stroke& stroke) {
  Members(json, place, {"through_mm"})
      .field("through_mm", stroke.through_mm, std::size_t{2})
      .field("speed_mm_s", stroke.speed_mm_s, kSpeedMmS)
      .field("passes", stroke.passes, kPasses)
      .field("step_mm", stroke.step_mm)
      .field("hold_s", stroke.hold_s, kHoldS)
      .field("trim", stroke.trim)
      .refuse_others();
  // A spline has no direction where it stands still.
  if (std::ranges::adjacent_find(stroke.through_mm) != stroke.through_mm.end())
    throw Refusal{place + ".through_mm: expected neighbours apart, found two equal"};
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

}  // namespace

Result<StrokeScript> parse_strokes(std::string_view text, std::string_view name) {
  const auto refused = [&](const std::string& message) {
    return failure(ErrorKind::bad_input, std::string(name) + ": " + message);
  };
  try {
    StrokeScript script;
    read(Json::parse(text), script);
    return script;
  } catch (const Refusal& refusal) {
    return refused(refusal.message);
  } catch (const Json::exception& error) {
    return refused(error.what());
  }
}

std::vector<Pose> play(const StrokeScript& script) {
  Hand hand(script);
  for (const Stroke& stroke : script.strokes) {
    for (int pass = 0; pass < stroke.passes; ++pass) {
      Path through = stroke.through_mm;
      for (glm::dvec2& point : through) point += static_cast<double>(pass) * stroke.step_mm;
      if (hand.at() != script.start_mm)
        hand.move({hand.at(), script.start_mm}, script.travel_mm_s, false);
      hand.move({script.start_mm, through.front()}, script.travel_mm_s, false);
      hand.move(spline(through), stroke.speed_mm_s, stroke.trim);
      hand.hold(stroke.hold_s, stroke.trim);
    }
  }
  return hand.take();
}

}  // namespace clay::samples
