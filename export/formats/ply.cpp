#include "claystack/export/formats.hpp"
#include "core/cancel.hpp"
#include "core/little_endian.hpp"
#include "core/text.hpp"
#include "export/formats/byte_stream.hpp"
#include "export/formats/file_floats.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/ply_header.hpp"
#include "export/formats/point_merging.hpp"
#include "export/formats/polygon_faces.hpp"
#include "export/formats/text_scanner.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace clay::solid::inline formats {
namespace ply {
namespace {

/// The numbers after the header of a binary file.
class BinaryNumbers {
 public:
  BinaryNumbers(std::string_view file, const Header& header, std::string_view name)
      : file_(file),
        name_(name),
        at_(header.bytes),
        big_(header.encoding == Encoding::big_endian) {}

  float coordinate(Number type) {
    const double value = number(type);
    const auto rounded = static_cast<float>(value);
    if (is_coordinate(rounded)) return rounded;
    fail(std::string("expected ").append(kCoordinateRule) + ", found " + number_text(value));
    return 0.0F;
  }
  long long whole(Number type) { return static_cast<long long>(number(type)); }
  void skip(Number type) { (void)take(bytes_of(type)); }

  void begin(std::string_view element, std::uint64_t index) { element_ = element, index_ = index; }
  void fail(const std::string& what) {
    if (fault_) return;
    fault_ = bad_file(name_, std::string(element_) + " " + std::to_string(index_ + 1) + ": " + what)
                 .value();
  }
  void expect_end() {
    const std::size_t end = file_.find_last_not_of(" \t\r\n") + 1;
    if (fault_ || at_ >= std::min(end, file_.size())) return;
    fault_ = bad_file(name_, "expected the end of the file after its elements, found " +
                                 counted(file_.size() - at_, "more byte"))
                 .value();
  }
  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }
  static void add_notes(std::vector<std::string>*) {}  // numbers that are not needed are not read

 private:
  std::string_view take(std::size_t bytes) {
    if (file_.size() - at_ < bytes) {
      fail("the file ends early");
      return {};
    }
    at_ += bytes;
    return file_.substr(at_ - bytes, bytes);
  }

  double number(Number type) {
    std::array<char, 8> bytes{};
    const std::string_view found = take(bytes_of(type));
    std::ranges::copy(found, bytes.begin());
    if (big_ != (std::endian::native == std::endian::big))
      std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes_of(type)));
    switch (type) {
      case Number::int8:
        return as<std::int8_t>(bytes);
      case Number::uint8:
        return as<std::uint8_t>(bytes);
      case Number::int16:
        return as<std::int16_t>(bytes);
      case Number::uint16:
        return as<std::uint16_t>(bytes);
      case Number::int32:
        return as<std::int32_t>(bytes);
      case Number::uint32:
        return as<std::uint32_t>(bytes);
      case Number::float32:
        return double{as<float>(bytes)};
      case Number::float64:
        break;
    }
    return as<double>(bytes);
  }

  template <class Value>
  static Value as(const std::array<char, 8>& bytes) {
    Value value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  std::string_view file_, name_;
  std::size_t at_;
  bool big_;
  std::string_view element_;
  std::uint64_t index_ = 0;
  std::optional<Error> fault_;
};

/// The numbers after the header of a text.
class TextNumbers {
 public:
  TextNumbers(ByteStream& text, const Header& header, std::string_view name)
      : scanner_(text, name, LineRule::plain) {
    for (std::size_t line = 0; line < header.lines; ++line) scanner_.skip_line();
  }

  float coordinate(Number) { return scanner_.coordinate(scanner_.word()); }
  long long whole(Number) { return scanner_.whole_number(scanner_.word()); }
  void skip(Number) { scanner_.unused_number(scanner_.word()); }
  void begin(std::string_view, std::uint64_t) {}
  void fail(const std::string& what) { scanner_.fail(what); }
  void expect_end() {
    if (const auto rest = scanner_.word(); !rest.empty())
      scanner_.fail_expected("the end of the file after its elements", rest);
  }
  [[nodiscard]] const std::optional<Error>& fault() const { return scanner_.fault(); }
  void add_notes(std::vector<std::string>* notes) const { scanner_.note_not_finite(notes); }

 private:
  TextScanner scanner_;
};

constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};

const Element* element_named(const Header& header, std::string_view name) {
  const auto found = std::ranges::find(header.elements, name, &Element::name);
  return found == header.elements.end() ? nullptr : &*found;
}

bool is_corner_list(const Property& property) {
  return (property.name == "vertex_indices" || property.name == "vertex_index") &&
         property.count_type && is_whole(property.type);
}

/// The elements that make a mesh, with the properties that it needs, each once.
Result<void> check_elements(const Header& header, std::string_view name) {
  const Element* const vertices = element_named(header, "vertex");
  const Element* const faces = element_named(header, "face");
  if (vertices == nullptr || faces == nullptr)
    return bad_file(name, "expected the elements vertex and face of a mesh, found no " +
                              std::string(vertices == nullptr ? "vertex" : "face"));
  const auto once = [&](const Element& element, auto fits, std::string_view what) -> Result<void> {
    if (std::ranges::count_if(element.properties, fits) == 1) return {};
    return failure(ErrorKind::bad_input, std::string(name) + ":" + std::to_string(element.line) +
                                             ": expected one property " + std::string(what));
  };
  for (const std::string_view axis : kAxes)
    if (auto found = once(
            *vertices, [&](const Property& p) { return p.name == axis && !p.count_type; }, axis);
        !found)
      return found;
  if (vertices->count > kMaxPoints)
    return bad_file(name, expected_at_most(kMaxPoints, "vertices") + ", found " +
                              std::to_string(vertices->count));
  if (faces->count > kMaxTriangles)
    return bad_file(name, expected_at_most(kMaxTriangles, "triangles") + ", found " +
                              std::to_string(faces->count));
  return once(*faces, is_corner_list, "vertex_indices or vertex_index, a list of whole numbers");
}

template <class Numbers>
class BodyReader {
 public:
  BodyReader(const Header& header, Numbers numbers)
      : header_(header), numbers_(std::move(numbers)) {}

  Result<TriangleMesh> read(std::string_view name, std::vector<std::string>* notes) {
    points_ = static_cast<long long>(element_named(header_, "vertex")->count);
    mesh_.points.reserve(static_cast<std::size_t>(points_));
    mesh_.triangles.reserve(element_named(header_, "face")->count);
    for (const Element& element : header_.elements) read_all(element);
    numbers_.expect_end();
    if (numbers_.fault()) return tl::make_unexpected(*numbers_.fault());
    numbers_.add_notes(notes);
    polygons_.split(mesh_, notes);
    share_equal_points(mesh_, notes);
    return check_facet_count(mesh_.triangles.size(), name).map([&] { return std::move(mesh_); });
  }

 private:
  void read_all(const Element& element) {
    const bool vertex = element.name == "vertex", face = element.name == "face";
    for (std::uint64_t i = 0; i < element.count && !numbers_.fault(); ++i) {
      step_of_loop();
      numbers_.begin(element.name, i);
      glm::vec3 point{0.0F};
      for (const Property& property : element.properties) {
        const auto axis = std::ranges::find(kAxes, property.name) - kAxes.begin();
        if (vertex && axis < 3 && !property.count_type)
          point[static_cast<int>(axis)] = numbers_.coordinate(property.type);
        else if (face && is_corner_list(property))
          read_face(property);
        else
          skip(property);
      }
      if (vertex) mesh_.points.emplace_back(point + 0.0F);  // -0 + 0 is 0
    }
  }

  void skip(const Property& property) {
    const long long count = property.count_type ? numbers_.whole(*property.count_type) : 1;
    if (count < 0) numbers_.fail("expected a list of 0 or more, found " + std::to_string(count));
    for (long long i = 0; i < count && !numbers_.fault(); ++i) numbers_.skip(property.type);
  }

  void read_face(const Property& property) {
    const long long corners = numbers_.whole(*property.count_type);
    if (corners < 3 || corners > static_cast<long long>(kMaxFaceCorners))
      return numbers_.fail("expected a face of 3 to " + std::to_string(kMaxFaceCorners) +
                           " corners, found " + std::to_string(corners));
    if (mesh_.triangles.size() + static_cast<std::size_t>(corners) > kMaxTriangles + 2)
      return numbers_.fail(expected_at_most(kMaxTriangles, "triangles"));
    corners_.clear();
    for (long long i = 0; i < corners; ++i) {
      const long long index = numbers_.whole(property.type);
      if (index < 0 || index >= points_)
        numbers_.fail(expected_number("a vertex", 0, static_cast<std::size_t>(points_)) +
                      ", found " + std::to_string(index));
      corners_.push_back(static_cast<std::uint32_t>(index));
    }
    if (numbers_.fault()) return;
    polygons_.add(corners_, mesh_);
  }

  const Header& header_;
  Numbers numbers_;
  long long points_ = 0;
  TriangleMesh mesh_;
  PolygonFaces polygons_;
  std::vector<std::uint32_t> corners_;
};

Result<TriangleMesh> read_body(std::string_view bytes, const Header& header, std::string_view name,
                               std::vector<std::string>* notes) {
  if (header.encoding != Encoding::text)
    return BodyReader(header, BinaryNumbers(bytes, header, name)).read(name, notes);
  const ByteSource source = source_of(bytes);
  ByteStream stream(source);
  return BodyReader(header, TextNumbers(stream, header, name)).read(name, notes);
}

}  // namespace
}  // namespace ply

std::string encode_ply(const TriangleMesh& mesh, std::string_view object_name,
                       std::span<const float> wall_mm) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment claystack: units mm\n";
  text.append("comment ").append(one_line(object_name)).append("\n");
  if (!wall_mm.empty()) text += "comment thickness: of the wall, in mm\n";
  text += "element vertex " + std::to_string(mesh.points.size()) +
          "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!wall_mm.empty()) text += "property float thickness\n";
  text += "element face " + std::to_string(mesh.triangles.size()) +
          "\nproperty list uchar int vertex_indices\nend_header\n";
  const std::size_t point_bytes = wall_mm.empty() ? 12 : 16;
  constexpr std::size_t kFaceBytes = 13;
  std::size_t at = text.size();
  text.resize(at + point_bytes * mesh.points.size() + kFaceBytes * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i, at += point_bytes) {
    step_of_loop();
    const glm::vec3 point = file_point(mesh.points[i]);
    for (int axis = 0; axis < 3; ++axis)
      store_f32(&text[at + 4 * static_cast<std::size_t>(axis)], point[axis]);
    if (!wall_mm.empty()) store_f32(&text[at + 12], wall_mm[i]);
  }
  for (const auto& triangle : mesh.triangles) {
    step_of_loop();
    text[at] = 3;
    for (std::size_t corner = 0; corner < 3; ++corner)
      store_u32(&text[at + 1 + 4 * corner], triangle[corner]);
    at += kFaceBytes;
  }
  return text;
}

Result<TriangleMesh> decode_ply(std::string_view bytes, std::string_view name,
                                const ReadOptions& options) {
  return check_file_size(bytes, name).and_then([&] {
    return guarded(name, [&] {
      return ply::read_header(bytes, name).and_then([&](const ply::Header& header) {
        if (header.stray_lines > 0 && options.notes != nullptr)
          options.notes->push_back(
              stray_lines_note(header.stray_line, header.stray_lines, "before"));
        return ply::check_elements(header, name).and_then([&] {
          return ply::read_body(bytes, header, name, options.notes);
        });
      });
    });
  });
}

}  // namespace clay::solid::inline formats
