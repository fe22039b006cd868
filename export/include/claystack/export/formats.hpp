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
#include <utility>
#include <vector>

namespace clay::solid::inline formats {

// ---- mesh formats --------------------------------------------------------------------
// The only readers and writers of mesh files. Encoders write to memory; the caller publishes.
// Decoders treat input as untrusted: own decoders for STL, OBJ, PLY and OFF; Draco's decoder behind
// checks; 3MF by libzip and libxml2; GLB by nlohmann-json and meshoptimizer.

struct DracoClaims;  // below

enum class MeshFormat { stl_binary, stl_ascii, obj, drc, ply, off, three_mf, three_mf_model, glb };

struct FormatFacts {
  MeshFormat format;
  std::string_view name;   ///< in reports, certificates and schemas
  std::string_view title;  ///< for people
  /// Of file names, in lower case; the first format with it is chosen. Empty: a part of a file.
  std::string_view ending;
  bool written;   ///< false: only read
  bool streamed;  ///< read with a part of the file in memory, by `read_mesh`
  bool decimal;   ///< coordinates are decimal digits
};

/// The formats, in the order in which messages and help list them.
inline constexpr std::array kFormatFacts{
    FormatFacts{MeshFormat::stl_binary, "stl_binary", "STL", ".stl", true, true, false},
    FormatFacts{MeshFormat::stl_ascii, "stl_ascii", "STL", ".stl", true, true, true},
    FormatFacts{MeshFormat::obj, "obj", "OBJ", ".obj", true, true, true},
    FormatFacts{MeshFormat::drc, "drc", "Draco", ".drc", true, false, false},
    FormatFacts{MeshFormat::ply, "ply", "PLY", ".ply", true, false, false},
    FormatFacts{MeshFormat::off, "off", "OFF", ".off", false, false, true},
    FormatFacts{MeshFormat::three_mf, "3mf", "3MF", ".3mf", true, false, true},
    FormatFacts{MeshFormat::three_mf_model, "3mf_model", "3MF model", "", false, false, true},
    FormatFacts{MeshFormat::glb, "glb", "GLB", ".glb", true, false, false}};

[[nodiscard]] constexpr const FormatFacts& facts_of(MeshFormat format) noexcept {
  return kFormatFacts[static_cast<std::size_t>(format)];
}

enum class FormatUse { read, write };
/// The endings of the formats for this use: ".stl, .obj or .drc" with " or " as `last`.
[[nodiscard]] std::string format_endings(FormatUse use, std::string_view last = " or ");

/// By the file name's extension, ignoring case (.stl: binary); any other is an error that lists the
/// endings for this use.
Result<MeshFormat> mesh_format_of(std::string_view path, FormatUse use = FormatUse::read);
/// The format that the readers recognise by the first bytes of a file without a name, a binary
/// STL by its byte 0; OBJ for other text, because OBJ has no mark.
[[nodiscard]] MeshFormat mesh_format_of_bytes(std::string_view bytes);
/// By the name in `FormatFacts`.
Result<MeshFormat> mesh_format_named(std::string_view name);
[[nodiscard]] constexpr std::string_view name_of(MeshFormat format) noexcept {
  return facts_of(format).name;
}

/// Limits on the positions for Draco's encoder.
struct DracoSettings {
  double max_error_mm = 0.01;  ///< largest displacement of a vertex, above 0
  int min_bits = 8;            ///< at least this many bits per coordinate, 1 to 30
  int speed = 2;  ///< Draco's speed, 0 to 10; on pots 2 gives the smallest files, 10 is fastest
};

/// Two corners that meet on a coarse grid may turn a face over: encodes on finer and finer grids,
/// from `first_bits` for each coordinate on, until `judge` accepts the bytes, and returns them.
/// Errors: that of `encode`, an `io` error of `judge`, or its last one if no grid is fine enough.
Result<std::string> encode_on_finer_grids(
    int first_bits, const std::function<Result<std::string>(int bits)>& encode,
    const std::function<Result<void>(const std::string& bytes)>& judge);

/// Coordinates are written as float32 without -0: the text formats print the shortest digits that
/// read back as the same float32, and STL normals are those of the written corners (zero if these
/// are collinear). Requires coordinates within 1e6 mm, indices in range and at most 2^32 - 1
/// triangles. Of a name only one line is written, of at most 200 bytes. These and the other
/// encoders throw std::bad_alloc if memory is short; `encode_mesh` reports it as an error.
std::string encode_stl_binary(const TriangleMesh& mesh);
std::string encode_stl_ascii(const TriangleMesh& mesh, std::string_view solid_name);
std::string encode_obj(const TriangleMesh& mesh, std::string_view object_name);

/// Edgebreaker, positions only, on the coarsest grid of at least `min_bits` that keeps
/// `max_error_mm` for every vertex, roundings included; deterministic. With `claims`, the file
/// carries them and a checksum of all its bytes as metadata. Triangles and vertices are in Draco's
/// order, vertices where surfaces touch are split, and unused points are omitted. Errors:
/// `bad_input` for settings out of range, an error limit that 30 bits cannot keep (the message
/// holds the smallest possible), or claims that are not finite, negative or of a smaller vertex
/// error than `settings` allow; `unsound` for a mesh that Draco would damage (a triangle that uses
/// a vertex twice, a coordinate or index out of range).
Result<std::string> encode_drc(const TriangleMesh& mesh, const DracoSettings& settings,
                               const DracoClaims* claims = nullptr);

/// Binary, little-endian: points as float32 x, y, z, faces as lists of 3 int32. With `wall_mm`, one
/// number for each point, every vertex also has a property `thickness`: the wall there [mm].
std::string encode_ply(const TriangleMesh& mesh, std::string_view object_name,
                       std::span<const float> wall_mm = {});

/// Encoding of the mesh in a GLB: plain float32, which every reader of glTF accepts; Draco; or
/// meshoptimizer, which viewers unpack faster.
enum class GlbMesh { core, draco, meshopt };

/// Contents of a file beside the surface; each format stores those that it supports.
struct FileContents {
  std::string_view name = "pot";        ///< of the solid or object
  std::span<const float> wall_mm = {};  ///< thickness at each point [mm]; empty: unknown
  /// PLY has them as numbers. GLB and 3MF have them as colours, from 0 to this thickness [mm].
  double wall_top_mm = 10.0;
  DracoSettings draco = {};
  GlbMesh glb = GlbMesh::draco;              ///< without Draco in this build, `draco` is `core`
  std::string_view material = "terracotta";  ///< id of a clay or glaze, as for `--material` (GLB)
  bool one_body = false;  ///< the mesh has one shell; spares the search for several (3MF)
  /// Metadata of the 3MF model, as `claystack:KEY`.
  std::vector<std::pair<std::string, std::string>> notes = {};
  std::string_view pot = {};            ///< a pot file, CBOR (3MF)
  std::string_view thumbnail_png = {};  ///< (3MF)
  std::string_view certificate = {};    ///< of the model part, JSON (3MF)
};

/// The mesh in any format that can be written, with the defaults of its encoder. Errors as for
/// `encode_drc`; `bad_input` for a format that is only read; `io` if memory is short.
Result<std::string> encode_mesh(const TriangleMesh& mesh, MeshFormat format,
                                const FileContents& contents = {});

/// The part 3D/3dmodel.model of a 3MF package: mm, an object for each body, with `notes` and a copy
/// of the pot (base64, of up to 4 MB) as metadata. Equal contents give equal bytes.
struct ModelPart {
  std::string xml;
  std::vector<std::size_t> bodies;  ///< triangles of each; their objects have the ids 1, 2, ...
};
ModelPart encode_3mf_model(const TriangleMesh& mesh, const FileContents& contents);
/// The package around that part: thumbnail, pot and certificate as separate parts, and the pot once
/// more as a note of each object, which PrusaSlicer keeps where it keeps no metadata. No other
/// setting. No dates, no random ids: equal contents give equal bytes.
Result<std::string> pack_3mf(const ModelPart& model, const FileContents& contents);

/// glTF 2.0 in one binary file: metres, y up, a clay or a glaze (KHR_materials_clearcoat), `notes`
/// in the asset's extras. The mesh is compressed by Draco (KHR_draco_mesh_compression) or by
/// meshoptimizer (EXT_meshopt_compression; points of 16 bits, or float32 where these are too few),
/// on the coarsest grid that keeps `draco.max_error_mm` with all roundings, and the accessors state
/// the counts and bounds of the decoded mesh. `core`: float32 points and uint32 indices. With
/// `wall_mm`, vertices have the wall map as COLOR_0, in linear light. Errors as for `encode_drc`;
/// meshoptimizer also needs a triangle at every point. `bad_input` for an unknown material.
Result<std::string> encode_glb(const TriangleMesh& mesh, const FileContents& contents);

/// Name in messages of `ReadOptions::repair`, and of the repair of the mesh that follows.
inline constexpr const char* kByRepair = "a repair";

/// Input that a reader accepts beyond its format.
struct ReadOptions {
  /// Of a binary STL whose size differs from the size that its count requires: the complete facets
  /// in it. Without the faces of an OBJ of fewer than 3 corners, and the triangles of a 3MF that
  /// use a vertex twice.
  bool repair = false;
  /// Gets a line for each kind of fault that was passed over, none of which changes the surface.
  /// May be null.
  std::vector<std::string>* notes = nullptr;
  /// Set if PrusaSlicer reads fewer triangles from the same file, or refuses it. May be null.
  bool* slicer_reads_less = nullptr;
};

/// The mesh as the file states it, without repairs: 1 to 20 million triangles, float32 points
/// within 1e6 mm (-0 read as 0), indices in range. A file is at most 1 GiB. Errors are of kind
/// `bad_input`, or `io` if there is not enough memory; each begins with `name`: "NAME: facet 12:
/// ...", "NAME:34: ..."; facets, faces and lines count from 1.
Result<TriangleMesh> decode_mesh(std::string_view bytes, MeshFormat format, std::string_view name,
                                 const ReadOptions& options = {});

/// A file that is read sequentially.
struct ByteSource {
  /// Fills the span from its start with the next bytes; returns their number, 0 at the end.
  std::function<Result<std::size_t>(std::span<char>)> read;
  std::uint64_t size = 0;  ///< of the whole file
  /// May be empty. Called with the estimated number of triangles, by the file's size, before memory
  /// is allocated for them; an error that it returns ends the reading.
  std::function<Result<void>(std::uint64_t triangles)> announce;
};

/// More than 20 million triangles take as text, except in unusual files.
inline constexpr std::uint64_t kMaxTextBytes = std::uint64_t{8} << 30;

/// Read an STL or OBJ file like `decode_stl` and `decode_obj`, but hold only one or two megabytes
/// of it in memory, or its longest line; text may have up to kMaxTextBytes. Errors of the source
/// are passed on. `read_mesh` takes either format.
Result<TriangleMesh> read_mesh(const ByteSource& source, MeshFormat streamed, std::string_view name,
                               const ReadOptions& options = {});
Result<TriangleMesh> read_stl(const ByteSource& source, std::string_view name,
                              const ReadOptions& options = {});
Result<TriangleMesh> read_obj(const ByteSource& source, std::string_view name,
                              const ReadOptions& options = {});

/// A file of exactly the size that its count requires is binary, even if it begins with "solid";
/// any other file must be complete text from "solid" to "endsolid"; for repairs, the last endsolid
/// may be missing. The solids of a text file make one mesh.
/// Corners with equal float32 coordinates are welded. Normals are not used: binary ones and
/// attributes are ignored, text ones must be numbers; infinite ones and NaN get a note.
Result<TriangleMesh> decode_stl(std::string_view bytes, std::string_view name,
                                const ReadOptions& options = {});

/// Reads v, vt, vn and f, with polygons (up to 65536 corners) as triangles: a fan from the first
/// corner where that covers the polygon, otherwise its constrained Delaunay triangulation, and with
/// a note a fan if the polygon crosses or touches itself. So do PLY and OFF. Ignores o, g, s,
/// mtllib, usemtl, l, p and comments, and opens no other file. Indices are kept: coincident points
/// stay separate. Passed over with a note: texture coordinates and normals that a face names and
/// the file does not define ("f 1/ 2/ 3/" names none), and unknown statements before the first v,
/// vt, vn or f or after the last. One between them, or one of a free-form surface, is an error.
Result<TriangleMesh> decode_obj(std::string_view bytes, std::string_view name,
                                const ReadOptions& options = {});

/// Triangle meshes of Draco 1.0 to 2.2; point clouds are refused. The format has no checksum: a
/// damaged file may decode to another mesh. Files with claims of Claystack (`drc_claims`) have one,
/// and are refused if it does not match.
Result<TriangleMesh> decode_drc(std::string_view bytes, std::string_view name);
/// The number of triangles that a Draco file states, 1 to 20 million, before any of it is decoded:
/// for an estimate of the memory. Errors as for `decode_drc`.
Result<std::size_t> drc_triangles(std::string_view bytes, std::string_view name);

/// PLY 1.0 as text or binary of either byte order. Vertices need the properties x, y and z of any
/// number type; faces a list `vertex_indices` or `vertex_index`, of up to 65536 corners. Other
/// properties and elements are passed over, and with a note lines before the first element that
/// begin with no keyword of PLY. Every count is compared with the size of the file before memory is
/// allocated.
Result<TriangleMesh> decode_ply(std::string_view bytes, std::string_view name,
                                const ReadOptions& options = {});

/// OFF as text, also with colours, normals or texture coordinates (COFF, NOFF, STOFF and their
/// combinations), which are passed over, and with a note without the keyword. Binary OFF, and
/// points of 4 or n dimensions, are refused.
Result<TriangleMesh> decode_off(std::string_view bytes, std::string_view name,
                                const ReadOptions& options = {});

/// The build of a 3MF package (core specification 1.3), with all items, components and transforms,
/// in mm. Strict: refuses what the specification forbids, other start parts than one model, DTDs,
/// required extensions other than materials and production, references to objects that are not
/// defined before, triangles that use a vertex twice. Objects may be in other model parts, to which
/// the start part has a relationship, in the unit of the start part (production). An archive
/// that unpacks to more than 100 times its size (above 32 MiB), has more than 10 000 entries,
/// components nested more than 32 deep, or a build of more than 64 times the triangles in the file
/// (above a million) is refused. Other namespaces are passed over. Objects of type `support` and
/// items with `printable="0"` are not part of the mesh; a note says so.
Result<TriangleMesh> decode_3mf(std::string_view bytes, std::string_view name,
                                const ReadOptions& options = {});
/// The same of the start part alone.
Result<TriangleMesh> decode_3mf_model(std::string_view xml, std::string_view name,
                                      const ReadOptions& options = {});

/// glTF 2.0 in one binary file: the triangles (lists, strips, fans) of all nodes of its scene, in
/// mm and z up; equal corners are welded. Points are float32 or (KHR_mesh_quantization) whole
/// numbers of 8 or 16 bits, indices of any type; both may be compressed by Draco or meshoptimizer.
/// Refused: other required extensions except those of materials, textures and lights, sparse
/// points, other buffers than the file's own, views that unpack to more than 1 GiB together, nodes
/// in a cycle or nested more than 32 deep, JSON of more than 16 MiB or 32 levels, and a scene of
/// more than 64 times the triangles in the file (above a million) or its points (above three
/// million). Not applied, with a note: morph weights, skeletons, and the instances of
/// EXT_mesh_gpu_instancing. Passed over with a note: points and lines. A file without scenes: all
/// its root nodes.
Result<TriangleMesh> decode_glb(std::string_view bytes, std::string_view name,
                                const ReadOptions& options = {});

/// Parts that Claystack put into a 3MF beside the mesh; empty: not there.
struct PackedParts {
  std::string pot;          ///< a pot file; from the metadata or a note if a slicer kept only that
  std::string certificate;  ///< of the model part
};
Result<PackedParts> parts_in_3mf(std::string_view bytes, std::string_view name);
/// The model part, of at most 1 GiB.
Result<std::string> model_in_3mf(std::string_view bytes, std::string_view name);

/// The mesh with coordinates rounded to float32, as files store it.
[[nodiscard]] TriangleMesh rounded_to_float(const TriangleMesh& mesh);

// ---- drc claims ----------------------------------------------------------------------
// The claims of a Draco file written by Claystack about its solid, as metadata that other decoders
// ignore:
//   claystack.volume_mm3, .volume_bound_mm3, .counted_volume_mm3, .vertex_error_mm   float64
//   claystack.checksum   XXH3-128 of the file without these 32 hexadecimal digits

/// Finite and not negative.
struct DracoClaims {
  double volume_mm3 = 0.0;          ///< of the solid before it was encoded
  double volume_bound_mm3 = 0.0;    ///< the decoded mesh's volume is within this of `volume_mm3`
  double counted_volume_mm3 = 0.0;  ///< of the stack from which the solid was made
  double vertex_error_mm = 0.0;     ///< maximum displacement of a vertex

  friend bool operator==(const DracoClaims&, const DracoClaims&) = default;
};

/// The claims of the file, after its checksum was verified; empty for files of other programs.
/// Errors as for `decode_drc`: header, metadata and checksum are checked, not the mesh.
Result<std::optional<DracoClaims>> drc_claims(std::string_view bytes, std::string_view name);

// ---- file store ----------------------------------------------------------------------
// The destination of a file's bytes, from which they can be read back for verification.

class FileStore {
 public:
  virtual ~FileStore() = default;
  /// Appends. After an error, nothing more is written.
  virtual Result<void> write(std::span<const std::byte> bytes) = 0;
  /// False if written bytes cannot be read back (a pipe): then nothing is read.
  [[nodiscard]] virtual bool rereadable() const noexcept = 0;
  /// Fills `bytes` with the bytes written from `offset` on; callable from several threads at once.
  /// Fails beyond the end.
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

/// A drawing of the pot cut through its axis, to scale, with height, diameter and a scale bar [mm].
/// A collapsed pot is drawn at rest, seen with the HIP to the right, with its path of fall dashed.
std::string section_svg(const Pot& pot);

}  // namespace clay::solid::inline formats
