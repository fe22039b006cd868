#pragma once
// The solid of a pot for Python: as files, and as a mesh.

#include "claystack/engine/clay.hpp"
#include "claystack/export/solid.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace clay::python {

/// The keywords of claystack.export. Whole numbers are doubles, so that one out of range is an
/// error with its name.
struct ExportSettings {
  double tolerance_mm = 0.0;
  std::string smoothing;
  std::optional<double> smooth_length_mm;
  std::optional<double> segments, max_triangles;
  std::optional<double> min_wall_mm;
  std::optional<std::string> process;
  double shrinkage = 0.0;
  std::optional<std::string> step, glb, material;
  bool wall_map = false;
  bool certificates = false;
};

pybind11::dict export_pot(const Pot& pot, const std::vector<std::string>& paths,
                          const ExportSettings& settings);

/// The mesh as a binary STL holds it.
std::shared_ptr<solid::TriangleMesh> mesh_of(const Pot& pot, const ExportSettings& settings);

}  // namespace clay::python
