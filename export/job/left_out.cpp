#include "export/job/left_out.hpp"

#include "claystack/export/proof.hpp"
#include "export/job/solid_contents.hpp"

#include <algorithm>
#include <chrono>

namespace clay::solid::inline job {
namespace {

template <class Work>
double seconds_of(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Measures encoding only; nothing is written.
double encoding_seconds(MeshFormat format, const TriangleMesh& mesh, const ExportOptions& options) {
  const FileContents contents = solid_contents(options);
  return seconds_of([&] { (void)encode_mesh(mesh, format, contents); });
}

}  // namespace

void measure_left_out(std::vector<SkippedStage>& list, const ClayStack& stack,
                      const TriangleMesh& mesh, const ExportOptions& options) {
  for (SkippedStage& item : list) {
    if (item.what == kVerificationStage)
      item.saved_s = seconds_of([&] { (void)check_mesh(rounded_to_float(mesh)); });
    if (item.what == kSmoothingStage)
      item.saved_s = seconds_of([&] {
        SmoothingOptions how;
        how.tolerance_mm = options.tolerance_mm;
        (void)smooth_profile_of(stack, how);
      });
    if (const auto format = mesh_format_named(item.what))
      item.saved_s = encoding_seconds(*format, mesh, options);
  }
}

std::vector<SkippedStage> left_out(const ClayStack& stack, const std::string& no_smoothing,
                                   const RevolveLayout& rule, bool made_mesh,
                                   const std::vector<Output>& outputs,
                                   const ExportOptions& options) {
  std::vector<SkippedStage> list;
  const auto add = [&](bool out, std::string what, std::string why) {
    if (out) list.push_back({std::move(what), std::move(why), std::nullopt});
  };
  add(!stack.hollow(), "inner shell", "no ring has a bore");
  add(!no_smoothing.empty(), kSmoothingStage, no_smoothing);
  add(true, "union", "the pot has not collapsed");
  add(!options.max_triangles, "budget", "no limit of triangles requested");
  add(!made_mesh, kMeshStage, "no requested file needs one");
  add(!options.full_verification, kVerificationStage, "the certificate covers it; not requested");
  add_formats_left_out(outputs, list);
  if (!options.measure_left_out || rule.triangles() > kMaxTriangles) return list;
  TriangleMesh mesh;
  const double meshing = seconds_of([&] { mesh = revolve(rule); });
  for (SkippedStage& item : list)
    if (item.what == kMeshStage) item.saved_s = meshing;
  measure_left_out(list, stack, mesh, options);
  return list;
}

void add_formats_left_out(const std::vector<Output>& outputs, std::vector<SkippedStage>& list) {
  for (const FormatFacts& facts : kFormatFacts)
    if (facts.written && std::none_of(outputs.begin(), outputs.end(), [&](const Output& output) {
          return output.format == facts.format;
        }))
      list.push_back({std::string(facts.name), "not requested", std::nullopt});
}

}  // namespace clay::solid::inline job
