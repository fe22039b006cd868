#pragma once
// The command line of `claystack studio`.

#include "claystack/falcon/falcon_device.hpp"

#include <CLI/App.hpp>

#include <glm/vec2.hpp>
#include <optional>
#include <string>

namespace clay::cli {

struct StudioOptions {
  std::string file, script, screenshot;
  std::string theme;  ///< dark, light; empty: as stored
  std::string device = "auto";
  falcon::FalconSettings falcon;
  std::string size = "1280x800";  ///< as given; size_px once it was read
  glm::ivec2 size_px{1280, 800};
  double scale = 0.0;  ///< of text and controls; 0: the stored one, or 1 without a screen
  bool log = false;
  double servo_report_s = 0.0;  ///< 0: no report
  bool json = false;
};

/// The table of options, for the parser and for manual pages.
void add_studio_options(CLI::App& parser, double smallest_scale, double largest_scale,
                        StudioOptions& options);

/// Returns an exit status if the program ends here: after help, or after an error, which it has
/// printed. A scale outside its range is an error.
[[nodiscard]] std::optional<int> parse(int argc, char** argv, double smallest_scale,
                                       double largest_scale, StudioOptions& options);

}  // namespace clay::cli
