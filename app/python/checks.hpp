#pragma once
// The check of a mesh for Python.

#include "claystack/export/solid.hpp"

#include <pybind11/pybind11.h>

namespace clay::python {

pybind11::dict check_mesh(const solid::TriangleMesh& mesh);

}  // namespace clay::python
