#pragma once
// How thick a wall must be: as the user says, or as a process asks.

#include "claystack/core/result.hpp"
#include "claystack/export/walls.hpp"

#include <optional>
#include <string>
#include <utility>

namespace CLI {
class App;
}

namespace clay::cli {

struct WallDemand {
  double min_wall_mm = 0.0;
  std::string source;  ///< "--min-wall", or whose figure it is
};

/// One of solid::kProcessNames, or a file of the user's own, .json.
Result<solid::ProcessLimits> process_of(const std::string& name);

/// The options --min-wall and --process of a command; of both, the larger figure holds.
class WallDemands {
 public:
  void add_to(CLI::App& command);
  /// The same without a command line; an empty name: no process.
  void ask(std::optional<double> min_wall_mm, std::string process) {
    min_wall_mm_ = min_wall_mm;
    process_name_ = std::move(process);
  }

  [[nodiscard]] bool asked() const noexcept { return min_wall_mm_ || !process_name_.empty(); }
  /// Reads the process where one is named. Before any work: a bad name costs nothing then.
  Result<void> load();
  /// For an object whose width, depth and height add up to this; nothing where nothing was asked.
  [[nodiscard]] std::optional<WallDemand> for_size(double size_sum_mm) const;

 private:
  std::optional<double> min_wall_mm_;
  std::string process_name_;
  std::optional<solid::ProcessLimits> process_;
};

}  // namespace clay::cli
