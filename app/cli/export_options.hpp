#pragma once
// The command line of `claystack export`.

#include "app/cli/wall_options.hpp"
#include "claystack/export/job.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>
#include <vector>

namespace clay::cli {

/// The command line as given. `request` has the fields that options set directly;
/// `complete_request` adds the rest.
struct ExportCommand {
  const CLI::App* line = nullptr;
  std::string pot;
  std::vector<std::string> outputs, named_outputs;
  solid::ExportRequest request;
  std::string smooth = "fair";
  bool length_of_tool = false;  ///< --smooth-length tool
  std::string verify = "margins";
  std::optional<std::string> step, glb, material;
  solid::Goal goal;
  WallOptions walls;
  double glaze_mm = 0.0;  ///< of the fired pot
  std::optional<double> precision_mm;
  bool ascii = false;

  [[nodiscard]] bool given(const std::string& option) const { return line->count(option) > 0; }
  [[nodiscard]] bool has_goal() const {
    return goal.holds_ml || goal.weighs_g || goal.height_mm || goal.diameter_mm;
  }
};

/// The table of options. `command` must outlive the parsing.
void add_export_options(CLI::App& sub, ExportCommand& command);

}  // namespace clay::cli
