#pragma once
// Meshes as input files: all commands read them here, within the limit on memory.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/mesh_estimate.hpp"
#include "claystack/export/solid.hpp"
#include "core/file_reader.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace clay::cli {

/// The work that follows on a mesh, for the estimate of its memory.
struct MeshWork {
  std::string_view name;  ///< "checking"
  std::uint64_t bytes_per_triangle = 0;
};

/// A mesh file that is open. It is streamed unless its format, a pipe or the caller needs all of
/// its bytes.
class MeshFile {
 public:
  static Result<MeshFile> open(const std::string& path, solid::MeshFormat format,
                               bool keep_bytes = false);
  /// A file that has been read, such as standard input.
  static MeshFile of_bytes(std::string name, solid::MeshFormat format, std::string bytes);

  /// The whole file; empty if it is streamed.
  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

  /// Of a binary STL that was cut off; empty for other files. Errors: `io`.
  [[nodiscard]] Result<std::optional<solid::FacetCount>> missing_facets() const;

  /// Once only. Before memory is allocated for the triangles, their number is read from the file or
  /// estimated; an error of kind `io` if mesh and work do not fit: "NAME: checking about 20000000
  /// triangles needs ...". Errors and notes name the options that help.
  Result<solid::TriangleMesh> read(const MeshWork& work, const solid::ReadOptions& options = {});

 private:
  MeshFile(std::string path, solid::MeshFormat format) : path_(std::move(path)), format_(format) {}
  Result<solid::TriangleMesh> decoded(const MeshWork& work, const solid::ReadOptions& options);

  std::string path_;
  solid::MeshFormat format_;
  std::optional<FileReader> stream_;  ///< unless all bytes are kept
  std::string bytes_;
};

}  // namespace clay::cli
