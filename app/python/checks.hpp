#pragma once
// The check of a mesh for Python.

#include "claystack/export/solid.hpp"

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

namespace clay::python {

/// The keywords of claystack.check.
struct CheckSettings {
  std::optional<double> min_wall_mm;
  std::optional<std::string> process;
};

pybind11::dict check_mesh(const solid::TriangleMesh& mesh, const CheckSettings& settings);

/// The verdict, and the warnings.
pybind11::tuple check_file(const std::string& path, const CheckSettings& settings);

}  // namespace clay::python
