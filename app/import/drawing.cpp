#include "app/import/drawing.hpp"

#include "app/import/readers.hpp"
#include "core/lower_case.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

namespace clay::importing {
namespace {

constexpr double kFarthestMm = 1e6;

/// Standard input has no name: the ending that its first bytes suggest.
std::string_view ending_of(std::string_view bytes) {
  constexpr std::string_view kBlank = " \t\r\n";
  constexpr std::string_view kWide[] = {"\xFF\xFE<", {"\xFE\xFF\0<", 4}};  // XML in UTF-16
  if (std::ranges::any_of(kWide, [&](auto begin) { return bytes.starts_with(begin); }))
    return ".svg";
  bytes = without_byte_order_mark(bytes);
  bytes.remove_prefix(std::min(bytes.find_first_not_of(kBlank), bytes.size()));
  if (bytes.starts_with('<')) return ".svg";
  // A DXF file begins with the group code of a section or of a comment, alone on its line.
  const std::string_view first = bytes.substr(0, bytes.find_first_of("\r\n"));
  const bool dxf = trimmed(first) == "0" || trimmed(first) == "999";
  return dxf || bytes.starts_with("AutoCAD Binary DXF") ? ".dxf" : ".csv";
}

/// Checks that apply to every reader.
Result<Drawing> checked(Drawing drawing, const std::string& name) {
  std::size_t count = 0;
  for (const Line& line : drawing.lines) count += line.points_mm.size();
  if (count < 2)
    return failure(ErrorKind::bad_input,
                   name + ": expected the outline of a pot, found no line in it");
  if (drawing.lines.size() > kMostLines)
    return failure(ErrorKind::bad_input, fmt::format("{}: expected at most {} lines, found {}",
                                                     name, kMostLines, drawing.lines.size()));
  return drawing;
}

}  // namespace

std::string_view trimmed(std::string_view text, std::string_view blanks) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool for_construction(std::string_view layer_name) {
  constexpr std::string_view kBegin = "construction";
  return lower_case(layer_name.substr(0, kBegin.size())) == kBegin;
}

std::string list_of(std::span<const std::string> names) {
  constexpr std::size_t kMostNamed = 12;
  std::vector<std::string> named;
  for (const std::string& name : names.first(std::min(names.size(), kMostNamed)))
    named.push_back(shown(name));
  const std::size_t more = names.size() - named.size();
  return fmt::format("\"{}\"{}", fmt::join(named, "\", \""),
                     more > 0 ? fmt::format(" and {} more", more) : std::string());
}

std::string PointLimits::out_of_bounds(std::span<const glm::dvec2> points_mm) {
  for (const glm::dvec2& p : points_mm)
    if (!(std::abs(p.x) <= kFarthestMm && std::abs(p.y) <= kFarthestMm))
      return fmt::format("expected points within {:g} mm, found ({:g}, {:g})", kFarthestMm, p.x,
                         p.y);
  return {};
}

std::string PointLimits::problem_with(std::span<const glm::dvec2> points_mm) {
  if (std::string problem = out_of_bounds(points_mm); !problem.empty()) return problem;
  count_ += points_mm.size();
  if (count_ > kMostPoints)
    return fmt::format("expected at most {} points, found more", kMostPoints);
  return {};
}

Result<Drawing> read_drawing(std::string_view bytes, const std::string& name,
                             const std::string& layer, double scale) {
  const std::string ending = name == "-"
                                 ? std::string(ending_of(bytes))
                                 : lower_case(std::filesystem::path(name).extension().string());
  const bool svg = ending == ".svg", dxf = ending == ".dxf";
  if (!svg && !dxf && ending != ".csv")
    return failure(
        ErrorKind::bad_input,
        name + ": expected a drawing (.svg, .dxf, .csv) or a mesh, found " + kind_of_file(bytes));
  if (bytes.empty())
    return failure(ErrorKind::bad_input, name + ": expected a drawing, found an empty file");
  if (bytes.size() > kMostBytes)
    return failure(ErrorKind::bad_input, fmt::format("{}: expected at most {} MiB, found {}", name,
                                                     kMostBytes >> 20, bytes.size() >> 20));
  if (!svg && !dxf && !layer.empty())
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected a drawing with layers, SVG or DXF, for the layer "
                               "\"{}\", found a table",
                               name, layer));
  auto read = svg   ? read_svg(bytes, name, layer, scale)
              : dxf ? read_dxf(bytes, name, layer, scale)
                    : read_csv(bytes, name, scale);
  if (!read && !(svg && bytes.starts_with('<')))
    return tl::make_unexpected(kind_error(std::move(read.error()), bytes, name,
                                          name == "-"
                                              ? "a drawing (SVG, DXF or CSV) on standard input"
                                              : "a drawing (" + ending + ")"));
  return std::move(read).and_then([&](Drawing&& drawing) {
    drawing.scale = scale;
    return checked(std::move(drawing), name);
  });
}

}  // namespace clay::importing
