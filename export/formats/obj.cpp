#include "claystack/export/formats.hpp"
#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/formats/byte_stream.hpp"
#include "export/formats/file_floats.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/point_merging.hpp"
#include "export/formats/polygon_faces.hpp"
#include "export/formats/text_scanner.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <optional>

namespace clay::solid::inline formats {
namespace {

constexpr std::size_t kUsualPointBytes = 36;
constexpr std::size_t kUsualTriangleBytes = 26;

/// The vertices of one kind (v, vt or vn). A face may use one that a later line defines, so the
/// largest index is checked at the end of the file.
struct VertexList {
  std::string_view keyword;
  std::size_t count = 0;
  std::size_t highest_used = 0;
  std::size_t line_of_highest = 0;
  std::size_t bad_line = 0;  ///< the first line with an invalid index; 0: none
};

/// Lines of one kind, and the first of them.
struct Lines {
  std::size_t count = 0, first = 0;
  void add(std::size_t line) {
    if (count++ == 0) first = line;
  }
};

/// A face's corner: "v", "v/vt", "v//vn" or "v/vt/vn". Some programs write the slashes without the
/// numbers.
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
  const auto given = [](std::string_view number) {
    return number.empty() ? std::optional<std::string_view>() : number;
  };
  words.texture = given(rest.substr(0, second));
  if (second != rest.npos) words.normal = given(rest.substr(second + 1));
  return words;
}

class ObjReader {
 public:
  ObjReader(ByteStream& text, std::string_view name, const ReadOptions& options)
      : scanner_(text, name, LineRule::comments_and_continuation, kLongLineKib),
        name_(name),
        options_(options) {}

  Result<TriangleMesh> read() {
    for (auto keyword = scanner_.word(); !keyword.empty(); keyword = scanner_.word()) {
      read_statement(keyword);
    }
    if (points_.highest_used > points_.count)
      refuse_number(static_cast<long long>(points_.highest_used), points_.line_of_highest);
    if (scanner_.fault()) return tl::make_unexpected(*scanner_.fault());
    polygons_.split(mesh_, options_.notes);
    share_equal_points(mesh_, options_.notes);
    note_faults();
    return check_facet_count(mesh_.triangles.size(), name_).map([&] { return std::move(mesh_); });
  }

 private:
  void read_statement(std::string_view keyword) {
    // Names, groups, materials, smoothing, lines and points are not part of the surface. A material
    // library is another file: a mesh must not cause the program to open it.
    static constexpr std::array<std::string_view, 7> kPassedOver = {"o",      "g", "s", "mtllib",
                                                                    "usemtl", "l", "p"};
    const bool mesh = keyword == "v" || keyword == "f" || keyword == "vt" || keyword == "vn";
    if (mesh && trailing_.count > 0)
      return scanner_.fail_at(trailing_.first,
                              "expected a statement of a polygon mesh, found " + trailing_word_);
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
    } else if (std::ranges::find(kPassedOver, keyword) != kPassedOver.end()) {
      scanner_.skip_line();
    } else {
      read_unknown(keyword);
    }
  }

  /// Lines of text that a program put before or after the mesh.
  void read_unknown(std::string_view keyword) {
    const bool begun =
        points_.count + textures_.count + normals_.count + mesh_.triangles.size() > 0;
    // Curves and surfaces: without them, the mesh would not be the whole surface in the file.
    static constexpr std::array<std::string_view, 14> kFreeForm = {
        "vp",   "cstype", "deg",  "bmat", "step", "curv", "curv2",
        "surf", "parm",   "trim", "hole", "scrv", "sp",   "con"};
    const auto is = [&](std::string_view word) { return equal_ignoring_case(keyword, word); };
    const bool surface = std::ranges::find(kFreeForm, keyword) != kFreeForm.end() || is("v") ||
                         is("f") || is("vt") || is("vn");
    if (begun && (surface || mesh_.triangles.empty()))
      return scanner_.fail_expected("a statement of a polygon mesh", keyword);
    if (begun && trailing_.count == 0) trailing_word_ = shown_word(keyword);
    (begun ? trailing_ : header_).add(scanner_.line());
    scanner_.skip_line();
  }

  /// "v x y z", optionally followed by w, or by red, green and blue, which are ignored.
  void read_point() {
    glm::vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      point[axis] = scanner_.coordinate(scanner_.word_in_line());
    }
    if (read_numbers(0, 3) == 2) scanner_.fail("expected v with 3, 4 or 6 numbers, found 5");
    if (scanner_.at_comment()) commented_.add(scanner_.line());
    count(points_);
    mesh_.points.emplace_back(point + 0.0F);  // -0 + 0 is 0
  }

  /// Reads numbers up to the end of the line; returns their count.
  std::size_t read_numbers(std::size_t fewest, std::size_t most) {
    std::size_t found = 0;
    for (auto word = scanner_.word_in_line(); !word.empty(); word = scanner_.word_in_line()) {
      scanner_.unused_number(word);
      if (++found > most) scanner_.fail_expected("the end of the line", word);
    }
    if (found < fewest) scanner_.fail_expected("a number", {});
    return found;
  }

  void count(VertexList& list) {
    if (++list.count > kMaxPoints) scanner_.fail(expected_at_most(kMaxPoints, "vertices"));
  }

  void read_face() {
    corners_.clear();
    const std::size_t line = scanner_.line();
    bool odd = false;
    for (auto word = scanner_.word_in_line(); !word.empty(); word = scanner_.word_in_line()) {
      odd = odd || word.ends_with('/') || scanner_.line() != line;
      const CornerWords words = split_corner(word);
      corners_.push_back(resolve_point(words.point));
      if (words.texture) (void)resolve(*words.texture, textures_);
      if (words.normal) (void)resolve(*words.normal, normals_);
      if (corners_.size() > kMaxFaceCorners)
        return scanner_.fail("expected a face of at most " + std::to_string(kMaxFaceCorners) +
                             " corners");
    }
    if (corners_.size() < 3) return read_short_face(line);
    if (mesh_.triangles.size() + corners_.size() > kMaxTriangles + 2)
      scanner_.fail(expected_at_most(kMaxTriangles, "triangles"));
    if (scanner_.fault()) return;
    if (odd) odd_faces_.add(line);
    if (corners_.size() > 4) refused_faces_.add(line);
    if (scanner_.at_comment()) commented_.add(line);
    polygons_.add(corners_, mesh_);
  }

  void read_short_face(std::size_t line) {
    if (!options_.repair)
      return scanner_.fail("expected a face of at least 3 corners, found " +
                           std::to_string(corners_.size()) + "; " + kByRepair + " leaves it out");
    short_faces_.add(line);
  }

  std::uint32_t resolve_point(std::string_view word) {
    const auto index = resolve(word, points_);
    if (!index) refuse_number(scanner_.whole_number(word), scanner_.line());
    return index.value_or(0);
  }

  /// Converts to an index from 0. In the file indices count from 1; negative ones count back from
  /// the latest vertex.
  std::optional<std::uint32_t> resolve(std::string_view word, VertexList& list) {
    const long long number = scanner_.whole_number(word);
    const auto known = static_cast<long long>(list.count);
    if (number == 0 || number < -known || number > static_cast<long long>(kMaxPoints)) {
      if (list.bad_line == 0) list.bad_line = scanner_.line();
      return std::nullopt;
    }
    if (number < 0) return static_cast<std::uint32_t>(known + number);
    const auto used = static_cast<std::size_t>(number);
    if (used > list.highest_used) {
      list.highest_used = used;
      list.line_of_highest = scanner_.line();
    }
    return static_cast<std::uint32_t>(used - 1);
  }

  void refuse_number(long long number, std::size_t line) {
    scanner_.fail_at(
        line, expected_number("a vertex", 1, points_.count) + ", found " + std::to_string(number));
  }

  void note_faults() {
    if (options_.slicer_reads_less != nullptr)
      *options_.slicer_reads_less = odd_faces_.count + refused_faces_.count + commented_.count > 0;
    if (options_.notes == nullptr) return;
    if (header_.count > 0)
      options_.notes->push_back(stray_lines_note(header_.first, header_.count, "before"));
    if (trailing_.count > 0)
      options_.notes->push_back(stray_lines_note(trailing_.first, trailing_.count, "after"));
    scanner_.note_not_finite(options_.notes);
    for (const VertexList* list : {&textures_, &normals_}) {
      const bool beyond = list->highest_used > list->count;
      if (list->bad_line == 0 && !beyond) continue;
      note(list->bad_line > 0 ? list->bad_line : list->line_of_highest,
           "a face names a " + std::string(list->keyword) + " that the file does not define");
    }
    note(short_faces_, "face", " of fewer than 3 corners left out");
    note(
        odd_faces_, "face",
        " with a slash at the end of a corner, or on several lines: PrusaSlicer does not read such "
        "faces");
    const std::string refused =
        std::string(": PrusaSlicer refuses such a file; ").append(kByRepair).append(" writes ");
    note(refused_faces_, "face", " of more than 4 corners" + refused + "triangles");
    note(commented_, "line", " of points or faces with a comment" + refused + "none");
  }

  void note(std::size_t line, const std::string& what) {
    options_.notes->push_back("line " + std::to_string(line) + ": " + what);
  }
  void note(const Lines& lines, std::string_view noun, std::string_view what) {
    if (lines.count > 0) note(lines.first, counted(lines.count, noun).append(what));
  }

  TextScanner scanner_;
  std::string_view name_;
  ReadOptions options_;
  Lines header_, trailing_;  ///< unknown statements before and after the mesh
  Lines short_faces_;        ///< of fewer than 3 corners, left out for repairs
  Lines odd_faces_;          ///< PrusaSlicer 2.5 passes over them without a message
  /// PrusaSlicer 2.5 refuses the whole file: faces of more than 4 corners, points and faces with a
  /// comment on their line.
  Lines refused_faces_, commented_;
  std::string trailing_word_;  ///< the first of them, for a message
  VertexList points_{"v"};
  VertexList textures_{"vt"};
  VertexList normals_{"vn"};
  TriangleMesh mesh_;
  PolygonFaces polygons_;
  std::vector<std::uint32_t> corners_;
};

/// "f 1 2 3\n": indices count from 1.
void append_face_line(std::string& text, const std::array<std::uint32_t, 3>& triangle) {
  char line[40] = "f";
  char* end = line + 1;
  for (const std::uint32_t index : triangle) {
    *end++ = ' ';
    end = std::to_chars(end, std::end(line), std::uint64_t{index} + 1).ptr;
  }
  *end++ = '\n';
  text.append(line, end);
}

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
    append_face_line(text, triangle);
  }
  return text;
}

Result<TriangleMesh> read_obj(const ByteSource& source, std::string_view name,
                              const ReadOptions& options) {
  // A closed mesh has half as many points as triangles.
  constexpr std::size_t kUsualBytes = kUsualTriangleBytes + kUsualPointBytes / 2;
  return guarded(name, [&] {
    return check_text_size(source, kUsualBytes, name).and_then([&] {
      ByteStream stream(source);
      return ObjReader(stream, name, options).read();
    });
  });
}

Result<TriangleMesh> decode_obj(std::string_view bytes, std::string_view name,
                                const ReadOptions& options) {
  return check_file_size(bytes, name).and_then([&] {
    return read_obj(source_of(bytes), name, options);
  });
}

}  // namespace clay::solid::inline formats
