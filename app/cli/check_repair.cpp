#include "app/cli/check.hpp"
#include "app/cli/remedies.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/repair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace clay::cli {
namespace {

using solid::MeshFormat;
using solid::TriangleMesh;

/// Decimation to few triangles may cause intersections. In that case the repair writes nothing.
Result<void> expect_sound(const TriangleMesh& decimated, std::size_t most) {
  return report_on(decimated).and_then([&](const solid::MeshReport& report) -> Result<void> {
    if (report.sound()) return {};
    const solid::MeshProblem& first = report.problems.front();
    return failure(ErrorKind::unsound,
                   fmt::format("--max-triangles {}: expected a sound mesh, found {} ({}) in the "
                               "decimated one; try another number of triangles",
                               most, first.what, first.count));
  });
}

/// Repairs and decimates if requested. `found` is the report on the mesh.
Result<TriangleMesh> repaired_mesh(TriangleMesh mesh, const solid::MeshReport& found,
                                   const CheckCommand& command, RepairSummary& summary,
                                   Progress& progress) {
  summary.before = state_of(mesh, found);
  summary.found = found.problems;
  if (found.has_volume) summary.volume_before_mm3 = found.volume_mm3;
  if (command.repair && !summary.found.empty()) {
    solid::RepairOptions options = command.repair_options;
    options.progress = [&](std::string_view stage, double share) { progress.stage(stage, share); };
    auto repaired = solid::repair_unsound_mesh(mesh, options);
    if (!repaired) return failure(repaired.error().kind, with_options(repaired.error().message));
    mesh = std::move(repaired->mesh);
    summary.repaired = std::move(repaired->repaired);
    summary.holes = std::move(repaired->holes);
    summary.change = repaired->change;
    summary.wrapped_mm = repaired->wrapped_mm;
    summary.thickened = repaired->thickened;
  }
  summary.triangles_before = mesh.triangles.size();
  if (command.max_triangles && mesh.triangles.size() > *command.max_triangles) {
    auto decimated =
        solid::decimate(mesh, *command.max_triangles,
                        {.progress = [&](double share) { progress.stage("decimating", share); }});
    if (!decimated) return tl::make_unexpected(decimated.error());
    summary.decimation_error_mm = decimated->max_error_mm;
    mesh = std::move(decimated->mesh);
    if (command.repair)
      if (auto sound = expect_sound(mesh, *command.max_triangles); !sound)
        return tl::make_unexpected(sound.error());
  }
  return mesh;
}

/// The mesh in the file and its report; the field for the bytes stays empty.
Result<WrittenMesh> read_back(const std::string& bytes, MeshFormat format,
                              const std::string& name) {
  return solid::decode_mesh(bytes, format, name).and_then([&](TriangleMesh mesh) {
    return report_on(mesh).map([&](solid::MeshReport report) {
      return WrittenMesh{{}, std::move(mesh), std::move(report)};
    });
  });
}

/// Draco's grid, also of the mesh in a GLB.
bool is_on_grid(MeshFormat format) {
  return format == MeshFormat::drc || format == MeshFormat::glb;
}

/// Compares files with their mesh, and keeps the last one that is no worse.
class FileJudge {
 public:
  FileJudge(const TriangleMesh& mesh, MeshFormat format, const std::string& name)
      : mesh_(mesh), format_(format), name_(name), volume_mm3_(solid::signed_volume(mesh)) {}

  Result<void> operator()(const std::string& bytes) {
    auto found = read_back(bytes, format_, name_);
    if (!found) return tl::make_unexpected(found.error());
    const MeshState state = state_of(found->mesh, found->report);
    if (state != MeshState::sound && !wanted_) {
      const auto before = report_on(mesh_);
      if (!before) return tl::make_unexpected(before.error());
      wanted_ = state_of(mesh_, *before);
    }
    if (!keeps_volume(found->report))
      return failure(ErrorKind::unsound,
                     "expected a file with the volume of the mesh within 1 %, found " +
                         fmt::format("{:.6g} mm3 instead of {:.6g} mm3", found->report.volume_mm3,
                                     volume_mm3_));
    if (state != MeshState::sound && state > *wanted_)
      return failure(ErrorKind::unsound,
                     "expected a file as sound as the mesh, found faults after rounding to the "
                     "numbers of " +
                         std::string(name_of(format_)));
    accepted_ = std::move(*found);
    return {};
  }

  WrittenMesh take(std::string bytes) {
    accepted_.bytes = std::move(bytes);
    return std::move(accepted_);
  }

 private:
  /// A grid that is coarse for a thin plate changes its volume. Formats in float32 have no grid to
  /// refine.
  [[nodiscard]] bool keeps_volume(const solid::MeshReport& report) const {
    constexpr double kMostShare = 0.01;
    if (!is_on_grid(format_) || !report.has_volume) return true;
    return std::abs(report.volume_mm3 - volume_mm3_) <= kMostShare * std::abs(volume_mm3_);
  }

  const TriangleMesh& mesh_;
  MeshFormat format_;
  const std::string& name_;
  double volume_mm3_;
  std::optional<MeshState> wanted_;  ///< of the mesh, if a file is not sound
  WrittenMesh accepted_;
};

/// Encodes the mesh; in a format with a grid, on finer and finer grids until the file is no worse
/// than the mesh. Errors: `unsound` if none is fine enough.
Result<WrittenMesh> encoded(const TriangleMesh& mesh, MeshFormat format, const std::string& name) {
  constexpr double kGridOfSize = 1e-5;
  const bool on_grid = is_on_grid(format);
  solid::FileContents contents{.name = "repaired"};
  contents.draco.max_error_mm = std::min(contents.draco.max_error_mm,
                                         kGridOfSize * glm::length(solid::extent_of(mesh).size()));
  FileJudge judge(mesh, format, name);
  const auto encode = [&](int bits) {
    contents.draco.min_bits = bits;
    return solid::encode_mesh(mesh, format, contents);
  };
  const int first_bits = contents.draco.min_bits;
  auto bytes = on_grid ? solid::encode_on_finer_grids(first_bits, encode, std::ref(judge))
                       : encode(first_bits).and_then([&](std::string once) {
                           return judge(once).map([&] { return std::move(once); });
                         });
  return std::move(bytes).map([&](std::string written) { return judge.take(std::move(written)); });
}

/// The verdict is on the contents of the output file, so they are decoded and checked before the
/// file gets its name.
Result<WrittenMesh> written(WrittenMesh file, const CheckCommand& command, RepairSummary& summary) {
  summary.bytes = file.bytes.size();
  if (command.dry_run) return file;
  if (const auto done = publish(command.out, file.bytes); !done)
    return tl::make_unexpected(done.error());
  summary.path = command.out;
  return file;
}

/// Adds the bounds of the change in the mesh of the file.
Result<WrittenMesh> with_change(WrittenMesh file, const TriangleMesh& input,
                                RepairSummary& summary) {
  // Other formats hold float32, as the mesh that was compared.
  if (!summary.decimation_error_mm && !is_on_grid(summary.format)) return file;
  return solid::change_between(input, file.mesh).map([&](const solid::SurfaceChange& change) {
    summary.change = change;
    return std::move(file);
  });
}

}  // namespace

Result<WrittenMesh> repair_and_write(const TriangleMesh& mesh, const solid::MeshReport& found,
                                     const CheckCommand& command, RepairSummary& summary,
                                     Progress& progress) {
  // Without a name, a dry run takes the format of the input, if it can be written.
  auto format = solid::mesh_format_of(command.out.empty() ? command.file : command.out,
                                      solid::FormatUse::write);
  if (!format && (command.out.empty() || command.out == "-")) format = MeshFormat::stl_binary;
  if (!format) return tl::make_unexpected(format.error());
  summary.format = *format;
  return repaired_mesh(mesh, found, command, summary, progress)
      .and_then([&](const TriangleMesh& result) {
        progress.stage("writing");
        return encoded(result, summary.format, command.out)
            .and_then([&](WrittenMesh file) { return with_change(std::move(file), mesh, summary); })
            .and_then([&](WrittenMesh file) { return written(std::move(file), command, summary); });
      });
}

}  // namespace clay::cli
