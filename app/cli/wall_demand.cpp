#include "app/cli/wall_demand.hpp"

#include "app/cli/console.hpp"
#include "claystack/core/atomic_file.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace clay::cli {
namespace {

constexpr std::size_t kMaxProcessBytes = std::size_t{1} << 20;  // of a few lines for people

}  // namespace

Result<solid::ProcessLimits> process_of(const std::string& name) {
  if (!name.ends_with(".json")) return solid::process_named(name);
  return read_file(name, kMaxProcessBytes).and_then([&](const std::string& bytes) {
    return solid::parse_process(bytes, name);
  });
}

void WallDemands::add_to(CLI::App& command) {
  command.add_option("--min-wall", min_wall_mm_, "Minimum wall [mm]")->check(in_range(1e-6, 1e4));
  command.add_option(
      "--process", process_name_,
      "Process that sets the minimum wall: fdm, sla, earthenware, stoneware, porcelain, or a .json "
      "file with limits of your own");
}

Result<void> WallDemands::load() {
  if (process_name_.empty()) return {};
  return process_of(process_name_).map([&](solid::ProcessLimits process) {
    process_ = std::move(process);
  });
}

std::optional<WallDemand> WallDemands::for_size(double size_sum_mm) const {
  std::optional<WallDemand> demand;
  if (min_wall_mm_) demand = WallDemand{*min_wall_mm_, "--min-wall"};
  if (!process_) return demand;
  const solid::WallLimit& limit = process_->wall_for(size_sum_mm);
  if (demand && demand->min_wall_mm >= limit.min_wall_mm) return demand;
  return WallDemand{limit.min_wall_mm, process_->name + ": " + limit.source};
}

}  // namespace clay::cli
