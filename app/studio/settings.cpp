#include "app/studio/settings.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/tool_names.hpp"
#include "core/json/plain_object.hpp"
#include "core/user_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace clay::studio {
namespace {

constexpr const char* kSchema = "claystack-studio-1";
constexpr std::size_t kMostBytes = 1 << 20, kMostValues = 1000;
constexpr const char* kNotSaved = "; settings will not be saved";

constexpr std::array<std::string_view, 2> kThemes = {"dark", "light"};
constexpr std::array kThemeValues = {Theme::dark, Theme::light};
constexpr std::array<std::string_view, 3> kUnits = {"mm", "cm", "in"};
constexpr std::array kUnitValues = {LengthUnit::mm, LengthUnit::cm, LengthUnit::in};
// A custom shape belongs to a scene; it is stored as the first of these shapes.
constexpr std::array<std::string_view, 3> kShapes = {"sphere", "ellipse", "rib"};
constexpr std::array kShapeValues = {Shape::sphere, Shape::ellipse, Shape::rib};
constexpr std::array kModeValues = {ToolMode::press,    ToolMode::trim,   ToolMode::pinch,
                                    ToolMode::smooth,   ToolMode::needle, ToolMode::wire,
                                    ToolMode::trim_foot};

constexpr auto kMaterialIds = [] {
  std::array<std::string_view, kMaterials.size()> ids;
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = kMaterials[i].id;
  return ids;
}();

template <class E, std::size_t N>
void choice(PlainFields& io, std::string_view name, E& value,
            const std::array<std::string_view, N>& names, const std::array<E, N>& values) {
  const auto* found = std::ranges::find(values, value);
  std::size_t index = found == values.end() ? 0 : static_cast<std::size_t>(found - values.begin());
  const std::size_t before = index;
  io.choice(name, index, names);
  if (index != before || found != values.end()) value = values[index];
}

/// The fields of the file in their order, for both reader and writer.
void describe(PlainFields& io, Settings& s) {
  choice(io, "theme", s.theme, kThemes, kThemeValues);
  io.flag("theme_chosen", s.theme_chosen);
  double scale = static_cast<double>(s.scale);
  io.number("scale", scale, kSmallestScale, kLargestScale);
  s.scale = static_cast<float>(scale);
  choice(io, "unit", s.unit, kUnits, kUnitValues);
  io.number("wheel_rpm", s.wheel_rpm, kSlowestRpm, kFastestRpm);
  choice(io, "shape", s.tool.shape, kShapes, kShapeValues);
  choice(io, "mode", s.tool.mode, kToolModeNames, kModeValues);
  const auto size = [&](const char* name, double& mm) {
    mm = std::clamp(mm, kSmallestToolMm, kLargestToolMm);  // the tool of a scene may be larger
    io.number(name, mm, kSmallestToolMm, kLargestToolMm);
  };
  size("sphere_radius_mm", s.tool.sphere.radius_mm);
  size("ellipse_half_height_mm", s.tool.ellipse.half_height_mm);
  size("ellipse_half_width_mm", s.tool.ellipse.half_width_mm);
  size("rib_height_mm", s.tool.rib.height_mm);
  size("rib_radius_mm", s.tool.rib.radius_mm);
  io.number("gap_mm", s.tool.gap_mm, kNarrowestGapMm, kWidestPinchMm);
  io.number("gap_share", s.tool.gap_share, 0.0, kMostGapShare);
  io.flag("wall_map", s.wall_map);
  io.flag("full_section", s.full_section);
  io.text("process", s.process);
  io.texts("processes", s.processes, kMostProcesses);
  io.flag("hints", s.hints);
  io.flags("open", s.open);
  io.text("folder", s.folder);
  io.texts("recent", s.recent, kMostRecent);
  io.number("pressing_mm_s", s.pressing_mm_s, kSlowestHandMmPerS, kFastestHandMmPerS);
  io.number("goal_holds_ml", s.goal.holds_ml, 0.0, kMostGoalMl);
  io.number("goal_height_mm", s.goal.height_mm, 0.0, kMostGoalMm);
  io.number("goal_diameter_mm", s.goal.diameter_mm, 0.0, kMostGoalMm);
  io.number("goal_shrinkage_percent", s.goal.shrinkage_percent, 0.0, kMostShrinkagePercent);
  choice(io, "material", s.material, kMaterialIds, kMaterials);
  io.flag("throwing_lines", s.throwing_lines);
  io.number("bite_mm", s.bite_mm, kSoftestBiteMm, kFirmestBiteMm);
}

std::string whole_name(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::path whole = std::filesystem::absolute(path, ignored);
  return whole.empty() ? path.string() : whole.lexically_normal().string();
}

/// Reading a pipe would block.
tl::unexpected<Error> not_regular(const std::filesystem::path& path) {
  return failure(ErrorKind::io,
                 fmt::format("{}: expected a regular file for the settings", path.string()));
}

void put_first(std::vector<std::string>& names, const std::string& name, std::size_t most) {
  std::erase(names, name);
  names.insert(names.begin(), name);
  if (names.size() > most) names.resize(most);
}

}  // namespace

double bite_at(double strength) noexcept {
  return kSoftestBiteMm * std::pow(kFirmestBiteMm / kSoftestBiteMm, std::clamp(strength, 0.0, 1.0));
}

void remember(Settings& settings, const std::filesystem::path& path) {
  put_first(settings.recent, whole_name(path), kMostRecent);
}

void forget_if_missing(Settings& settings, const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::status(path, ignored).type() == std::filesystem::file_type::not_found)
    std::erase(settings.recent, whole_name(path));
}

void remember_process(Settings& settings, const std::filesystem::path& path) {
  settings.process = whole_name(path);
  put_first(settings.processes, settings.process, kMostProcesses);
}

std::filesystem::path settings_path() {
  const std::filesystem::path folder = user_folder(UserFolder::config);
  return folder.empty() ? folder : folder / "studio.json";
}

Result<Settings> parse_settings(std::string_view text, std::string_view name) {
  Settings settings;
  return read_fields(text, name, kSchema, kMostValues,
                     [&](PlainFields& io) { describe(io, settings); })
      .map([&] { return settings; });
}

std::string write_settings(const Settings& settings) {
  Settings copy = settings;
  return write_fields(kSchema, [&](PlainFields& io) { describe(io, copy); });
}

LoadedSettings load_settings(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {};
  if (!std::filesystem::is_regular_file(path, ignored))
    return {{}, not_regular(path).value().message + kNotSaved, false};
  const auto text = read_file(path, kMostBytes);
  if (!text) return {{}, text.error().message + kNotSaved, false};
  auto settings = parse_settings(*text, path.string());
  if (settings) return {std::move(*settings), {}};
  const auto aside = std::filesystem::path(path.string() + ".broken");
  std::error_code failed;
  std::filesystem::rename(path, aside, failed);
  if (failed) return {{}, settings.error().message + kNotSaved, false};
  return {{}, fmt::format("{}; it was renamed to {}", settings.error().message, aside.string())};
}

namespace {

Result<void> write_to(const std::filesystem::path& path, std::string_view text) {
  if (path.empty()) return failure(ErrorKind::io, std::string("settings: ") + kNoHome);
  std::error_code failed;
  if (std::filesystem::exists(path, failed) && !std::filesystem::is_regular_file(path, failed))
    return not_regular(path);
  std::filesystem::create_directories(path.parent_path(), failed);
  if (failed)
    return failure(ErrorKind::io, fmt::format("{}: could not create: {}",
                                              path.parent_path().string(), failed.message()));
  return publish(path, text);
}

/// The settings that another window has saved; empty if they cannot be read.
std::optional<std::string> saved_by_others(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  const auto text = read_file(path, kMostBytes);
  const auto settings =
      text ? parse_settings(*text, path.string()) : tl::make_unexpected(text.error());
  return settings ? std::optional(write_settings(*settings)) : std::nullopt;
}

}  // namespace

SettingsFile::SettingsFile(std::filesystem::path path, const Settings& stored)
    : SettingsFile(std::move(path), stored, stored) {}

SettingsFile::SettingsFile(std::filesystem::path path, const Settings& stored,
                           const Settings& window)
    : path_(std::move(path)),
      stored_(write_settings(stored)),
      theme_(stored.theme, window.theme),
      scale_(stored.scale, window.scale) {}

Result<void> SettingsFile::update(const Settings& settings, double now_s) {
  if (path_.empty() || now_s < next_s_) return {};
  next_s_ = now_s + kSettingsDelayS;
  auto saved = save(settings);
  const bool reported = std::exchange(failed_, !saved);
  return saved || reported ? Result<void>() : saved;
}

Result<void> SettingsFile::save(const Settings& settings) {
  Settings wanted = settings;
  wanted.theme = theme_.to_store(settings.theme);
  wanted.scale = scale_.to_store(settings.scale);
  std::string text = write_settings(wanted);
  if (text == stored_) return {};
  const auto others = saved_by_others(path_);
  return write_to(path_, others ? merged_fields(stored_, text, *others) : text).map([&] {
    stored_ = std::move(text);
  });
}

}  // namespace clay::studio
