#include "app/studio/settings.hpp"

#include "claystack/core/atomic_file.hpp"
#include "core/json/located_json.hpp"
#include "core/user_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace clay::studio {
namespace {

constexpr const char* kSchema = "claystack-studio-1";
constexpr std::size_t kMostBytes = 1 << 20, kMostValues = 1000;

template <class E>
struct Named {
  const char* name;
  E value;
};
template <class E>
Named(const char*, E) -> Named<E>;  // Clang 14 deduces none for aggregates
constexpr std::array kThemes = {Named{"dark", Theme::dark}, Named{"light", Theme::light}};
constexpr std::array kUnits = {Named{"mm", LengthUnit::mm}, Named{"cm", LengthUnit::cm},
                               Named{"in", LengthUnit::in}};
constexpr std::array kShapes = {Named{"sphere", Shape::sphere}, Named{"ellipse", Shape::ellipse},
                                Named{"rib", Shape::rib}};
constexpr std::array kModes = {Named{"press", ToolMode::press}, Named{"trim", ToolMode::trim},
                               Named{"pinch", ToolMode::pinch}};

/// One field, both ways: reads it into its target, or says what was expected.
class Fields {
 public:
  explicit Fields(const Json& json) : json_(json) {}

  void number(const char* name, double low, double high, double& target) {
    const Json* field = take(name);
    if (field == nullptr) return;
    if (field->is_number() && field->get<double>() >= low && field->get<double>() <= high)
      target = field->get<double>();
    else
      refuse(name, fmt::format("a number from {:g} to {:g}", low, high), *field);
  }
  void flag(const char* name, bool& target) {
    const Json* field = take(name);
    if (field == nullptr) return;
    if (field->is_boolean())
      target = field->get<bool>();
    else
      refuse(name, "true or false", *field);
  }
  void text(const char* name, std::string& target) {
    const Json* field = take(name);
    if (field == nullptr) return;
    if (field->is_string())
      target = field->get<std::string>();
    else
      refuse(name, "a text", *field);
  }
  void texts(const char* name, std::size_t most, std::vector<std::string>& target) {
    const Json* field = take(name);
    if (field == nullptr) return;
    if (!field->is_array() || field->size() > most ||
        !std::ranges::all_of(*field, [](const Json& text) { return text.is_string(); }))
      return refuse(name, fmt::format("at most {} texts", most), *field);
    target = field->get<std::vector<std::string>>();
  }
  template <class E, std::size_t N>
  void one_of(const char* name, const std::array<Named<E>, N>& names, E& target) {
    const Json* field = take(name);
    if (field == nullptr) return;
    std::string expected = "one of";
    for (const auto& [word, value] : names) {
      if (field->is_string() && field->get<std::string>() == word) {
        target = value;
        return;
      }
      expected += fmt::format(" {}", word);
    }
    refuse(name, expected, *field);
  }
  void flags(const char* name, std::map<std::string, bool>& target) {
    const Json* field = take(name);
    if (field == nullptr) return;
    if (!field->is_object()) return refuse(name, "an object", *field);
    for (const auto& [key, value] : field->items()) {
      if (!value.is_boolean())
        return refuse(fmt::format("{}.{}", name, printable(key)), "true or false", value);
      target[key] = value.get<bool>();
    }
  }

  /// What was wrong first; a field that no one took is wrong too.
  [[nodiscard]] std::optional<std::string> problem() const {
    if (!problem_.empty()) return problem_;
    for (const auto& [key, value] : json_.items())
      if (std::ranges::find(taken_, key) == taken_.end())
        return fmt::format("{}: expected no such field", printable(key));
    return std::nullopt;
  }

 private:
  const Json* take(const char* name) {
    taken_.emplace_back(name);
    const auto found = json_.find(name);
    return found == json_.end() ? nullptr : &*found;
  }
  void refuse(std::string_view name, std::string_view expected, const Json& found) {
    if (problem_.empty())
      problem_ = fmt::format("{}: expected {}, found {}", name, expected, printable(found.dump()));
  }

  const Json& json_;
  std::vector<std::string> taken_;
  std::string problem_;
};

template <class E, std::size_t N>
const char* name_of(const std::array<Named<E>, N>& names, E value) {
  for (const auto& [name, named] : names)
    if (named == value) return name;
  return names.front().name;
}

void read_tool(Fields& fields, ToolChoice& tool) {
  fields.one_of("shape", kShapes, tool.shape);
  fields.one_of("mode", kModes, tool.mode);
  const auto size = [&](const char* name, double& mm) {
    fields.number(name, kSmallestToolMm, kLargestToolMm, mm);
  };
  size("sphere_radius_mm", tool.sphere.radius_mm);
  size("ellipse_half_height_mm", tool.ellipse.half_height_mm);
  size("ellipse_half_width_mm", tool.ellipse.half_width_mm);
  size("rib_height_mm", tool.rib.height_mm);
  size("rib_radius_mm", tool.rib.radius_mm);
  fields.number("gap_mm", kNarrowestGapMm, kWidestPinchMm, tool.gap_mm);
}

std::string whole_name(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::path whole = std::filesystem::absolute(path, ignored);
  return whole.empty() ? path.string() : whole.lexically_normal().string();
}

/// A pipe would be waited for.
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

void remember(Settings& settings, const std::filesystem::path& path) {
  const std::string name = whole_name(path);
  settings.folder = std::filesystem::path(name).parent_path().string();
  put_first(settings.recent, name, kMostRecent);
}

void remember_process(Settings& settings, const std::filesystem::path& path) {
  settings.process = whole_name(path);
  put_first(settings.processes, settings.process, kMostProcesses);
}

std::filesystem::path settings_path() {
  const std::filesystem::path folder = cli::user_folder(cli::UserFolder::config);
  return folder.empty() ? folder : folder / "studio.json";
}

Result<Settings> parse_settings(std::string_view text, std::string_view name) {
  const auto document = LocatedJson::from_json(text, name, kMostValues);
  if (!document) return tl::make_unexpected(document.error());
  const Json& json = document->root();
  const auto wrong = [&](std::string_view what) {
    return failure(ErrorKind::bad_input, fmt::format("{}: {}", name, what));
  };
  if (!json.is_object()) return wrong("expected a JSON object");
  if (json.value("schema", Json()) != kSchema)
    return wrong(fmt::format("schema: expected {}", kSchema));
  Settings settings;
  Fields fields(json);
  std::string schema;
  fields.text("schema", schema);
  fields.one_of("theme", kThemes, settings.theme);
  double scale = 1.0;
  fields.number("scale", kSmallestScale, kLargestScale, scale);
  settings.scale = static_cast<float>(scale);
  fields.one_of("unit", kUnits, settings.unit);
  fields.number("wheel_rpm", kSlowestRpm, kFastestRpm, settings.wheel_rpm);
  read_tool(fields, settings.tool);
  fields.flag("wall_map", settings.wall_map);
  fields.flag("full_section", settings.full_section);
  fields.text("process", settings.process);
  fields.texts("processes", kMostProcesses, settings.processes);
  fields.flag("hints", settings.hints);
  fields.flags("open", settings.open);
  fields.text("folder", settings.folder);
  fields.texts("recent", kMostRecent, settings.recent);
  fields.number("pressing_mm_s", kSlowestHandMmPerS, kFastestHandMmPerS, settings.pressing_mm_s);
  if (const auto problem = fields.problem()) return wrong(*problem);
  return settings;
}

std::string write_settings(const Settings& s) {
  const Json json = {{"schema", kSchema},
                     {"theme", name_of(kThemes, s.theme)},
                     {"scale", s.scale},
                     {"unit", name_of(kUnits, s.unit)},
                     {"wheel_rpm", s.wheel_rpm},
                     {"shape", name_of(kShapes, s.tool.shape)},
                     {"mode", name_of(kModes, s.tool.mode)},
                     {"sphere_radius_mm", s.tool.sphere.radius_mm},
                     {"ellipse_half_height_mm", s.tool.ellipse.half_height_mm},
                     {"ellipse_half_width_mm", s.tool.ellipse.half_width_mm},
                     {"rib_height_mm", s.tool.rib.height_mm},
                     {"rib_radius_mm", s.tool.rib.radius_mm},
                     {"gap_mm", s.tool.gap_mm},
                     {"wall_map", s.wall_map},
                     {"full_section", s.full_section},
                     {"process", s.process},
                     {"processes", s.processes},
                     {"hints", s.hints},
                     {"open", s.open},
                     {"folder", s.folder},
                     {"recent", s.recent},
                     {"pressing_mm_s", s.pressing_mm_s}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

LoadedSettings load_settings(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {};
  if (!std::filesystem::is_regular_file(path, ignored))
    return {{}, not_regular(path).value().message};
  const auto text = read_file(path, kMostBytes);
  if (!text) return {{}, text.error().message};
  auto settings = parse_settings(*text, path.string());
  if (settings) return {std::move(*settings), {}};
  const auto aside = std::filesystem::path(path.string() + ".broken");
  std::filesystem::rename(path, aside, ignored);
  return {{}, fmt::format("{}; it is kept as {}", settings.error().message, aside.string())};
}

Result<void> save_settings(const Settings& settings, const std::filesystem::path& path) {
  if (path.empty()) return failure(ErrorKind::io, std::string("settings: ") + cli::kNoHome);
  std::error_code failed;
  if (std::filesystem::exists(path, failed) && !std::filesystem::is_regular_file(path, failed))
    return not_regular(path);
  std::filesystem::create_directories(path.parent_path(), failed);
  if (failed)
    return failure(ErrorKind::io, fmt::format("{}: could not create: {}",
                                              path.parent_path().string(), failed.message()));
  return publish(path, write_settings(settings));
}

}  // namespace clay::studio
