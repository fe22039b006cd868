#pragma once
// One certified revolve, written in any format, read back, and certified as written.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"
#include "export/job/point_walls.hpp"
#include "export/job/stages.hpp"
#include "export/solid/revolve_layout.hpp"

#include <optional>
#include <string>

namespace clay::solid::inline job {

class RevolveFiles {
 public:
  /// `claims`: before any rounding. `walls`: a limit that the pot meets is met in each file.
  RevolveFiles(const RevolveLayout& rule, const SolidCertificate& claims, const WallReport& walls,
               const ExportOptions& options, Stages& stages)
      : rule_(rule), claims_(claims), walls_of_pot_(walls), options_(options), stages_(stages) {}

  Result<FileReport> write(MeshFormat format, FileStore& store);

  /// False if all files can be streamed.
  [[nodiscard]] bool made_mesh() const noexcept { return mesh_.has_value(); }

 private:
  const TriangleMesh& mesh();
  /// Contents of a file of this format beside the surface.
  [[nodiscard]] FileContents contents_of(MeshFormat format);
  Result<FileReport> stream(FileStore& store);
  Result<FileReport> write_whole(MeshFormat format, FileStore& store);
  /// DRC and GLB.
  Result<FileReport> write_on_grid(MeshFormat format, FileStore& store);
  Result<FileReport> write_on_finer_grids(MeshFormat format, DracoSettings settings,
                                          FileStore& store);
  Result<std::string> encode_on_grid(MeshFormat format, const DracoSettings& settings);
  Result<FileReport> write_3mf(FileStore& store);
  Result<std::string> proved_package(const ModelPart& model, FileContents contents,
                                     double rounding_mm);
  /// Of bytes that were decoded and matched with the solid: those read back need only be the same.
  Result<void> store_judged(MeshFormat format, const std::string& bytes, FileStore& store);
  [[nodiscard]] DracoClaims draco_claims(double reach_mm) const;
  Result<Proof> prove_rounded(MeshFormat format, double rounding_mm);
  Result<FileReport> certify_bytes(MeshFormat format, double rounding_mm, Proof proof,
                                   const std::string& bytes, FileStore& store);
  /// Of bytes that are stored and read back.
  Result<FileReport> certified(MeshFormat format, double rounding_mm, Proof proof,
                               const std::string& bytes, FileStore& store);
  Result<FileReport> finish(MeshFormat format, SolidCertificate certificate, FileStore& store);

  const RevolveLayout& rule_;
  const SolidCertificate& claims_;
  const WallReport& walls_of_pot_;
  const ExportOptions& options_;
  Stages& stages_;
  std::optional<TriangleMesh> mesh_;
  std::optional<PointWalls> walls_;              ///< once needed
  std::optional<Result<void>> exact_;            ///< verdict on the mesh in float32, once needed
  std::optional<Result<void>> exact_in_metres_;  ///< the same, as a GLB rounds it
};

}  // namespace clay::solid::inline job
