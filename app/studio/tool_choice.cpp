#include "app/studio/tool_choice.hpp"

#include "claystack/engine/plan.hpp"

#include <algorithm>

namespace clay::studio {
namespace {

void scale(double& mm, double factor) {
  mm = std::clamp(mm * factor, kSmallestToolMm, kLargestToolMm);
}

ToolShapeSpec shape_of(const ToolChoice& choice) {
  switch (choice.shape) {
    case Shape::ellipse:
      return choice.ellipse;
    case Shape::rib:
      return choice.rib;
    case Shape::own:
      if (!choice.own.t_mm.empty()) return choice.own;
      break;
    case Shape::sphere:
      break;
  }
  return choice.sphere;
}

struct Chooser {
  ToolChoice& choice;
  void operator()(const SphereSpec& sphere) const {
    choice.shape = Shape::sphere;
    choice.sphere = sphere;
  }
  void operator()(const EllipseSpec& ellipse) const {
    choice.shape = Shape::ellipse;
    choice.ellipse = ellipse;
  }
  void operator()(const RibSpec& rib) const {
    choice.shape = Shape::rib;
    choice.rib = rib;
  }
  void operator()(const SampledSpec& own) const {
    choice.shape = Shape::own;
    choice.own = own;
  }
};

}  // namespace

const char* name_of(ToolMode mode) noexcept {
  switch (mode) {
    case ToolMode::press:
      return "Press";
    case ToolMode::trim:
      return "Trim";
    case ToolMode::pinch:
      return "Pinch";
    case ToolMode::smooth:
      return "Smooth";
    case ToolMode::needle:
      return "Needle";
    case ToolMode::wire:
      return "Wire";
    case ToolMode::trim_foot:
      break;
  }
  return "Foot";
}

ToolSpec tool_of(const ToolChoice& choice, bool inverted) {
  ToolSpec tool;
  tool.shape = shape_of(choice);
  tool.mode = choice.mode;
  if (cuts_level(tool.mode)) {
    tool.shape = SphereSpec{kSmallestToolMm};
    return tool;
  }
  if (inverted && tool.mode != ToolMode::trim_foot)
    tool.mode = tool.mode == ToolMode::trim ? ToolMode::press : ToolMode::trim;
  if (tool.mode == ToolMode::pinch) tool.gap_mm = choice.gap_mm;
  return tool;
}

void choose(const ToolSpec& tool, ToolChoice& choice) {
  std::visit(Chooser{choice}, tool.shape);
  choice.mode = tool.mode;
  if (!tool.gap_mm) return;
  choice.gap_mm = std::clamp(*tool.gap_mm, kNarrowestGapMm, kWidestPinchMm);
  choice.gap_share = 0.0;
}

std::optional<double> size_mm(const ToolChoice& choice) {
  switch (choice.shape) {
    case Shape::ellipse:
      return choice.ellipse.half_height_mm;
    case Shape::rib:
      return choice.rib.height_mm;
    case Shape::own:
      return std::nullopt;
    case Shape::sphere:
      break;
  }
  return choice.sphere.radius_mm;
}

void resize(ToolChoice& choice, double factor) {
  switch (choice.shape) {
    case Shape::ellipse:
      scale(choice.ellipse.half_height_mm, factor);
      scale(choice.ellipse.half_width_mm, factor);
      break;
    case Shape::rib:
      scale(choice.rib.height_mm, factor);
      scale(choice.rib.radius_mm, factor);
      break;
    case Shape::own:
      break;  // its points define its size
    case Shape::sphere:
      scale(choice.sphere.radius_mm, factor);
      break;
  }
}

}  // namespace clay::studio
