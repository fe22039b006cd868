#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/walls.hpp"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace clay::cli {

/// The options --min-wall and --process of a command. The larger limit applies.
class WallOptions {
 public:
  WallOptions() = default;
  /// For a caller without a command line, such as Python: no `load` is needed.
  explicit WallOptions(solid::WallDemand demand);

  void add_to(CLI::App& command);

  [[nodiscard]] bool asked() const noexcept { return min_wall_mm_ || !process_.empty(); }
  /// The process as given: a name, or a file; empty if none is.
  [[nodiscard]] const std::string& process() const noexcept { return process_; }
  /// Reads the process if one is given. Call it first, so that a bad name is reported before any
  /// work.
  Result<void> load();
  /// Valid after `load`.
  [[nodiscard]] const solid::WallDemand& demand() const noexcept { return demand_; }

 private:
  std::optional<double> min_wall_mm_;
  std::string process_;
  solid::WallDemand demand_;
};

}  // namespace clay::cli
