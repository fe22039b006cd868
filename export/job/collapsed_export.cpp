#include "export/job/collapsed_export.hpp"

#include "claystack/engine/clay.hpp"
#include "claystack/export/check.hpp"
#include "claystack/export/option_ranges.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/solid.hpp"
#include "claystack/export/walls.hpp"
#include "core/content_hash.hpp"
#include "export/formats/draco_bits.hpp"
#include "export/formats/glb.hpp"
#include "export/formats/stored_file.hpp"
#include "export/job/left_out.hpp"
#include "export/job/resolution.hpp"
#include "export/job/solid_contents.hpp"
#include "export/job/stages.hpp"
#include "export/proof/describe.hpp"
#include "export/proof/inspect_mesh.hpp"
#include "export/proof/verify_file.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <string>
#include <utility>

namespace clay::solid::inline job {
namespace {

class CollapsedExport {
 public:
  CollapsedExport(const PreparedPot& prepared, const std::vector<Output>& outputs,
                  const ExportOptions& options,
                  const std::function<void(std::string_view)>& progress)
      : prepared_(prepared),
        pot_(prepared.pot),
        outputs_(outputs),
        options_(options),
        stages_(report_.stages, progress) {}

  Result<ExportReport> run() {
    return named(make_solid(), options_.source).and_then([&] { return write_all(); }).map([&] {
      list_left_out();
      return std::move(report_);
    });
  }

 private:
  Result<void> make_solid() {
    return check_collapsed_options(options_)
        .and_then([&] { return make_parts(); })
        .and_then([&] { return unite(); })
        .and_then([&] { return meet_budget(); })
        .map([&] { measure_overhang(); });
  }

  Result<void> make_parts() {
    return stages_
        .run("parts",
             [&] { return collapsed_parts(pot_, options_.smoothing, options_.tolerance_mm); })
        .and_then([&](CollapsedParts found) {
          parts_ = std::move(found);
          return check_pieces(parts_.lower.shapes, options_.allow_pieces);
        })
        .and_then([&] { return check_pieces(parts_.upper.shapes, options_.allow_pieces); });
  }

  Result<void> unite() {
    const double reach = pot_.stack.height_mm() + 2.0 * glm::length(pot_.collapse->pivot_mm) +
                         glm::length(pot_.collapse->shift_mm);
    return choose_segments(parts_.together(), options_.tolerance_mm, options_, reach)
        .and_then([&](std::size_t segments) {
          return check_triangles(triangle_count(parts_.together(), segments), segments, options_)
              .map([&] { return segments; });
        })
        .and_then([&](std::size_t segments) {
          describe_parts(segments);
          return stages_.run("union", [&] {
            return collapsed_solid(parts_, *pot_.collapse, segments, options_.tolerance_mm);
          });
        })
        .map([&](CollapsedSolid solid) {
          mesh_ = std::exchange(solid.mesh, {});
          describe_solid(std::move(solid));
        });
  }

  void describe_parts(std::size_t segments) {
    const PlanarCertificate &lower = parts_.lower_certificate, &upper = parts_.upper_certificate;
    ProvedSection& section = report_.section;
    section.planar = {lower.polygons + upper.polygons, lower.vertices + upper.vertices,
                      lower.axis_segments + upper.axis_segments};
    section.smoothing = parts_.smoothing;
    section.no_smoothing =
        options_.smoothing == Smoothing::none ? "not requested" : parts_.no_smoothing;
    section.smoothed.section = {parts_.together(), parts_.lower.shapes};
    std::vector<PieceShape>& shapes = section.smoothed.section.shapes;
    shapes.insert(shapes.end(), parts_.upper.shapes.begin(), parts_.upper.shapes.end());
    report_.size.segments = segments;
    report_.size.tolerance_mm = options_.tolerance_mm;
    report_.size.chordal_error_mm = chordal_error_mm(largest_radius_mm(pot_.stack), segments);
    Wall& thinnest = report_.walls.thinnest;
    thinnest = min_wall(parts_.lower.profile);
    if (!parts_.upper.shapes.empty()) {
      const Wall fallen = min_wall(parts_.upper.profile);
      if (fallen.thickness_mm < thinnest.thickness_mm) thinnest = fallen;
    }
    report_.walls.min_wall_mm = claims_of(parts_.lower.profile, segments, 0.0).wall_lower_mm;
    if (!parts_.upper.shapes.empty())
      report_.walls.min_wall_mm = std::min(
          report_.walls.min_wall_mm, claims_of(parts_.upper.profile, segments, 0.0).wall_lower_mm);
  }

  void describe_solid(CollapsedSolid solid) {
    report_.prepared = prepared_.done;
    report_.size.shells = solid.check.components;
    describe_size();
    report_.process.limits = options_.walls.process;
    thin_walls_by(solid.reshaped_mm);
    report_.collapsed = std::move(solid);
    describe_volume(report_.collapsed->volume_mm3);
    ClayFigures clay = options_.clay;
    clay.density_g_cm3 = pot_.density_g_cm3;
    clay.shrinkage = options_.shrinkage;
    report_.fallen = fallen_numbers({report_.size.diameter_mm, report_.size.height_mm, 0.0},
                                    prepared_.done.counted_volume_mm3, clay, options_.fill_line_mm);
  }

  void describe_size() {
    const glm::dvec3 extents = extent_of(mesh_).size();
    report_.size.extents_mm = extents;
    report_.size.diameter_mm = std::max(extents.x, extents.y);
    report_.size.height_mm = extents.z;
    report_.size.triangles = mesh_.triangles.size();
    report_.walls.limit = options_.walls.for_size(size_sum_mm(extents));
  }

  /// Both sides of a wall may have moved.
  void thin_walls_by(double moved_mm) {
    double& wall_mm = report_.walls.min_wall_mm;
    wall_mm = std::max(0.0, wall_mm - 2.0 * moved_mm);
  }

  void measure_overhang() {
    const auto found = stages_.run("overhang", [&] { return steepest_overhang(mesh_); });
    if (found)
      report_.process.overhang = {found->angle_deg,
                                  {glm::length(glm::dvec2(found->at)), found->height_mm}};
  }

  void describe_volume(double volume_mm3) {
    const CollapsedSolid& solid = *report_.collapsed;
    const double counted_mm3 = prepared_.done.counted_volume_mm3;
    report_.volume = {
        volume_mm3,
        std::abs(volume_mm3 - solid.pockets_mm3 + solid.overlap_mm3 - counted_mm3) / counted_mm3};
  }

  /// The whole has no profile to revolve more coarsely, so the mesh is decimated and checked again.
  Result<void> meet_budget() {
    if (!options_.max_triangles || mesh_.triangles.size() <= *options_.max_triangles) return {};
    return stages_.run("decimate", [&] { return decimate(mesh_, *options_.max_triangles); })
        .and_then([&](DecimatedMesh decimated) -> Result<void> {
          mesh_ = rounded_to_float(decimated.mesh);
          const double moved_mm = decimated.max_error_mm + float_rounding_mm(mesh_);
          const MeshReport check = stages_.run("check", [&] { return inspect_mesh(mesh_); });
          if (!check.sound())
            return failure(ErrorKind::unsound,
                           "decimated: found " + describe(check.problems.front()));
          describe_size();
          thin_walls_by(moved_mm);
          report_.size.tolerance_mm += moved_mm;
          describe_volume(check.volume_mm3);
          report_.collapsed->max_move_mm += moved_mm;
          report_.collapsed->reshaped_mm += moved_mm;
          return {};
        });
  }

  Result<void> write_all() {
    for (const Output& output : outputs_) {
      const bool on_grid = output.format == MeshFormat::drc ||
                           (output.format == MeshFormat::glb && options_.glb != GlbMesh::core);
      auto file = named(on_grid ? write_on_grid(output.format, *output.store)
                                : write_exact(output.format, *output.store),
                        output.name.empty() ? options_.source : output.name);
      if (!file) return tl::make_unexpected(file.error());
      report_.files.push_back(std::move(*file));
    }
    return {};
  }

  Result<FileReport> write_exact(MeshFormat format, FileStore& store) {
    return stages_
        .run(stage_name("encode", format),
             [&] {
               const std::string thumbnail = thumbnail_for(format, options_);
               FileContents contents = solid_contents(options_);
               contents.thumbnail_png = thumbnail;
               return encode_mesh(mesh_, format, contents);
             })
        .and_then([&](const std::string& bytes) {
          // A GLB is in metres: rounded in mm, in metres, and in mm again by a reader.
          const double roundings = roundings_of(format);
          return verify(bytes, format, roundings * float_rounding_mm(mesh_))
              .and_then([&](double moved) { return written(bytes, format, moved, store); });
        });
  }

  /// Encodes on finer and finer grids until the decoded mesh is sound. Returns the last problem if
  /// none is.
  Result<FileReport> write_on_grid(MeshFormat format, FileStore& store) {
    const WallReport& walls = report_.walls;
    const double allowed =
        std::max(vertex_error_mm(options_.tolerance_mm, walls.min_wall_mm, walls.limit),
                 float_rounding_mm(mesh_));
    FileContents contents = solid_contents(options_);
    DracoSettings& settings = contents.draco;
    settings.max_error_mm = allowed;
    double moved_mm = 0.0;
    const auto encode = [&](int bits) {
      settings.min_bits = bits;
      return stages_.run(stage_name("encode", format),
                         [&] { return encode_mesh(mesh_, format, contents); });
    };
    const auto judge = [&](const std::string& bytes) {
      return verify(bytes, format, allowed + float_rounding_mm(mesh_)).map([&](double moved) {
        moved_mm = moved;
      });
    };
    return encode_on_finer_grids(least_draco_bits(mesh_), encode, judge)
        .and_then(
            [&](const std::string& bytes) { return written(bytes, format, moved_mm, store); });
  }

  Result<double> verify(const std::string& bytes, MeshFormat format, double allowed_mm) {
    return stages_.run(stage_name("verify", format),
                       [&] { return verify_file(bytes, format, mesh_, allowed_mm); });
  }

  Result<FileReport> written(const std::string& bytes, MeshFormat format, double moved,
                             FileStore& store) {
    const auto stored =
        stages_.run(stage_name("store", format), [&] { return write_in_parts(store, bytes); })
            .and_then([&] { return expect_stored(store, bytes, format); });
    if (!stored) return tl::make_unexpected(stored.error());
    FileReport report;
    report.format = format;
    report.bytes = bytes.size();
    report.content_hash = hash_of(bytes_of(bytes));
    report.max_error_mm = moved;
    report.proof = Proof::exact_test;
    report.read_back = store.rereadable();
    if (!options_.full_verification || !report.read_back) return report;
    return stages_
        .run("full_verification", [&] { return check_stored(store, report.bytes, format); })
        .map([&](MeshReport check) {
          report.full_verification = std::move(check);
          return report;
        });
  }

  void list_left_out() {
    auto& list = report_.left_out;
    if (!pot_.stack.hollow()) list.push_back({"inner shell", "no ring has a bore", {}});
    if (const std::string& why = report_.section.no_smoothing; !why.empty())
      list.push_back({kSmoothingStage, why, {}});
    add_formats_left_out(outputs_, list);
    if (options_.measure_left_out) measure_left_out(list, pot_.stack, mesh_, options_);
  }

  const PreparedPot& prepared_;
  const Pot& pot_;
  const std::vector<Output>& outputs_;
  const ExportOptions& options_;
  CollapsedParts parts_;
  TriangleMesh mesh_;
  ExportReport report_;
  Stages stages_;
};

}  // namespace

Result<void> check_collapsed_options(const ExportOptions& options) {
  const auto refuse = [](std::string_view option) {
    return failure(ErrorKind::bad_input,
                   std::string(option).append(": expected a standing pot, found a collapsed one"));
  };
  if (options.normals) return refuse("normals");
  if (options.wall_map) return refuse("wall map");
  if (options.wall_spacing_mm) return refuse("field of walls");
  if (options.smooth_length_mm.value_or(0.0) != 0.0) return refuse(kSmoothLengthRange.name);
  if (options.lip_fillet_mm.value_or(0.0) > 0.0) return refuse(kLipFilletRange.name);
  if (options.finish.foot) return refuse("foot ring");
  if (options.finish.floor_fillet_mm > 0.0) return refuse(kFloorFilletRange.name);
  if (options.finish.glaze_mm > 0.0) return refuse(kGlazeRange.name);
  return {};
}

Result<ExportReport> export_collapsed(const PreparedPot& prepared,
                                      const std::vector<Output>& outputs,
                                      const ExportOptions& options,
                                      const std::function<void(std::string_view)>& progress) {
  return CollapsedExport(prepared, outputs, options, progress).run();
}

}  // namespace clay::solid::inline job
