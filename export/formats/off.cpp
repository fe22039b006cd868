#include "claystack/export/formats.hpp"
#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/formats/byte_stream.hpp"
#include "export/formats/format_marks.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/point_merging.hpp"
#include "export/formats/polygon_faces.hpp"
#include "export/formats/text_scanner.hpp"

#include <string>
#include <vector>

namespace clay::solid::inline formats {
namespace {

// The shortest lines: "0 0 0\n", "3 0 1 2\n".
constexpr std::size_t kLeastPointBytes = 6, kLeastFaceBytes = 8;

class OffReader {
 public:
  OffReader(ByteStream& text, std::string_view name, std::vector<std::string>* notes)
      : scanner_(text, name, LineRule::comments), name_(name), size_(text.size()), notes_(notes) {}

  Result<TriangleMesh> read() {
    const std::string_view begin = scanner_.word();
    const std::string_view first = read_keyword(begin) ? scanner_.word() : begin;
    if (first == "BINARY") scanner_.fail("expected OFF as text, found binary OFF");
    const std::size_t points = count(first, kLeastPointBytes, "vertices");
    const std::size_t faces = count(scanner_.word(), kLeastFaceBytes, "faces");
    (void)scanner_.whole_number(scanner_.word());  // edges, which many programs leave 0
    if (scanner_.fault()) return tl::make_unexpected(*scanner_.fault());
    mesh_.points.reserve(points);
    for (std::size_t i = 0; i < points && !scanner_.fault(); ++i) read_point();
    for (std::size_t i = 0; i < faces && !scanner_.fault(); ++i) read_face();
    if (const auto rest = scanner_.word(); !rest.empty())
      scanner_.fail_expected("the end of the file after its faces", rest);
    if (scanner_.fault()) return tl::make_unexpected(*scanner_.fault());
    scanner_.note_not_finite(notes_);
    polygons_.split(mesh_, notes_);
    share_equal_points(mesh_, notes_);
    return check_facet_count(mesh_.triangles.size(), name_).map([&] { return std::move(mesh_); });
  }

 private:
  /// Returns false if the file begins with its counts: the keyword is optional.
  bool read_keyword(std::string_view found) {
    if (is_off_count(found)) {
      if (notes_ != nullptr)
        notes_->push_back("line " + std::to_string(scanner_.line()) +
                          ": the file begins without the keyword OFF");
      return false;
    }
    if (!is_off_keyword(found)) scanner_.fail_expected("OFF, COFF, NOFF or STOFF", found);
    return true;
  }

  /// A count whose lines the file has room for.
  std::size_t count(std::string_view found, std::size_t least_bytes, std::string_view noun) {
    const long long number = scanner_.whole_number(found);
    const auto most = static_cast<long long>(size_ / least_bytes);
    if (number >= 0 && number <= most) return static_cast<std::size_t>(number);
    scanner_.fail("expected a count of " + std::string(noun) + " that the file's " +
                  std::to_string(size_) + " bytes hold, found " + std::to_string(number));
    return 0;
  }

  /// Three coordinates; normals, colours and texture coordinates may follow on the line.
  void read_point() {
    glm::vec3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = scanner_.coordinate(scanner_.word());
    skip_numbers();
    mesh_.points.emplace_back(point + 0.0F);  // -0 + 0 is 0
  }

  /// A number of corners, their indices, and perhaps a colour on the line.
  void read_face() {
    const long long corners = scanner_.whole_number(scanner_.word());
    if (corners < 3 || corners > static_cast<long long>(kMaxFaceCorners))
      return scanner_.fail("expected a face of 3 to " + std::to_string(kMaxFaceCorners) +
                           " corners, found " + std::to_string(corners));
    if (mesh_.triangles.size() + static_cast<std::size_t>(corners) > kMaxTriangles + 2)
      return scanner_.fail(expected_at_most(kMaxTriangles, "triangles"));
    corners_.clear();
    for (long long i = 0; i < corners; ++i) corners_.push_back(index(scanner_.word()));
    skip_numbers();
    if (scanner_.fault()) return;
    polygons_.add(corners_, mesh_);
  }

  std::uint32_t index(std::string_view found) {
    const long long number = scanner_.whole_number(found);
    if (number >= 0 && number < static_cast<long long>(mesh_.points.size()))
      return static_cast<std::uint32_t>(number);
    scanner_.fail(expected_number("a vertex", 0, mesh_.points.size()) + ", found " +
                  std::to_string(number));
    return 0;
  }

  void skip_numbers() {
    for (auto found = scanner_.word_in_line(); !found.empty(); found = scanner_.word_in_line())
      scanner_.unused_number(found);
  }

  TextScanner scanner_;
  std::string_view name_;
  std::uint64_t size_;
  std::vector<std::string>* notes_;
  TriangleMesh mesh_;
  PolygonFaces polygons_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Result<TriangleMesh> decode_off(std::string_view bytes, std::string_view name,
                                const ReadOptions& options) {
  return check_file_size(bytes, name).and_then([&] {
    return guarded(name, [&] {
      const ByteSource source = source_of(bytes);
      ByteStream stream(source);
      return OffReader(stream, name, options.notes).read();
    });
  });
}

}  // namespace clay::solid::inline formats
