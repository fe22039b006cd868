// The part of the Python package in C++: values and arrays. claystack/__init__.py makes dataclasses
// of them.

#include "app/cli/mesh_unit.hpp"
#include "app/cli/pot_input.hpp"
#include "app/python/checks.hpp"
#include "app/python/exports.hpp"
#include "app/python/made_pot.hpp"
#include "app/python/values.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/solid.hpp"
#include "claystack/version.hpp"
#include "core/text.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::python {
namespace {

const char* name_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::unsound:
      return "unsound";
    case ErrorKind::bad_input:
      return "bad_input";
    case ErrorKind::io:
      return "io";
    case ErrorKind::device:
      return "device";
  }
  return "bad_input";
}

/// An array that shows `data` without a copy and keeps `owner` alive; it cannot be written to.
template <class T>
py::array shown(const T* data, std::vector<py::ssize_t> shape, py::object owner) {
  py::array_t<T> array(std::move(shape), data, std::move(owner));
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::array points_of(const std::shared_ptr<solid::TriangleMesh>& mesh) {
  static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));
  return shown(mesh->points.empty() ? nullptr : &mesh->points.front().x,
               {static_cast<py::ssize_t>(mesh->points.size()), 3}, py::cast(mesh));
}

py::array triangles_of(const std::shared_ptr<solid::TriangleMesh>& mesh) {
  return shown(mesh->triangles.empty() ? nullptr : mesh->triangles.front().data(),
               {static_cast<py::ssize_t>(mesh->triangles.size()), 3}, py::cast(mesh));
}

/// The counts of R^2 and r^2 [2^-36 mm^2], one row per ring: the pot's own memory.
py::array quanta_of(const std::shared_ptr<Pot>& pot) {
  static_assert(sizeof(Ring) == 2 * sizeof(Quanta));
  return shown(&pot->stack.rings().front().outer2, {static_cast<py::ssize_t>(pot->stack.size()), 2},
               py::cast(pot));
}

std::shared_ptr<Pot> shared(Result<Pot> pot) {
  return std::make_shared<Pot>(value_of(std::move(pot)));
}

py::tuple read_mesh(const std::string& path) {
  std::shared_ptr<solid::TriangleMesh> mesh;
  std::vector<std::string> warnings;
  {
    py::gil_scoped_release others_run;
    const auto format = value_of(solid::mesh_format_of(path));
    const std::string bytes = value_of(read_file(path));
    mesh = std::make_shared<solid::TriangleMesh>(value_of(solid::decode_mesh(bytes, format, path)));
    if (const auto doubt = cli::doubted_unit(solid::extent_of(*mesh).size(), format))
      warnings.push_back(path + ": " + *doubt);
  }
  return with_warnings(std::move(mesh), warnings);
}

/// Calls `make`, while other threads of Python run.
template <class Make>
py::tuple made_pot(const Make& make) {
  MadePot made;
  {
    py::gil_scoped_release others_run;
    made = value_of(make());
  }
  return with_warnings(std::make_shared<Pot>(std::move(made.pot)), made.warnings);
}

void add_types(py::module_& module) {
  py::class_<solid::TriangleMesh, std::shared_ptr<solid::TriangleMesh>>(module, "Mesh")
      .def_property_readonly("points", &points_of)
      .def_property_readonly("triangles", &triangles_of);
  py::class_<Pot, std::shared_ptr<Pot>>(module, "Pot")
      .def("equals", [](const Pot& pot, const Pot& other) { return pot == other; })
      .def_property_readonly("quanta", &quanta_of)
      .def_property_readonly("ring_height_mm",
                             [](const Pot& pot) { return pot.stack.ring_height_mm(); })
      .def_property_readonly("height_mm", [](const Pot& pot) { return pot.stack.height_mm(); })
      .def_property_readonly("volume_mm3", [](const Pot& pot) { return pot.stack.volume_mm3(); })
      .def_property_readonly("density_g_cm3", [](const Pot& pot) { return pot.density_g_cm3; })
      .def_property_readonly("collapsed", [](const Pot& pot) { return pot.collapse.has_value(); });
  py::class_<ExportSettings>(module, "ExportSettings")
      .def(py::init<>())
      .def_readwrite("tolerance_mm", &ExportSettings::tolerance_mm)
      .def_readwrite("smoothing", &ExportSettings::smoothing)
      .def_readwrite("smooth_length_mm", &ExportSettings::smooth_length_mm)
      .def_readwrite("segments", &ExportSettings::segments)
      .def_readwrite("max_triangles", &ExportSettings::max_triangles)
      .def_readwrite("min_wall_mm", &ExportSettings::min_wall_mm)
      .def_readwrite("process", &ExportSettings::process)
      .def_readwrite("shrinkage", &ExportSettings::shrinkage)
      .def_readwrite("step", &ExportSettings::step)
      .def_readwrite("glb", &ExportSettings::glb)
      .def_readwrite("material", &ExportSettings::material)
      .def_readwrite("wall_map", &ExportSettings::wall_map)
      .def_readwrite("certificates", &ExportSettings::certificates);
}

void add_functions(py::module_& module) {
  const auto released = py::call_guard<py::gil_scoped_release>();
  module.def(
      "read_pot", [](const std::string& path) { return shared(cli::read_pot(path)); }, released);
  module.def(
      "write_pot",
      [](const Pot& pot, const std::string& path) { value_of(write_named_pot(pot, path)); },
      released);
  module.def("throw_pot", [](const std::string& scene, const std::string& session) {
    return made_pot([&] { return throw_pot(scene, session); });
  });
  module.def(
      "stacked",
      [](double ring_height_mm, const std::vector<double>& outer_mm,
         const std::vector<double>& inner_mm, double density_g_cm3) {
        return shared(stacked(ring_height_mm, outer_mm, inner_mm, density_g_cm3));
      },
      py::arg("ring_height_mm"), py::arg("outer_mm"), py::arg("inner_mm"),
      py::arg("density_g_cm3"));
  module.def("export_pot", &export_pot);
  module.def("mesh_of", &mesh_of);
  module.def("read_mesh", &read_mesh);
  module.def("check_mesh", [](const solid::TriangleMesh& mesh, std::optional<double> min_wall_mm,
                              std::optional<std::string> process) {
    return check_mesh(mesh, {min_wall_mm, std::move(process)});
  });
  module.def("check_file", [](const std::string& path, std::optional<double> min_wall_mm,
                              std::optional<std::string> process) {
    return check_file(path, {min_wall_mm, std::move(process)});
  });
  module.def("import_pot", [](const std::string& path, std::optional<double> height_mm,
                              std::optional<double> wall_mm) {
    return made_pot([&] { return import_pot(path, {height_mm, wall_mm}); });
  });
  module.attr("version") = CLAYSTACK_VERSION;
}

}  // namespace
}  // namespace clay::python

PYBIND11_MODULE(_native, module) {
  using namespace clay::python;
  static py::exception<Failed> failure(module, "Failure");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Failed& failed) {
      const py::tuple arguments =
          py::make_tuple(name_of(failed.error.kind), text_of(failed.error.message));
      PyErr_SetObject(failure.ptr(), arguments.ptr());
    }
  });
  add_types(module);
  add_functions(module);
}
