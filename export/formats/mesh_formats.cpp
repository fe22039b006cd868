#include "claystack/export/formats.hpp"

#include "core/text.hpp"
#include "export/formats/file_floats.hpp"
#include "export/formats/text_scanner.hpp"

#include <algorithm>
#include <new>
#include <vector>

namespace clay::solid::inline formats {

static_assert([] {
  for (std::size_t i = 0; i < kFormatFacts.size(); ++i)
    if (static_cast<std::size_t>(kFormatFacts[i].format) != i) return false;
  return true;
}());

std::string format_endings(FormatUse use, std::string_view last) {
  std::vector<std::string_view> endings;
  for (const FormatFacts& facts : kFormatFacts)
    if (!facts.ending.empty() && (use == FormatUse::read || facts.written) &&
        std::ranges::find(endings, facts.ending) == endings.end())
      endings.push_back(facts.ending);
  std::string text(endings.front());
  for (std::size_t i = 1; i < endings.size(); ++i)
    text.append(i + 1 < endings.size() ? ", " : last).append(endings[i]);
  return text;
}

Result<MeshFormat> mesh_format_of(std::string_view path, FormatUse use) {
  const std::size_t dot = path.rfind('.');
  const std::string_view ending = dot == path.npos ? "" : path.substr(dot);
  for (const FormatFacts& facts : kFormatFacts)
    if (!facts.ending.empty() && (use == FormatUse::read || facts.written) &&
        equal_ignoring_case(ending, facts.ending))
      return facts.format;
  return failure(
      ErrorKind::bad_input,
      std::string(path).append(": expected a name that ends in ").append(format_endings(use)));
}

Result<MeshFormat> mesh_format_named(std::string_view name) {
  for (const FormatFacts& facts : kFormatFacts)
    if (facts.name == name) return facts.format;
  return failure(ErrorKind::bad_input,
                 std::string("expected the name of a mesh format, found ").append(name));
}

namespace {

Result<std::string> encoded(const TriangleMesh& mesh, MeshFormat format,
                            const FileContents& contents) {
  switch (format) {
    case MeshFormat::stl_binary:
      return encode_stl_binary(mesh);
    case MeshFormat::stl_ascii:
      return encode_stl_ascii(mesh, contents.name);
    case MeshFormat::obj:
      return encode_obj(mesh, contents.name);
    case MeshFormat::drc:
      return encode_drc(mesh, contents.draco);
    case MeshFormat::ply:
      return encode_ply(mesh, contents.name, contents.wall_mm);
    case MeshFormat::three_mf:
      return pack_3mf(encode_3mf_model(mesh, contents), contents);
    case MeshFormat::glb:
      return encode_glb(mesh, contents);
    case MeshFormat::off:
    case MeshFormat::three_mf_model:
      break;
  }
  return failure(ErrorKind::bad_input,
                 std::string("cannot write the format ").append(facts_of(format).name));
}

/// Enough for known_kind.
constexpr std::size_t kHeadBytes = 4096;

std::string_view kind_of(std::string_view head, std::uint64_t file_bytes) {
  if (file_bytes == 0) return "an empty file";
  if (const auto kind = known_kind(head); !kind.empty()) return kind;
  return is_binary_stl(head, file_bytes) ? "an STL mesh" : "";
}

/// The error of a reader; for a file that is empty or of another kind, an error that states this.
Error kind_stated(Error error, std::string_view head, std::uint64_t file_bytes, MeshFormat format,
                  std::string_view name) {
  const FormatFacts& facts = facts_of(format);
  if (error.kind != ErrorKind::bad_input || facts.ending.empty()) return error;
  const std::string_view kind = kind_of(head, file_bytes);
  if (kind.empty() || kind.find(facts.title) != std::string_view::npos) return error;
  const bool vowel = facts.title[0] == 'S' || facts.title[0] == 'O';  // as pronounced
  return {error.kind, std::string(name)
                          .append(vowel ? ": expected an " : ": expected a ")
                          .append(facts.title)
                          .append(" file, found ")
                          .append(kind)};
}

Result<TriangleMesh> decode_as(MeshFormat format, std::string_view bytes, std::string_view name,
                               const ReadOptions& options) {
  switch (format) {
    case MeshFormat::stl_binary:
    case MeshFormat::stl_ascii:
      return decode_stl(bytes, name, options);
    case MeshFormat::obj:
      return decode_obj(bytes, name, options);
    case MeshFormat::drc:
      return decode_drc(bytes, name);
    case MeshFormat::ply:
      return decode_ply(bytes, name, options);
    case MeshFormat::off:
      return decode_off(bytes, name, options);
    case MeshFormat::three_mf:
      return decode_3mf(bytes, name, options);
    case MeshFormat::three_mf_model:
      return decode_3mf_model(bytes, name, options);
    case MeshFormat::glb:
      return decode_glb(bytes, name, options);
  }
  return failure(ErrorKind::bad_input, std::string(name).append(": unknown mesh format"));
}

}  // namespace

Result<std::string> encode_mesh(const TriangleMesh& mesh, MeshFormat format,
                                const FileContents& contents) try {
  return encoded(mesh, format, contents);
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::io,
                 std::string("not enough memory for the mesh as ").append(facts_of(format).name));
}

Result<TriangleMesh> decode_mesh(std::string_view bytes, MeshFormat format, std::string_view name,
                                 const ReadOptions& options) {
  return decode_as(format, bytes, name, options).map_error([&](Error error) {
    return kind_stated(std::move(error), bytes, bytes.size(), format, name);
  });
}

Result<TriangleMesh> read_mesh(const ByteSource& source, MeshFormat streamed, std::string_view name,
                               const ReadOptions& options) {
  std::string head;
  ByteSource watched = source;
  watched.read = [&](std::span<char> part) {
    auto count = source.read(part);
    if (count && head.size() < kHeadBytes)
      head.append(part.data(), std::min(*count, kHeadBytes - head.size()));
    return count;
  };
  auto mesh = streamed == MeshFormat::obj ? read_obj(watched, name, options)
                                          : read_stl(watched, name, options);
  return std::move(mesh).map_error([&](Error error) {
    return kind_stated(std::move(error), head, source.size, streamed, name);
  });
}

TriangleMesh rounded_to_float(const TriangleMesh& mesh) {
  TriangleMesh rounded = mesh;
  for (glm::dvec3& point : rounded.points) point = file_point(point);
  return rounded;
}

}  // namespace clay::solid::inline formats
