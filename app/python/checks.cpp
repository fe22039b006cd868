#include "app/python/checks.hpp"

#include "app/cli/check.hpp"
#include "app/cli/mesh_unit.hpp"
#include "app/python/values.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"
#include "claystack/export/proof.hpp"

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::python {
namespace {

cli::CheckCommand command_of(std::string name, const CheckSettings& settings) {
  solid::WallDemand demand;
  if (settings.min_wall_mm)
    value_of(solid::check_range(solid::kMinWallRange, *settings.min_wall_mm));
  demand.min_wall_mm = settings.min_wall_mm;
  if (settings.process) demand.process = value_of(solid::read_process(*settings.process));
  cli::CheckCommand command;
  command.file = std::move(name);
  command.walls = cli::WallOptions(std::move(demand));
  return command;
}

cli::Console silent() {
  cli::Console console;
  console.quiet = true;
  return console;
}

py::dict problem(std::string_view what, std::string_view text, bool fails) {
  py::dict one;
  one["what"] = text_of(what);
  one["text"] = text_of(text);
  one["fails"] = fails;
  return one;
}

py::list problems_of(const cli::Verdict& verdict) {
  py::list problems;
  for (const solid::MeshProblem& found : verdict.mesh.problems)
    problems.append(problem(found.what, cli::problem_text(found), true));
  for (const cli::Finding& finding : verdict.findings)
    if (finding.grade != cli::Grade::pass)
      problems.append(problem(finding.check, finding.text, finding.grade == cli::Grade::fail));
  return problems;
}

py::dict report_of(const cli::Verdict& verdict) {
  const solid::MeshReport& report = verdict.mesh;
  py::dict dict;
  dict["passes"] = verdict.passes(false);
  dict["sound"] = verdict.state == cli::MeshState::sound;
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
  const auto& wall = verdict.wall_sampled;
  dict["sampled_wall_mm"] =
      wall && std::isfinite(wall->least_mm) ? py::object(py::float_(wall->least_mm)) : py::none();
  dict["problems"] = problems_of(verdict);
  return dict;
}

}  // namespace

py::dict check_mesh(const solid::TriangleMesh& mesh, const CheckSettings& settings) {
  const cli::CheckCommand command = command_of("mesh", settings);
  cli::Verdict verdict;
  {
    py::gil_scoped_release others_run;
    verdict = value_of(cli::check_mesh(mesh, command, silent()));
  }
  return report_of(verdict);
}

py::tuple check_file(const std::string& path, const CheckSettings& settings) {
  const cli::CheckCommand command = command_of(path, settings);
  cli::Verdict verdict;
  std::vector<std::string> warnings;
  {
    py::gil_scoped_release others_run;
    const auto format = value_of(solid::mesh_format_of(path));
    verdict = value_of(cli::check_mesh_file(format, command, silent()));
    if (const auto doubt = cli::doubted_unit(verdict.mesh.size_mm, format))
      warnings.push_back(path + ": " + *doubt);
  }
  return with_warnings(report_of(verdict), warnings);
}

}  // namespace clay::python
