#pragma once
// The files that an export is to write: what each holds, opened before any work, named after all.

#include "app/cli/file_on_disk.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/wall_demand.hpp"
#include "claystack/export/job.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace clay::cli {

struct ExportCommand {
  std::string pot;
  std::vector<std::string> outputs;
  solid::ExportOptions options;
  std::string smooth = "fair";
  std::string verify = "margins";
  std::string report;
  WallDemands walls;
  std::optional<double> precision_mm;
  bool ascii = false;
  bool certificate = false;
};

/// Meshes and tables of walls go through the job, drawings and pots straight from the pot.
struct Request {
  std::string path;
  std::optional<solid::MeshFormat> mesh;
  std::unique_ptr<FileOnDisk> file;
  std::unique_ptr<FileOnDisk> certificate;  ///< of a mesh, where asked for
};

/// One for each output. Refuses names of no known kind, one name twice, the pot's own, and options
/// that would do nothing for the files asked for.
Result<std::vector<Request>> requests_of(const ExportCommand& command);

/// Nothing where the name is empty.
Result<std::unique_ptr<FileOnDisk>> open_file(const std::string& path);

/// Opens every file before any work: what can't be written is known at once.
Result<void> open_all(std::vector<Request>& requests, const ExportCommand& command);

Result<void> write_text(FileOnDisk& file, const std::string& text);

/// Copies of the pot, as exact as asked for.
Result<std::vector<PotCopy>> write_copies(const Pot& pot, std::vector<Request>& requests,
                                          const ExportCommand& command);
/// Drawings, tables of walls and certificates; drawings in the size of the meshes.
Result<void> write_companions(const Pot& pot, const solid::ExportReport& report,
                              std::vector<Request>& requests, double shrinkage);

/// For `commit_all`.
[[nodiscard]] std::vector<AtomicFile*> files_of(const std::vector<Request>& requests);

}  // namespace clay::cli
