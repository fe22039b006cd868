#include "app/python/exports.hpp"

#include "app/cli/choice_text.hpp"
#include "app/cli/export_words.hpp"
#include "app/cli/file_options.hpp"
#include "app/python/values.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"
#include "core/material.hpp"
#include "core/text.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace clay::python {
namespace {

void expect_word(std::string_view keyword, const std::string& word,
                 const std::vector<std::string>& words) {
  if (std::ranges::find(words, word) != words.end()) return;
  throw Failed{{ErrorKind::bad_input,
                std::string(keyword).append(": expected ").append(cli::choice_of(words)) +
                    ", found " + word}};
}

template <class T, std::size_t N>
T value_named(std::string_view keyword, const std::string& word, const cli::Words<T, N>& words) {
  expect_word(keyword, word, cli::names_in(words));
  return *cli::value_of(word, words);
}

std::optional<std::size_t> count_of(const std::optional<double>& count,
                                    const solid::OptionRange& range) {
  if (!count) return std::nullopt;
  value_of(solid::check_range(range, *count));
  return static_cast<std::size_t>(*count);
}

solid::ExportOptions options_of(const ExportSettings& settings) {
  solid::ExportOptions options;
  options.tolerance_mm = settings.tolerance_mm;
  options.smoothing = value_named("smoothing", settings.smoothing, cli::kSmoothings);
  options.smooth_length_mm = settings.smooth_length_mm;
  options.segments = count_of(settings.segments, solid::kSegmentsRange);
  options.max_triangles = count_of(settings.max_triangles, solid::kMaxTrianglesRange);
  options.walls.min_wall_mm = settings.min_wall_mm;
  if (settings.process) options.walls.process = value_of(solid::read_process(*settings.process));
  options.shrinkage = settings.shrinkage;
  if (settings.step) options.step_walls = value_named("step", *settings.step, cli::kStepWalls);
  if (settings.glb) options.glb = value_named("glb", *settings.glb, cli::kGlbMeshes);
  if (settings.material) {
    expect_word("material", *settings.material, material_ids());
    options.material = *settings.material;
  }
  options.wall_map = settings.wall_map;
  return options;
}

/// Refuses settings of formats that are not among the files, as the command line does.
void expect_files_of(const ExportSettings& settings, const std::vector<solid::FileRequest>& files) {
  const std::array options{cli::facet_option(settings.segments.has_value(), "segments"),
                           cli::facet_option(settings.max_triangles.has_value(), "max_triangles"),
                           cli::step_option(settings.step.has_value(), "step"),
                           cli::glb_option(settings.glb.has_value(), "glb"),
                           cli::glb_option(settings.material.has_value(), "material"),
                           cli::colour_option(settings.wall_map, "wall_map")};
  value_of(cli::check_file_options(options, files));
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
    one["text"] = text_of(problem.text);
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

}  // namespace

py::dict export_pot(const Pot& pot, const std::vector<std::string>& paths,
                    const ExportSettings& settings) {
  if (paths.empty())
    throw Failed{{ErrorKind::bad_input, "files: expected one file or more, found none"}};
  solid::ExportRequest request;
  request.options = options_of(settings);
  request.certificates = settings.certificates;
  for (const std::string& path : paths)
    request.files.push_back(value_of(solid::file_request(path)));
  expect_files_of(settings, request.files);
  request.options.name = name_of_file(paths.front());
  solid::ExportReport report;
  {
    py::gil_scoped_release others_run;
    report = value_of(solid::export_files(pot, request));
  }
  return report_of(report);
}

std::shared_ptr<solid::TriangleMesh> mesh_of(const Pot& pot, const ExportSettings& settings) {
  const solid::ExportOptions options = options_of(settings);
  py::gil_scoped_release others_run;
  solid::MemoryStore store;
  value_of(solid::run_export(pot, {{solid::MeshFormat::stl_binary, &store}}, options));
  return std::make_shared<solid::TriangleMesh>(
      value_of(solid::decode_mesh(store.bytes(), solid::MeshFormat::stl_binary, "mesh")));
}

}  // namespace clay::python
