#include "app/python/checks.hpp"

#include "app/python/values.hpp"
#include "claystack/export/proof.hpp"

namespace clay::python {

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

}  // namespace clay::python
