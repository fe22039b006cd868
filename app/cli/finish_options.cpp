#include "app/cli/finish_options.hpp"

#include "app/cli/console.hpp"
#include "app/cli/usage.hpp"
#include "core/number_text.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <string>
#include <system_error>
#include <vector>

namespace clay::cli {
namespace {

constexpr double kLargestMm = 1e4;

/// "60x6x4": diameter, width and depth in mm; "6x4": width and depth.
Result<solid::FootRing> foot_of(const std::string& text) {
  const auto wrong = [&] {
    return failure(ErrorKind::bad_input,
                   fmt::format("expected DIAMETERxWIDTHxDEPTH or WIDTHxDEPTH in mm, such as 60x6x4 "
                               "or 6x4, found {}",
                               text));
  };
  std::vector<double> sizes;
  const char *at = text.data(), *end = at + text.size();
  while (true) {
    double size = 0.0;
    const auto [stop, problem] = from_chars(at, end, size);
    if (problem != std::errc() || !(size > 0.0 && size <= kLargestMm)) return wrong();
    sizes.push_back(size);
    if (stop == end) break;
    if (*stop != 'x') return wrong();
    at = stop + 1;
  }
  if (sizes.size() == 2) return solid::FootRing{sizes[0], sizes[1], std::nullopt};
  if (sizes.size() == 3) return solid::FootRing{sizes[1], sizes[2], sizes[0]};
  return wrong();
}

}  // namespace

void add_finish_options(CLI::App& command, solid::ExportOptions& options, double& glaze_mm) {
  command
      .add_option_function<std::string>(
          "--foot",
          [&options](const std::string& text) {
            if (const auto foot = foot_of(text)) options.finish.foot = *foot;
          },
          "Cut a foot ring: DIAMETERxWIDTHxDEPTH [mm], such as 60x6x4; without a diameter, 6x4, it "
          "is as wide as the foot of the pot (default: none)")
      ->check([](const std::string& text) {
        const auto parsed = foot_of(text);
        return parsed ? std::string() : parsed.error().message;
      });
  command
      .add_option("--floor-fillet", options.finish.floor_fillet_mm,
                  "Radius where the wall meets the floor inside, filled with clay [mm] (default: "
                  "none)")
      ->check(in_range(0.0, 1e3));
  command
      .add_option("--lip-fillet", options.lip_fillet_mm,
                  "Radius of the fillet at both edges of the lip [mm] (default: that of --process; "
                  "else none)")
      ->check(in_range(0.0, 1e3));
  command
      .add_option("--glaze-allowance", glaze_mm,
                  "Thickness of the glaze on the fired pot: every face but the foot is set back by "
                  "it, so that the glazed pot has the size of the pot [mm] (default: 0)")
      ->check(in_range(0.0, 10.0));
}

}  // namespace clay::cli
