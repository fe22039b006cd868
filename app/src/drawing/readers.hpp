#pragma once
// One reader for each format; read_drawing chooses.

#include "drawing/drawing.hpp"

namespace clay::drawing {

Result<Drawing> read_svg(std::string_view bytes, const std::string& name);
Result<Drawing> read_dxf(std::string_view bytes, const std::string& name);
Result<Drawing> read_csv(std::string_view text, const std::string& name);

}  // namespace clay::drawing
