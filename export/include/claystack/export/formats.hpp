#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/solid.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

// ---- mesh formats --------------------------------------------------------------------
// The only doors through which meshes come in and go out. Encoders write to memory;
// publishing is the caller's. Decoders trust nothing: they are ours for STL and OBJ, and
// Draco's own behind a guard.

struct DracoClaims;  // drc_claims.hpp

enum class MeshFormat { stl_binary, stl_ascii, obj, drc };
inline constexpr std::array kMeshFormats{MeshFormat::stl_binary, MeshFormat::stl_ascii,
                                         MeshFormat::obj, MeshFormat::drc};

/// By the name's end, in either case: .stl (binary), .obj, .drc; anything else is an error
/// that lists them.
Result<MeshFormat> mesh_format_of(std::string_view path);
/// By `name_of`.
Result<MeshFormat> mesh_format_named(std::string_view name);
/// As the enumerator is spelt.
[[nodiscard]] std::string_view name_of(MeshFormat format) noexcept;

/// What Draco's encoder may do to positions.
struct DracoSettings {
  double max_error_mm = 0.01;  ///< largest displacement of a vertex, above 0
  int min_bits = 8;            ///< at least this many bits per coordinate, 1 to 30
  int speed = 2;               ///< of Draco, 0 .. 10; on pots 2 is smallest, 10 fastest
};

/// Coordinates go out as float32 without -0: the text formats print the shortest digits that
/// read back as the same float32, and STL's normals are those of the corners as written (zero
/// where these lie in a line). The mesh has coordinates within 1e6 mm, indices in range and at
/// most 2^32 - 1 triangles. Of a name only one line is written, of at most 200 bytes.
std::string encode_stl_binary(const TriangleMesh& mesh);
std::string encode_stl_ascii(const TriangleMesh& mesh, std::string_view solid_name);
std::string encode_obj(const TriangleMesh& mesh, std::string_view object_name);

/// Edgebreaker, positions only, on the coarsest grid of at least `min_bits` that keeps the
/// promise for every vertex, roundings included; the same bytes every time. With `claims` the file
/// carries them, and a checksum of all its bytes, as metadata. Triangles and
/// vertices come in an order of Draco's own, vertices where surfaces touch are split, and
/// points of no triangle are left out. Errors: `bad_input` for settings out of range or an
/// error that no 30 bits can keep (the least possible is named), or claims that are not finite,
/// below 0 or of a smaller vertex error than `settings` allow; `unsound` for a mesh that
/// Draco would spoil (a triangle that uses a vertex twice, a coordinate or index out of range).
Result<std::string> encode_drc(const TriangleMesh& mesh, const DracoSettings& settings,
                               const DracoClaims* claims = nullptr);

/// A mesh as a file states it, nothing repaired: 1 to 20 million triangles, points of float32
/// within 1e6 mm (-0 read as 0), indices in range. A file is at most 1 GiB. Errors are of kind
/// `bad_input`, or `io` where there is not enough memory; `name` begins each: "NAME: facet 12:
/// ...", "NAME:34: ..."; facets, faces and lines count from 1.
Result<TriangleMesh> decode_mesh(std::string_view bytes, MeshFormat format, std::string_view name);

/// A file that is read from front to back.
struct ByteSource {
  /// Fills the span from its begin with the bytes that follow; returns how many, 0 at the end.
  std::function<Result<std::size_t>(std::span<char>)> read;
  std::uint64_t size = 0;  ///< of the whole file
  /// May be empty. Told about how many triangles there are, by the file's size, before memory is
  /// taken for them; an error of its ends the reading.
  std::function<Result<void>(std::uint64_t triangles)> announce;
};

/// More than 20 million triangles take as text, but for odd ones.
inline constexpr std::uint64_t kMaxTextBytes = std::uint64_t{8} << 30;

/// An STL or OBJ file as `decode_stl` and `decode_obj` read it, but only a megabyte or two of it
/// are in memory at a time, and text may take kMaxTextBytes. What the source reports is passed on.
Result<TriangleMesh> read_stl(const ByteSource& source, std::string_view name);
Result<TriangleMesh> read_obj(const ByteSource& source, std::string_view name);

/// A file of exactly the size that its count asks for is binary, whatever its first word;
/// anything else must be text, whole from "solid" to "endsolid". The solids of a text file make
/// one mesh. Corners are welded where their float32 coordinates are equal. Normals are not
/// trusted: binary ones and attributes are passed over, and text ones need only be finite.
Result<TriangleMesh> decode_stl(std::string_view bytes, std::string_view name);

/// v, vt, vn and f are read, polygons (up to 4096 corners) as fans; o, g, s, mtllib, usemtl, l,
/// p and comments are passed over, and no other file is opened; any other statement is an error.
/// Indices are kept: points that coincide stay apart.
Result<TriangleMesh> decode_obj(std::string_view bytes, std::string_view name);

/// Triangle meshes of Draco 2.2; point clouds are refused. The format has no checksum: a spoilt
/// file may well decode to another mesh. One with claims of ours (`drc_claims`) has, and is refused
/// unless it holds.
Result<TriangleMesh> decode_drc(std::string_view bytes, std::string_view name);

/// The mesh as float32 files hold it.
[[nodiscard]] TriangleMesh rounded_to_float(const TriangleMesh& mesh);

// ---- drc claims ----------------------------------------------------------------------
// What a Draco file of ours states of the solid in it, as metadata that other decoders pass over:
//   claystack.volume_mm3, .volume_bound_mm3, .counted_volume_mm3, .vertex_error_mm   float64
//   claystack.checksum   XXH3-128 of the file without these 32 hexadecimal digits

/// Finite, and none below 0.
struct DracoClaims {
  double volume_mm3 = 0.0;          ///< of the solid before it was encoded
  double volume_bound_mm3 = 0.0;    ///< the decoded mesh's volume is within this of it
  double counted_volume_mm3 = 0.0;  ///< of the stack that the solid was made of
  double vertex_error_mm = 0.0;     ///< no vertex is farther from where it was

  friend bool operator==(const DracoClaims&, const DracoClaims&) = default;
};

/// What the file states, after the checksum has been found to hold; nothing for files of others.
/// Errors as those of `decode_drc`: header, metadata and checksum are checked, not the mesh.
Result<std::optional<DracoClaims>> drc_claims(std::string_view bytes, std::string_view name);

// ---- file store ----------------------------------------------------------------------
// Where the bytes of a file go, and from where they can be read again before they are believed.

class FileStore {
 public:
  virtual ~FileStore() = default;
  /// Appends. After an error nothing more is written.
  virtual Result<void> write(std::span<const std::byte> bytes) = 0;
  /// False where what has been written is gone (a pipe): then nothing is read.
  [[nodiscard]] virtual bool rereadable() const noexcept = 0;
  /// Fills `bytes` with what was written from `offset` on; from several threads at once. An error
  /// where so much has not been written.
  virtual Result<void> read_at(std::uint64_t offset, std::span<std::byte> bytes) const = 0;
};

/// A file in memory.
class MemoryStore final : public FileStore {
 public:
  Result<void> write(std::span<const std::byte> bytes) override;
  [[nodiscard]] bool rereadable() const noexcept override { return true; }
  Result<void> read_at(std::uint64_t offset, std::span<std::byte> bytes) const override;
  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

 private:
  std::string bytes_;
};

// ---- section svg ---------------------------------------------------------------------

/// A drawing of the pot cut through its axis, to scale, with height, diameter and a
/// scale bar [mm]; a collapsed pot is drawn as it lies, seen with the HIP to the right, and where
/// it passed as it fell is dashed.
std::string section_svg(const Pot& pot);

}  // namespace clay::solid::inline formats
