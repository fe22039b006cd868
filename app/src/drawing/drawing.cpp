#include "drawing/drawing.hpp"

#include "drawing/readers.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clay::drawing {
namespace {

/// Whatever the reader: points that are numbers, and not too many.
Result<Drawing> checked(Drawing drawing, const std::string& name) {
  std::size_t count = 0;
  for (const Line& line : drawing.lines) {
    count += line.points_mm.size();
    for (const glm::dvec2& p : line.points_mm)
      if (!(std::abs(p.x) <= 1e6 && std::abs(p.y) <= 1e6))
        return failure(
            ErrorKind::bad_input,
            fmt::format("{}: expected points within 1e6 mm, found ({:g}, {:g})", name, p.x, p.y));
  }
  if (count < 2)
    return failure(ErrorKind::bad_input,
                   name + ": expected the outline of a pot, found no line in it");
  if (count > kMostPoints)
    return failure(ErrorKind::bad_input, fmt::format("{}: expected at most {} points, found {}",
                                                     name, kMostPoints, count));
  return drawing;
}

}  // namespace

Result<Drawing> read_drawing(std::string_view bytes, const std::string& name) {
  const auto reader = name.ends_with(".svg")   ? read_svg
                      : name.ends_with(".dxf") ? read_dxf
                      : name.ends_with(".csv") ? read_csv
                                               : nullptr;
  if (reader == nullptr)
    return failure(ErrorKind::bad_input,
                   name + ": expected a drawing NAME.svg, NAME.dxf or NAME.csv");
  if (bytes.size() > kMostBytes)
    return failure(ErrorKind::bad_input, fmt::format("{}: expected at most {} MiB, found {}", name,
                                                     kMostBytes >> 20, bytes.size() >> 20));
  return reader(bytes, name).and_then([&](Drawing&& drawing) {
    return checked(std::move(drawing), name);
  });
}

}  // namespace clay::drawing
