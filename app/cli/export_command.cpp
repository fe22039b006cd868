#include "app/cli/commands.hpp"
#include "app/cli/export_json.hpp"
#include "app/cli/export_request.hpp"
#include "app/cli/export_text.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/packed_pot.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/pot_input.hpp"
#include "app/cli/remedies.hpp"
#include "app/cli/report_file.hpp"

#include "claystack/engine/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::cli {
namespace {

using solid::FileRequest;

/// Writes the copies of the pot at the requested precision.
Result<std::vector<PotCopy>> add_copies(const Pot& pot, ExportCommand& command) {
  const auto copied = command.precision_mm ? rounded_pot(pot, *command.precision_mm) : pot;
  if (!copied)
    return failure(copied.error().kind,
                   "--precision with " + command.pot + ": " + copied.error().message);
  std::vector<PotCopy> copies;
  for (FileRequest& file : command.request.files) {
    const auto encoding = pot_encoding_of(file.path);
    if (!encoding) continue;
    if (auto room = expect_room_to_write(copied->stack.size(), *encoding, file.path); !room)
      return tl::make_unexpected(room.error());
    file.bytes = write_pot(*copied, *encoding);
    copies.push_back(describe_copy(*copied, *encoding, file.bytes.size()));
  }
  return copies;
}

/// The library names no options: "goal: expected ..." becomes "--holds: expected ...", with all
/// options that are given.
Error by_goal_options(Error error, const ExportCommand& command) {
  constexpr std::string_view kGoal = "goal:";
  if (!error.message.starts_with(kGoal)) return error;
  std::string options;
  for (const char* option : {"--holds", "--weighs", "--height", "--diameter"})
    if (command.given(option)) options += std::string(options.empty() ? "" : ", ") + option;
  error.message.replace(0, kGoal.size() - 1, options);
  return error;
}

/// Scales the pot to its goal, and prints the factors.
Result<Pot> pot_at_goal(const Pot& pot, ExportCommand& command, const Console& console) {
  if (!command.has_goal()) {
    if (!command.goal.fired) return pot;
    return failure(ErrorKind::bad_input,
                   "--fired: expected --holds, --weighs, --height or --diameter, found none");
  }
  command.goal.to_fill_line = command.given("--fill-line");
  return solid::scaled_to(pot, command.goal, command.request.options)
      .map([&](solid::GoalReport reached) {
        console.print(fmt::format("scaled by {:.4f} across and {:.4f} up to meet the goal: {}",
                                  reached.met.radius_factor, reached.met.height_factor,
                                  solid::text_of(reached.met)));
        command.request.options.met_goal = reached.met;
        return std::move(reached.pot);
      })
      .map_error([&](Error error) { return by_goal_options(std::move(error), command); });
}

/// `--smooth-length tool` needs a pot that remembers its tool; the default does not.
Result<void> check_tool_length(const Pot& pot, const ExportCommand& command) {
  if (!command.length_of_tool) return {};
  const auto refuse = [](const std::string& why) {
    return failure(ErrorKind::bad_input, "--smooth-length tool: expected " + why);
  };
  if (command.smooth != "fair") return refuse("--smooth fair, found " + command.smooth);
  if (pot.collapse) return refuse("a standing pot, found a collapsed one");
  if (solid::tool_length_mm(pot) == 0.0)
    return refuse("a pot that remembers its tool, found none in it; give the length in mm");
  return {};
}

/// Refuses options of the solid and its section on which the drawing of a fallen pot does not
/// depend.
Result<void> check_fallen(const Pot& pot, const ExportCommand& command) {
  const bool mesh = std::ranges::any_of(command.request.files, [](const FileRequest& file) {
    return file.kind == solid::FileKind::mesh;
  });
  if (!pot.collapse || mesh) return {};
  for (const char* option : {"--tolerance", "--smooth", "--pieces", "--measure-left-out"})
    if (command.given(option))
      return failure(
          ErrorKind::bad_input,
          fmt::format("{}: expected a mesh among the files to write, because the drawing "
                      "of a fallen pot does not depend on it, found none",
                      option));
  return {};
}

/// The exit status: done, or unsound if a problem fails: wall, size or cavity.
Result<int> export_pot(ExportCommand& command, Console console) {
  if (command.outputs.empty())
    return failure(ErrorKind::bad_input, "expected a file to write, such as pot.3mf, found none");
  const bool streams = std::ranges::count(command.outputs, "-") > 0;
  if (streams && command.request.certificates)
    return failure(ErrorKind::bad_input,
                   "-: expected no --certificate with it, because a certificate is a file beside "
                   "its mesh");
  console.quiet = console.quiet || streams;
  Progress progress(console, "exporting", 0);
  progress.stage("reading");
  const auto given = read_pot(command.pot, console);
  if (!given) return tl::make_unexpected(given.error());
  if (auto complete = complete_request(command, console); !complete)
    return tl::make_unexpected(complete.error());
  if (auto length = check_tool_length(*given, command); !length)
    return tl::make_unexpected(length.error());
  if (auto fallen = check_fallen(*given, command); !fallen)
    return tl::make_unexpected(fallen.error());
  progress.stage("scaling and copying");
  const auto pot = pot_at_goal(*given, command, console);
  if (!pot) return tl::make_unexpected(pot.error());
  const auto copies = add_copies(*pot, command);
  if (!copies) return tl::make_unexpected(copies.error());
  Thumbnail thumbnail;
  pack_pot(*pot, command.request, thumbnail);
  set_report(*pot, command.request, *copies);
  if (console.verbose && !pot->collapse)
    command.request.options.wall_spacing_mm = solid::kWallTableSpacingMm;
  const auto report = solid::export_files(*pot, command.request,
                                          [&](std::string_view stage) { progress.stage(stage); });
  if (!report) return failure(report.error().kind, with_options(report.error().message));
  if (console.json) print_json(export_json(*report, *copies, command.request.options.met_goal));
  print_export(console, *report, *copies);
  const bool fails = print_problems(console, *report);
  print_summary(console, *report);
  return fails ? kUnsound : kDone;
}

}  // namespace

void add_export_command(CLI::App& app, Console& console, int& exit) {
  auto command = std::make_shared<ExportCommand>();
  CLI::App* sub = app.add_subcommand(
      "export", "Write a pot as a printable solid, with a proof that it is sound");
  add_export_options(*sub, *command);
  sub->footer(
      "\nExamples:\n"
      "  claystack throw samples/bowl.scene.json -o bowl.pot.json\n"
      "  claystack export bowl.pot.json bowl.stl bowl.obj bowl.drc bowl.svg\n"
      "  claystack export bowl.pot.json bowl.step --process stoneware\n"
      "  claystack export bowl.pot.json bowl.3mf --holds 350ml --fired --shrinkage 12%\n"
      "  claystack export bowl.pot.json bowl.pdf bowl.dxf --shrinkage 12%\n"
      "  claystack export bowl.pot.json bowl.3mf --foot 60x6x4 --floor-fillet 5mm\n"
      "  claystack export bowl.pot.json bowl.stl --tolerance 0.005 --process stoneware\n"
      "  claystack export bowl.pot.json bowl.stl --process porcelain --shrinkage 12%\n"
      "  claystack export bowl.pot.json bowl.drc --certificate --report bowl.report.json\n"
      "  claystack export bowl.pot.json bowl.pot.cbor --precision 0.001");
  sub->callback([command, &console, &exit] {
    std::ranges::move(command->named_outputs, std::back_inserter(command->outputs));
    const auto done = export_pot(*command, console);
    // All files or none: with status 1, this key distinguishes a refusal from a limit that fails.
    exit = done ? *done : report(done.error(), {{"written", Json::array()}});
  });
}

}  // namespace clay::cli
