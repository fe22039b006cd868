#include "app/cli/wall_options.hpp"

#include "app/cli/quantity.hpp"
#include "claystack/export/option_ranges.hpp"

#include <CLI/CLI.hpp>

#include <utility>

namespace clay::cli {

WallOptions::WallOptions(solid::WallDemand demand)
    : min_wall_mm_(demand.min_wall_mm),
      process_(demand.process ? demand.process->name : std::string()),
      demand_(std::move(demand)) {}

void WallOptions::add_to(CLI::App& command) {
  add_length(command, "--min-wall", min_wall_mm_,
             "Minimum wall [mm]; with --process the larger of both applies (default: no limit)",
             solid::kMinWallRange.lowest, solid::kMinWallRange.highest);
  command
      .add_option(
          "--process", process_,
          "Process whose limits apply to the minimum wall, the overhang and the size: fdm, sla, "
          "earthenware, stoneware, porcelain, or a .json file with custom limits (default: none)")
      ->type_name("PROCESS");
}

Result<void> WallOptions::load() {
  demand_ = {min_wall_mm_, std::nullopt, "--min-wall"};
  if (process_.empty()) return {};
  return solid::read_process(process_)
      .map([&](solid::ProcessLimits process) { demand_.process = std::move(process); })
      .map_error([](Error error) {
        if (error.message.starts_with("process:")) error.message.insert(0, "--");
        return error;
      });
}

}  // namespace clay::cli
