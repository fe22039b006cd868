#include "app/cli/export_request.hpp"

#include "app/cli/export_words.hpp"
#include "app/cli/file_options.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/pot_input.hpp"
#include "app/cli/usage.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::cli {
namespace {

using solid::FileKind;
using solid::FileRequest;
using solid::MeshFormat;

Result<void> check_names(const ExportCommand& command, const Console& console) {
  std::vector<OutputFile> outputs;
  for (const std::string& path : command.outputs) outputs.push_back({path});
  outputs.push_back({command.request.report_path, {".html", ".json"}});
  if (command.request.certificates)
    for (const std::string& path : command.outputs) outputs.push_back({path + ".certificate.json"});
  return check_outputs(outputs, {command.pot, command.walls.process()}, console);
}

/// Options of the facets of a mesh.
constexpr std::array kFacetOptions{"--segments", "--max-triangles", "--verify"};
/// Options of the solid that do not change a copy of the pot.
constexpr std::array kSolidOptions{"--measure-left-out"};
/// Options of the section, by which a goal scales the pot.
constexpr std::array kSectionOptions{"--tolerance",  "--smooth", "--smooth-length",
                                     "--lip-fillet", "--drain",  "--pieces"};

/// Options of the figures of drying and firing.
constexpr std::array kFiringOptions{"--drying-shrinkage", "--water", "--ignition-loss"};

/// The options of the solid and the section that need a file other than a copy of the pot.
std::vector<FileOption> made_options(const ExportCommand& command) {
  std::vector<FileOption> options;
  for (const char* name : kFacetOptions) options.push_back(facet_option(command.given(name), name));
  const auto add = [&](const char* name) {
    options.push_back({command.given(name), name, "a mesh or its section", is_made});
  };
  std::ranges::for_each(kSolidOptions, add);
  if (!command.has_goal()) std::ranges::for_each(kSectionOptions, add);
  return options;
}

/// Refuses options that contradict each other. The export refuses them too, but names no option.
Result<void> check_pairs(const ExportCommand& command) {
  const solid::ExportOptions& options = command.request.options;
  const auto refuse = [](const std::string& text) { return failure(ErrorKind::bad_input, text); };
  for (const auto& [name, mm] : {std::pair("--smooth-length", options.smooth_length_mm),
                                 {"--lip-fillet", options.lip_fillet_mm}})
    if (mm.value_or(0.0) > 0.0 && command.smooth != "fair")
      return refuse(fmt::format("{}: expected --smooth fair, found {}", name, command.smooth));
  const double drying = options.clay.drying_shrinkage.value_or(0.0);
  if (drying > options.shrinkage)
    return refuse(
        fmt::format("--drying-shrinkage: expected at most --shrinkage, {:g}%, found {:g}%",
                    100.0 * options.shrinkage, 100.0 * drying));
  const bool finished = options.shrinkage > 0.0 || command.glaze_mm > 0.0;
  if (command.goal.fired && command.has_goal() && !finished)
    return tl::make_unexpected(
        no_effect_without("--fired", "--shrinkage above 0% or --glaze-allowance"));
  return {};
}

/// Refuses options that have no effect on any of the requested files.
Result<void> check_options(const ExportCommand& command) {
  const solid::ExportOptions& options = command.request.options;
  const bool unscaled = !command.has_goal();
  constexpr std::string_view kFinish = "--foot, --floor-fillet and --glaze-allowance";
  std::vector<FileOption> known{
      FileOption{command.precision_mm.has_value(), "--precision", "a pot", is_pot},
      FileOption{command.request.certificates, "--certificate", "a mesh", is_mesh},
      FileOption{unscaled && options.shrinkage > 0.0, "--shrinkage", "a mesh or its section",
                 is_made},
      FileOption{unscaled && options.finish.asked(), kFinish, "a mesh or its section", is_made},
      FileOption{command.walls.asked(), "--min-wall and --process", "a solid", is_solid},
      step_option(command.step.has_value(), "--step"),
      glb_option(command.glb.has_value(), "--glb"),
      colour_option(options.wall_map, "--wall-map"),
      glb_option(command.material.has_value(), "--material"),
      FileOption{command.ascii, "--ascii", "an .stl", is_format<MeshFormat::stl_ascii>},
      FileOption{options.normals, "--normals", "an .obj", is_format<MeshFormat::obj>}};
  std::ranges::copy(made_options(command), std::back_inserter(known));
  if (auto fit = check_file_options(known, command.request.files); !fit) return fit;
  for (const char* name : kFiringOptions)
    if (command.given(name) && options.shrinkage == 0.0)
      return tl::make_unexpected(no_effect_without(name, "--shrinkage"));
  return check_pairs(command);
}

/// Standard output gets a binary STL, as from `check -o -`.
Result<FileRequest> file_of(const std::string& path, bool ascii) {
  if (path == "-")
    return FileRequest{path, FileKind::mesh,
                       ascii ? MeshFormat::stl_ascii : MeshFormat::stl_binary};
  if (pot_encoding_of(path)) return FileRequest{path, FileKind::given};
  return solid::file_request(path)
      .map([&](FileRequest file) {
        if (ascii && file.kind == FileKind::mesh && file.format == MeshFormat::stl_binary)
          file.format = MeshFormat::stl_ascii;
        return file;
      })
      .map_error([&](const Error& error) {
        const bool picture = ends_ignoring_case(path, ".png") || ends_ignoring_case(path, ".gif");
        return Error{error.kind, error.message + ", .pot.json or .pot.cbor for the pot" +
                                     (picture ? "; claystack render makes pictures" : "")};
      });
}

/// Files that take long to send or to slice are announced before they are written.
std::function<void(const std::string&, std::size_t, std::uint64_t)> warning_of_size(
    const Console& console, solid::Smoothing smoothing) {
  return
      [&console, smoothing](const std::string& name, std::size_t triangles, std::uint64_t bytes) {
        constexpr std::uint64_t kLargeBytes = 50'000'000;
        if (bytes < kLargeBytes) return;
        const bool fair = smoothing == solid::Smoothing::fair;
        console.warn(
            fmt::format("{}: about {:.0f} MB, {} triangles; {} or --max-triangles makes it "
                        "smaller",
                        name, 1e-6 * static_cast<double>(bytes), triangles,
                        fair ? "a larger --tolerance" : "--smooth fair"));
      };
}

}  // namespace

Result<void> complete_request(ExportCommand& command, const Console& console) {
  if (auto loaded = command.walls.load(); !loaded) return loaded;
  for (const std::string& path : command.outputs) {
    auto file = file_of(path, command.ascii);
    if (!file) return tl::make_unexpected(file.error());
    command.request.files.push_back(std::move(*file));
  }
  if (auto names = check_names(command, console); !names) return names;
  solid::ExportOptions& options = command.request.options;
  options.smoothing = value_of(command.smooth, kSmoothings).value_or(options.smoothing);
  if (command.step)
    options.step_walls = value_of(*command.step, kStepWalls).value_or(options.step_walls);
  if (command.glb) options.glb = value_of(*command.glb, kGlbMeshes).value_or(options.glb);
  options.material = command.material.value_or(options.material);
  options.full_verification = command.verify == "full";
  options.finish.glaze_mm = command.glaze_mm * solid::enlargement(options.shrinkage);
  options.walls = command.walls.demand();
  options.name = name_of_file(command.pot);
  options.source = command.pot;
  options.announce_size = warning_of_size(console, options.smoothing);
  options.expect_memory = [](std::uint64_t bytes) { return expect_room("writing meshes", bytes); };
  return check_options(command);
}

}  // namespace clay::cli
