// The part of the Python package in C++: values and arrays. claystack/__init__.py makes dataclasses
// of them.

#include "app/cli/mesh_unit.hpp"
#include "app/cli/pot_input.hpp"
#include "app/python/made_pot.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"
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

namespace py = pybind11;

namespace clay::python {
namespace {

/// Becomes claystack.Error, with its kind.
struct Failed {
  Error error;
};

template <class T>
T value_of(Result<T> result) {
  if (!result) throw Failed{std::move(result.error())};
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

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

/// Text with names of files in it, as Python has them: bytes that are not UTF-8 become surrogates.
py::str text_of(std::string_view text) {
  PyObject* const made =
      PyUnicode_DecodeFSDefaultAndSize(text.data(), static_cast<py::ssize_t>(text.size()));
  if (made == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(made);
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

struct ExportSettings {
  double tolerance_mm;
  std::string smoothing;
  std::optional<double> smooth_length_mm;
  std::optional<double> min_wall_mm;
  std::optional<std::string> process;
  double shrinkage;
  bool certificates;
};

solid::ExportOptions options_of(const ExportSettings& settings) {
  solid::ExportOptions options;
  options.tolerance_mm = settings.tolerance_mm;
  options.smoothing = solid::Smoothing::none;
  bool known = settings.smoothing == "none";
  for (const auto mode : {solid::Smoothing::fair, solid::Smoothing::exact})
    if (solid::name_of(mode) == settings.smoothing) options.smoothing = mode, known = true;
  if (!known)
    throw Failed{{ErrorKind::bad_input,
                  "smoothing: expected fair, exact or none, found " + settings.smoothing}};
  options.smooth_length_mm = settings.smooth_length_mm;
  options.walls.min_wall_mm = settings.min_wall_mm;
  if (settings.process) options.walls.process = value_of(solid::read_process(*settings.process));
  options.shrinkage = settings.shrinkage;
  return options;
}

py::dict report_of(const solid::ExportReport& report) {
  py::list files, problems;
  for (const solid::FileReport& file : report.files) {
    py::dict one;
    one["path"] = text_of(file.path);
    one["bytes"] = file.bytes;
    one["content_hash"] = file.content_hash;
    one["max_error_mm"] = file.max_error_mm;
    files.append(one);
  }
  for (const solid::Problem& problem : solid::problems_of(report)) {
    py::dict one;
    one["what"] = solid::check_name(problem.kind);
    one["where"] = text_of(problem.text);
    one["fails"] = problem.fails;
    problems.append(one);
  }
  py::dict dict;
  dict["triangles"] = report.size.triangles;
  dict["segments"] = report.size.segments;
  dict["diameter_mm"] = report.size.diameter_mm;
  dict["height_mm"] = report.size.height_mm;
  dict["volume_mm3"] = report.volume.solid_mm3;
  dict["min_wall_mm"] = report.thinnest_mm();
  dict["files"] = files;
  dict["problems"] = problems;
  return dict;
}

py::dict export_pot(const Pot& pot, const std::vector<std::string>& paths,
                    const ExportSettings& settings) {
  if (paths.empty())
    throw Failed{{ErrorKind::bad_input, "files: expected one file or more, found none"}};
  solid::ExportRequest request;
  request.options = options_of(settings);
  request.certificates = settings.certificates;
  for (const std::string& path : paths)
    request.files.push_back(value_of(solid::file_request(path)));
  request.options.name = name_of_file(paths.front());
  solid::ExportReport report;
  {
    py::gil_scoped_release others_run;
    report = value_of(solid::export_files(pot, request));
  }
  return report_of(report);
}

/// The mesh as a binary STL holds it.
std::shared_ptr<solid::TriangleMesh> mesh_of(const Pot& pot, const ExportSettings& settings) {
  const solid::ExportOptions options = options_of(settings);
  py::gil_scoped_release others_run;
  solid::MemoryStore store;
  value_of(solid::run_export(pot, {{solid::MeshFormat::stl_binary, &store}}, options));
  return std::make_shared<solid::TriangleMesh>(
      value_of(solid::decode_mesh(store.bytes(), solid::MeshFormat::stl_binary, "mesh")));
}

/// `value`, and the warnings about it.
template <class T>
py::tuple with_warnings(std::shared_ptr<T> value, const std::vector<std::string>& warnings) {
  py::list list;
  for (const std::string& warning : warnings) list.append(text_of(warning));
  return py::make_tuple(std::move(value), std::move(list));
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

py::dict check_mesh(const solid::TriangleMesh& mesh) {
  solid::MeshReport report;
  {
    py::gil_scoped_release others_run;
    report = value_of(solid::check_mesh(mesh));
  }
  py::list problems;
  for (const solid::MeshProblem& problem : report.problems) {
    py::dict one;
    one["what"] = problem.what;
    one["where"] = problem.where;
    one["fails"] = true;
    problems.append(one);
  }
  py::dict dict;
  dict["sound"] = report.sound();
  dict["closed"] = report.closed;
  dict["manifold"] = report.manifold;
  dict["oriented"] = report.oriented;
  dict["components"] = report.components;
  dict["cavities"] = report.cavities;
  dict["self_intersections"] = report.self_intersections;
  dict["triangles"] = report.triangles;
  dict["volume_mm3"] = report.has_volume ? py::object(py::float_(report.volume_mm3)) : py::none();
  dict["area_mm2"] = report.area_mm2;
  dict["size_mm"] = py::make_tuple(report.size_mm.x, report.size_mm.y, report.size_mm.z);
  dict["problems"] = problems;
  return dict;
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
      .def(py::init<double, std::string, std::optional<double>, std::optional<double>,
                    std::optional<std::string>, double, bool>(),
           py::arg("tolerance_mm"), py::arg("smoothing"), py::arg("smooth_length_mm"),
           py::arg("min_wall_mm"), py::arg("process"), py::arg("shrinkage"),
           py::arg("certificates"));
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
  module.def("check_mesh", &check_mesh);
  module.def("import_pot",
             [](const std::string& path) { return made_pot([&] { return import_pot(path); }); });
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
