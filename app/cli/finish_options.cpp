#include "app/cli/finish_options.hpp"

#include "app/cli/quantity.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace clay::cli {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "60x6x4": diameter, width and depth; "6x4": width and depth. A unit at the end, "6x4cm", applies
/// to all sizes that have no unit.
Result<solid::FootRing> foot_of(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream list(text);
  for (std::string part; std::getline(list, part, 'x');) parts.push_back(part);
  const std::string last = parts.empty() ? "" : parts.back();
  const std::size_t unit = last.find_last_of("0123456789.") + 1;
  std::vector<double> sizes;
  for (std::string& part : parts) {
    const std::size_t end = part.find_last_not_of(' ');
    const bool bare = end != std::string::npos && (part[end] == '.' || is_digit(part[end]));
    if (bare) part += last.substr(unit);
    if (const auto size = length_of(part, solid::kSmallestPartMm, solid::kLongestMm))
      sizes.push_back(*size);
  }
  const bool all = sizes.size() == parts.size() && !text.ends_with('x');
  if (all && sizes.size() == 2) return solid::FootRing{sizes[0], sizes[1], std::nullopt};
  if (all && sizes.size() == 3) return solid::FootRing{sizes[1], sizes[2], sizes[0]};
  return failure(ErrorKind::bad_input,
                 fmt::format("expected DIAMETERxWIDTHxDEPTH or WIDTHxDEPTH, each a length from "
                             "{:g} to {:g} mm, such as 60x6x4 or 6mmx4mm, found {}",
                             solid::kSmallestPartMm, solid::kLongestMm, text));
}

/// An option for a part of the section: 0, or a length from kSmallestPartMm.
template <class Value>
void add_part_length(CLI::App& command, const std::string& name, Value& value,
                     const std::string& help, double high_mm) {
  command.add_option(name, value, help)
      ->type_name(kLengthName)
      ->transform(length_within(solid::kSmallestPartMm, high_mm, OrNone::yes));
}

}  // namespace

void add_finish_options(CLI::App& command, solid::ExportOptions& options, double& glaze_mm) {
  command
      .add_option_function<std::string>(
          "--foot",
          [&options](const std::string& text) {
            if (const auto foot = foot_of(text)) options.finish.foot = *foot;
          },
          "Cut a foot ring: DIAMETERxWIDTHxDEPTH [mm] of the wet pot, such as 60x6x4 or "
          "6x0.6x0.4cm; "
          "without a diameter, 6x4, it is as wide as the foot of the pot (default: none)")
      ->type_name(fmt::format("[{0}x]{0}x{0}", kLengthName))
      ->check([](const std::string& text) {
        const auto parsed = foot_of(text);
        return parsed ? std::string() : parsed.error().message;
      });
  add_part_length(
      command, "--floor-fillet", options.finish.floor_fillet_mm,
      "Radius where the wall meets the floor inside, filled with clay, of the wet pot [mm] "
      "(default: none)",
      solid::kFloorFilletRange.highest);
  add_part_length(
      command, "--lip-fillet", options.lip_fillet_mm,
      "Radius of the fillet at both edges of the lip, of the wet pot [mm] (default: that of "
      "--process; else none)",
      solid::kLipFilletRange.highest);
  add_part_length(command, "--glaze-allowance", glaze_mm,
                  "Thickness of the glaze, fired: every face but the foot is set back by it, so "
                  "that the fired and glazed pot has the size of the pot; at least a tenth of "
                  "--tolerance [mm] (default: 0)",
                  solid::kGlazeRange.highest);
}

}  // namespace clay::cli
