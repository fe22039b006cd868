#include "claystack/export/formats.hpp"
#include "core/cancel.hpp"
#include "export/formats/byte_stream.hpp"
#include "export/formats/file_floats.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/text_scanner.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

namespace clay::solid::inline formats {
namespace {

constexpr std::size_t kMaxFaceCorners = 4096;
constexpr std::size_t kUsualPointBytes = 36;
constexpr std::size_t kUsualTriangleBytes = 26;

/// The vertices of one kind (v, vt or vn). A face may use one that a later line defines, so the
/// largest index is checked at the end of the file.
struct VertexList {
  std::string_view keyword;
  std::size_t count = 0;
  std::size_t highest_used = 0;
  std::size_t line_of_highest = 0;
};

/// A face's corner: "v", "v/vt", "v//vn" or "v/vt/vn".
struct CornerWords {
  std::string_view point;
  std::optional<std::string_view> texture;
  std::optional<std::string_view> normal;
};

CornerWords split_corner(std::string_view word) {
  const std::size_t first = word.find('/');
  CornerWords words{word.substr(0, first), {}, {}};
  if (first == word.npos) return words;
  const std::string_view rest = word.substr(first + 1);
  const std::size_t second = rest.find('/');
  if (second != 0) words.texture = rest.substr(0, second);
  if (second != rest.npos) words.normal = rest.substr(second + 1);
  return words;
}

class ObjReader {
 public:
  ObjReader(ByteStream& text, std::string_view name)
      : scanner_(text, name, LineRule::backslash_continues), name_(name) {}

  Result<TriangleMesh> read() {
    for (auto keyword = scanner_.word(); !keyword.empty(); keyword = scanner_.word()) {
      read_statement(keyword);
    }
    for (const VertexList* list : {&points_, &textures_, &normals_}) check_highest(*list);
    if (scanner_.fault()) return tl::make_unexpected(*scanner_.fault());
    return check_facet_count(mesh_.triangles.size(), name_).map([&] { return std::move(mesh_); });
  }

 private:
  void read_statement(std::string_view keyword) {
    // Names, groups, materials, smoothing, lines and points are not part of the surface. A material
    // library is another file, which a mesh must not make the program open.
    static constexpr std::array<std::string_view, 7> kPassedOver = {"o",      "g", "s", "mtllib",
                                                                    "usemtl", "l", "p"};
    if (keyword == "v") {
      read_point();
    } else if (keyword == "f") {
      read_face();
    } else if (keyword == "vt") {
      read_numbers(1, 3);
      count(textures_);
    } else if (keyword == "vn") {
      read_numbers(3, 3);
      count(normals_);
    } else if (keyword.starts_with('#')) {
      scanner_.skip_comment();
    } else if (std::ranges::find(kPassedOver, keyword) != kPassedOver.end()) {
      scanner_.skip_line();
    } else {
      scanner_.fail_expected("a statement of a polygon mesh", keyword);
    }
  }

  /// "v x y z", optionally followed by w, or by red, green and blue, which are ignored.
  void read_point() {
    glm::vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      point[axis] = scanner_.coordinate(scanner_.word_in_line());
    }
    if (read_numbers(0, 3) == 2) scanner_.fail("expected v with 3, 4 or 6 numbers, found 5");
    count(points_);
    mesh_.points.emplace_back(point + 0.0F);  // -0 + 0 is 0
  }

  /// Reads finite numbers up to the end of the line; returns their count.
  std::size_t read_numbers(std::size_t fewest, std::size_t most) {
    std::size_t found = 0;
    for (auto word = scanner_.word_in_line(); !word.empty(); word = scanner_.word_in_line()) {
      scanner_.finite_number(word);
      if (++found > most) scanner_.fail_expected("the end of the line", word);
    }
    if (found < fewest) scanner_.fail_expected("a number", {});
    return found;
  }

  void count(VertexList& list) {
    if (++list.count > kMaxPoints) scanner_.fail("expected at most 60000000 vertices");
  }

  void read_face() {
    corners_.clear();
    for (auto word = scanner_.word_in_line(); !word.empty(); word = scanner_.word_in_line()) {
      const CornerWords words = split_corner(word);
      corners_.push_back(resolve(words.point, points_));
      if (words.texture) resolve(*words.texture, textures_);
      if (words.normal) resolve(*words.normal, normals_);
      if (corners_.size() > kMaxFaceCorners)
        scanner_.fail("expected a face of at most 4096 corners");
    }
    if (corners_.size() < 3)
      scanner_.fail("expected a face of at least 3 corners, found " +
                    std::to_string(corners_.size()));
    if (mesh_.triangles.size() + corners_.size() > kMaxTriangles + 2)
      scanner_.fail("expected at most 20000000 triangles");
    if (scanner_.fault()) return;
    for (std::size_t i = 2; i < corners_.size(); ++i) {
      mesh_.triangles.push_back({corners_[0], corners_[i - 1], corners_[i]});
    }
  }

  /// Converts to an index from 0. In the file indices count from 1; negative ones count back from
  /// the latest vertex.
  std::uint32_t resolve(std::string_view word, VertexList& list) {
    const long long number = scanner_.whole_number(word);
    const auto known = static_cast<long long>(list.count);
    if (number == 0 || number < -known || number > static_cast<long long>(kMaxPoints)) {
      refuse_number(number, list, scanner_.line());
      return 0;
    }
    if (number < 0) return static_cast<std::uint32_t>(known + number);
    const auto used = static_cast<std::size_t>(number);
    if (used > list.highest_used) {
      list.highest_used = used;
      list.line_of_highest = scanner_.line();
    }
    return static_cast<std::uint32_t>(used - 1);
  }

  void check_highest(const VertexList& list) {
    if (list.highest_used <= list.count) return;
    refuse_number(static_cast<long long>(list.highest_used), list, list.line_of_highest);
  }

  void refuse_number(long long number, const VertexList& list, std::size_t line) {
    scanner_.fail_at(line, "expected the number of one of " + std::to_string(list.count) + " " +
                               std::string(list.keyword) + ", found " + std::to_string(number));
  }

  TextScanner scanner_;
  std::string_view name_;
  VertexList points_{"v"};
  VertexList textures_{"vt"};
  VertexList normals_{"vn"};
  TriangleMesh mesh_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

std::string encode_obj(const TriangleMesh& mesh, std::string_view object_name) {
  std::string text;
  text.reserve(kUsualPointBytes * mesh.points.size() + kUsualTriangleBytes * mesh.triangles.size() +
               512);
  text.append("# claystack: units mm\no ").append(one_line(object_name)).append("\n");
  for (const glm::dvec3& point : mesh.points) {
    step_of_loop();
    append_point_line(text, "v", file_point(point));
  }
  for (const auto& triangle : mesh.triangles) {
    step_of_loop();
    text += 'f';
    for (const std::uint32_t index : triangle) {
      text += ' ';
      append_number(text, std::uint64_t{index} + 1);
    }
    text += '\n';
  }
  return text;
}

Result<TriangleMesh> read_obj(const ByteSource& source, std::string_view name) {
  // A closed mesh has half as many points as triangles.
  constexpr std::size_t kUsualBytes = kUsualTriangleBytes + kUsualPointBytes / 2;
  return guarded(name, [&] {
    return check_text_size(source, kUsualBytes, name).and_then([&] {
      ByteStream stream(source);
      return ObjReader(stream, name).read();
    });
  });
}

Result<TriangleMesh> decode_obj(std::string_view bytes, std::string_view name) {
  return check_file_size(bytes, name).and_then([&] { return read_obj(source_of(bytes), name); });
}

}  // namespace clay::solid::inline formats
