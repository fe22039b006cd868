#include "app/cli/mesh_input.hpp"

#include "app/cli/memory_room.hpp"
#include "app/cli/remedies.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/export/mesh_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <utility>

namespace clay::cli {
namespace {

using solid::MeshFormat;
using solid::TriangleMesh;

/// A closed mesh has half as many points as triangles.
constexpr std::uint64_t kMeshBytesPerTriangle =
    sizeof(decltype(TriangleMesh::triangles)::value_type) + sizeof(glm::dvec3) / 2;

Result<void> expect_room_for(std::uint64_t triangles, std::uint64_t bytes_per_triangle,
                             const MeshWork& work, const std::string& path) {
  return expect_room(fmt::format("{}: {} about {} triangles", path, work.name, triangles),
                     triangles * (kMeshBytesPerTriangle + bytes_per_triangle));
}

}  // namespace

Result<MeshFile> MeshFile::open(const std::string& path, MeshFormat format, bool keep_bytes) {
  auto reader = FileReader::open(path);
  if (!reader) return tl::make_unexpected(reader.error());
  MeshFile file(path, format);
  if (!keep_bytes && solid::facts_of(format).streamed && reader->size()) {
    file.stream_.emplace(std::move(*reader));
    return file;
  }
  auto bytes = read_file(path);
  if (!bytes) return tl::make_unexpected(bytes.error());
  file.bytes_ = std::move(*bytes);
  return file;
}

MeshFile MeshFile::of_bytes(std::string name, MeshFormat format, std::string bytes) {
  MeshFile file(std::move(name), format);
  file.bytes_ = std::move(bytes);
  return file;
}

Result<std::optional<solid::FacetCount>> MeshFile::missing_facets() const {
  if (format_ != MeshFormat::stl_binary) return std::nullopt;
  if (!stream_) return solid::missing_facets(bytes_, bytes_.size());
  // The stream reads the facets later, and does not go back.
  auto reader = FileReader::open(path_);
  if (!reader) return tl::make_unexpected(reader.error());
  std::array<char, solid::kStlPrologueBytes> head{};
  std::size_t known = 0;
  while (known < head.size()) {
    const auto more = reader->read(std::span(head).subspan(known));
    if (!more) return tl::make_unexpected(more.error());
    if (*more == 0) break;
    known += *more;
  }
  return solid::missing_facets(std::string_view(head.data(), known), *stream_->size());
}

Result<TriangleMesh> MeshFile::read(const MeshWork& work, const solid::ReadOptions& options) {
  auto mesh = decoded(work, options).map_error([&](const Error& error) {
    return Error{error.kind, with_options(error.message, path_.size())};
  });
  if (options.notes != nullptr)
    for (std::string& note : *options.notes) note = with_options(std::move(note));
  return mesh;
}

Result<TriangleMesh> MeshFile::decoded(const MeshWork& work, const solid::ReadOptions& options) {
  if (!stream_) {
    const solid::MeshEstimate mesh = solid::estimate_mesh(bytes_, format_);
    return expect_room_for(mesh.triangles, std::max(mesh.decoding_bytes, work.bytes_per_triangle),
                           work, path_)
        .and_then([&] { return solid::decode_mesh(bytes_, format_, path_, options); });
  }
  const solid::ByteSource source{
      [&](std::span<char> part) { return stream_->read(part); }, *stream_->size(),
      [&](std::uint64_t triangles) {
        return expect_room_for(triangles, work.bytes_per_triangle, work, path_);
      }};
  return solid::read_mesh(source, format_, path_, options);
}

}  // namespace clay::cli
