#include "app/web/job_message.hpp"

#include "claystack/engine/files.hpp"

#include <nlohmann/json.hpp>

#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>

namespace clay::web {
namespace {

using nlohmann::json;

// The members of each class, for both directions. The binding names all of them: if a member is
// missing here, the program does not compile.
template <class Of, class As>
concept Like = std::is_same_v<std::remove_const_t<Of>, As>;

auto members(Like<glm::dvec2> auto& of) { return std::tie(of.x, of.y); }
auto members(Like<Error> auto& of) {
  auto& [kind, message] = of;
  return std::tie(kind, message);
}
auto members(Like<solid::ProfilePoint> auto& of) {
  auto& [rho, y] = of;
  return std::tie(rho, y);
}
auto members(Like<solid::Problem> auto& of) {
  auto& [text, at, fails, kind, figure] = of;
  return std::tie(text, at, fails, kind, figure);
}
auto members(Like<solid::WallLimit> auto& of) {
  auto& [up_to_size_sum_mm, min_wall_mm, source, process] = of;
  return std::tie(up_to_size_sum_mm, min_wall_mm, source, process);
}
auto members(Like<solid::ClayFigures> auto& of) {
  auto& [density_g_cm3, shrinkage, drying_shrinkage, water, ignition_loss] = of;
  return std::tie(density_g_cm3, shrinkage, drying_shrinkage, water, ignition_loss);
}
auto members(Like<solid::PotSize> auto& of) {
  auto& [diameter_mm, height_mm, foot_diameter_mm] = of;
  return std::tie(diameter_mm, height_mm, foot_diameter_mm);
}
auto members(Like<solid::PotState> auto& of) {
  auto& [size, weight_g, capacity_ml, to_line_ml, inside_cm2, outside_cm2] = of;
  return std::tie(size, weight_g, capacity_ml, to_line_ml, inside_cm2, outside_cm2);
}
auto members(Like<solid::Balance> auto& of) {
  auto& [centre_mm, tipping_deg] = of;
  return std::tie(centre_mm, tipping_deg);
}
auto members(Like<solid::MakerNumbers> auto& of) {
  auto& [clay, fill_line_mm, thrown, dry, fired, glazed, empty, full, no_capacity] = of;
  return std::tie(clay, fill_line_mm, thrown, dry, fired, glazed, empty, full, no_capacity);
}
auto members(Like<render::Row> auto& of) {
  auto& [outer_mm, inner_mm] = of;
  return std::tie(outer_mm, inner_mm);
}
auto members(Like<render::RowWall> auto& of) {
  auto& [outer_mm, inner_mm] = of;
  return std::tie(outer_mm, inner_mm);
}
auto members(Like<render::FallenView> auto& of) {
  auto& [first_row, place] = of;
  return std::tie(first_row, place);
}
auto members(Like<render::PotView> auto& of) {
  auto& [rows, height_mm, wall_mm, fallen] = of;
  return std::tie(rows, height_mm, wall_mm, fallen);
}
auto members(Like<studio::Target> auto& of) {
  auto& [name, view] = of;
  return std::tie(name, view);
}
auto members(Like<studio::OffTarget> auto& of) {
  auto& [mm, radius_mm, height_mm, rows_mm] = of;
  return std::tie(mm, radius_mm, height_mm, rows_mm);
}
auto members(Like<studio::Subject> auto& of) {
  auto& [pot, outline, density_g_cm3, crown_mm] = of;
  return std::tie(pot, outline, density_g_cm3, crown_mm);
}
auto members(Like<studio::PotQuestion> auto& of) {
  auto& [subject, process, tolerance_mm, target, shrinkage] = of;
  return std::tie(subject, process, tolerance_mm, target, shrinkage);
}
auto members(Like<studio::PotRemark> auto& of) {
  auto& [from_mm, to_mm, text] = of;
  return std::tie(from_mm, to_mm, text);
}
auto members(Like<studio::PotForm> auto& of) {
  auto& [hollow, floorless, parts, parting_mm, floor_mm, throttle_mm] = of;
  return std::tie(hollow, floorless, parts, parting_mm, floor_mm, throttle_mm);
}
auto members(Like<studio::PotCheck> auto& of) {
  auto& [live, stopped, proved, why_not, fault_mm, remarks, fallen, triangles, tolerance_mm,
         counted_mm3, proved_mm3, volume_error_relative, least_wall_mm, form, thinnest_mm,
         thinnest_from, thinnest_to, thinnest_in_floor, limit, problems, walls, height_mm, maker,
         off, seconds] = of;
  return std::tie(live, stopped, proved, why_not, fault_mm, remarks, fallen, triangles,
                  tolerance_mm, counted_mm3, proved_mm3, volume_error_relative, least_wall_mm, form,
                  thinnest_mm, thinnest_from, thinnest_to, thinnest_in_floor, limit, problems,
                  walls, height_mm, maker, off, seconds);
}
auto members(Like<studio::ExportChoices> auto& of) {
  auto& [meshes, step, section, dxf, pdf, report, pot, folder, name, tolerance_mm, smoothing,
         smooth_length_mm, process, min_wall_mm, shrinkage_percent, material, foot_width_mm,
         foot_depth_mm, floor_fillet_mm, lip_fillet_mm, glaze_mm, drain_mm, size, holds_ml,
         weighs_g, height_mm, diameter_mm] = of;
  return std::tie(meshes, step, section, dxf, pdf, report, pot, folder, name, tolerance_mm,
                  smoothing, smooth_length_mm, process, min_wall_mm, shrinkage_percent, material,
                  foot_width_mm, foot_depth_mm, floor_fillet_mm, lip_fillet_mm, glaze_mm, drain_mm,
                  size, holds_ml, weighs_g, height_mm, diameter_mm);
}
auto members(Like<ExportQuestion> auto& of) {
  auto& [kind, choices, pot] = of;
  return std::tie(kind, choices, pot);
}
auto members(Like<studio::Mark> auto& of) {
  auto& [place_mm, text] = of;
  return std::tie(place_mm, text);
}
auto members(Like<studio::ExportFigures::Mesh> auto& of) {
  auto& [format, bytes] = of;
  return std::tie(format, bytes);
}
auto members(Like<studio::ExportFigures> auto& of) {
  auto& [has_solid, triangles, meshes, diameter_mm, height_mm, shrinkage, capacity_ml, weight_g,
         fallen, thinnest_mm, thinnest_at_mm, thinnest_in_floor, closed_cavity, faired_mm, moved_mm,
         moved_at_mm, problems, failed, marks] = of;
  return std::tie(has_solid, triangles, meshes, diameter_mm, height_mm, shrinkage, capacity_ml,
                  weight_g, fallen, thinnest_mm, thinnest_at_mm, thinnest_in_floor, closed_cavity,
                  faired_mm, moved_mm, moved_at_mm, problems, failed, marks);
}

auto members(Like<strokes::Stroke> auto& of) {
  auto& [name, hint, kind, through_mm, outline, outline_in_mm, inside, speed_mm_s, passes, step_mm,
         hold_s, trim, gap_mm, from_mm, ease_mm] = of;
  return std::tie(name, hint, kind, through_mm, outline, outline_in_mm, inside, speed_mm_s, passes,
                  step_mm, hold_s, trim, gap_mm, from_mm, ease_mm);
}
auto members(Like<strokes::StrokeScript> auto& of) {
  auto& [seed, rate_hz, tremor_mm, travel_mm_s, start_mm, all] = of;
  return std::tie(seed, rate_hz, tremor_mm, travel_mm_s, start_mm, all);
}
auto members(Like<studio::LessonQuestion> auto& of) {
  auto& [script, scene, pot, node, step, passes_left] = of;
  return std::tie(script, scene, pot, node, step, passes_left);
}
auto members(Like<studio::PathPoint> auto& of) {
  auto& [at_mm, time_s] = of;
  return std::tie(at_mm, time_s);
}
auto members(Like<studio::LessonPlan> auto& of) {
  auto& [node, step, mode, gap_mm, path, after, left_mm2, problem] = of;
  return std::tie(node, step, mode, gap_mm, path, after, left_mm2, problem);
}

// A value as CBOR: an optional or a pointer may be null, a class is the array of its members.
template <class Value>
struct Cbor {
  static json of(const Value& value) {
    if constexpr (std::is_enum_v<Value>)
      return static_cast<int>(value);
    else if constexpr (std::is_constructible_v<json, const Value&>)
      return value;
    else
      return std::apply(
          [](const auto&... each) {
            return json::array({Cbor<std::remove_cvref_t<decltype(each)>>::of(each)...});
          },
          members(value));
  }
  static void read(const json& from, Value& into) {
    if constexpr (std::is_enum_v<Value>)
      into = static_cast<Value>(from.get<int>());
    else if constexpr (std::is_constructible_v<json, const Value&>)
      from.get_to(into);
    else {
      std::size_t next = 0;
      std::apply(
          [&](auto&... each) {
            (Cbor<std::remove_cvref_t<decltype(each)>>::read(from.at(next++), each), ...);
          },
          members(into));
    }
  }
};
/// The bytes of a file.
struct Bytes {
  static json of(const std::string& bytes) {
    return json::binary(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
  }
  static std::string in(const json& from) {
    const auto& bytes = from.get_binary();
    return {bytes.begin(), bytes.end()};
  }
};
template <>
struct Cbor<Pot> {
  static json of(const Pot& pot) { return Bytes::of(write_pot(pot, PotEncoding::cbor)); }
  static void read(const json& from, Pot& into) {
    into = parse_pot(Bytes::in(from), "the pot of the window").value();
  }
};
template <>
struct Cbor<SceneSpec> {
  static json of(const SceneSpec& scene) { return write_scene(scene); }
  static void read(const json& from, SceneSpec& into) {
    into = parse_scene(from.get<std::string>(), "the scene of the window").value();
  }
};
template <>
struct Cbor<glm::dmat4> {
  static json of(const glm::dmat4& place) { return std::vector(&place[0][0], &place[0][0] + 16); }
  static void read(const json& from, glm::dmat4& into) {
    for (std::size_t i = 0; i < 16; ++i) from.at(i).get_to((&into[0][0])[i]);
  }
};
template <class Value>
struct Cbor<std::vector<Value>> {
  static json of(const std::vector<Value>& values) {
    json made = json::array();
    for (const Value& value : values) made.push_back(Cbor<Value>::of(value));
    return made;
  }
  static void read(const json& from, std::vector<Value>& into) {
    into.assign(from.size(), Value{});
    for (std::size_t i = 0; i < into.size(); ++i) Cbor<Value>::read(from[i], into[i]);
  }
};
template <class Value>
struct Cbor<std::optional<Value>> {
  static json of(const std::optional<Value>& value) {
    return value ? Cbor<Value>::of(*value) : json();
  }
  static void read(const json& from, std::optional<Value>& into) {
    into.reset();
    if (!from.is_null()) Cbor<Value>::read(from, into.emplace());
  }
};
template <class Value>
struct Cbor<std::shared_ptr<const Value>> {
  static json of(const std::shared_ptr<const Value>& value) {
    return value ? Cbor<Value>::of(*value) : json();
  }
  static void read(const json& from, std::shared_ptr<const Value>& into) {
    into.reset();
    if (from.is_null()) return;
    auto made = std::make_shared<Value>();
    Cbor<Value>::read(from, *made);
    into = std::move(made);
  }
};

/// A message is an object with one member, its name.
template <class Value>
std::string message(const char* name, const Value& value) {
  std::string bytes;
  json::to_cbor(json{{name, Cbor<Value>::of(value)}}, bytes);
  return bytes;
}
json value_in(std::string_view message) { return json::from_cbor(message.begin(), message.end()); }
template <class Value>
std::optional<Value> member(const json& message, const char* name) {
  if (!message.contains(name)) return std::nullopt;
  Value value;
  Cbor<Value>::read(message.at(name), value);
  return value;
}

}  // namespace

std::string message_of(const studio::PotQuestion& question) { return message("check", question); }

std::string message_of(const ExportQuestion& question) { return message("export", question); }

std::string message_of(const studio::LessonQuestion& question) { return message("plan", question); }

Question question_in(std::string_view message) {
  const json value = value_in(message);
  return {member<studio::PotQuestion>(value, "check"), member<ExportQuestion>(value, "export"),
          member<studio::LessonQuestion>(value, "plan")};
}

std::string message_of(const studio::PotCheck& check) { return message("checked", check); }

std::optional<studio::PotCheck> check_in(std::string_view message) {
  return member<studio::PotCheck>(value_in(message), "checked");
}

std::string message_of(const studio::LessonPlan& plan) { return message("planned", plan); }

std::optional<studio::LessonPlan> plan_in(std::string_view message) {
  return member<studio::LessonPlan>(value_in(message), "planned");
}

std::string message_of(const ExportAnswer& answer) {
  return answer ? message("exported", *answer) : message("error", answer.error());
}

std::optional<ExportAnswer> export_in(std::string_view message) {
  const json value = value_in(message);
  if (auto done = member<studio::ExportFigures>(value, "exported")) return std::move(*done);
  if (auto error = member<Error>(value, "error")) return tl::make_unexpected(std::move(*error));
  return std::nullopt;
}

}  // namespace clay::web
