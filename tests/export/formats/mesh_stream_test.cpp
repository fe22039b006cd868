// Mesh files that are read in parts.

#include "claystack/export/formats.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

namespace clay::solid {
namespace {

using samples::torus;

/// A file generated while it is read, so it is never in memory.
class MadeFile {
 public:
  using Piece = std::function<std::string(std::size_t)>;

  MadeFile(std::size_t pieces, Piece piece) : piece_(std::move(piece)), pieces_(pieces) {
    for (std::size_t i = 0; i < pieces; ++i) size_ += piece_(i).size();
  }

  /// Largest size of a part [bytes].
  ByteSource source(std::size_t most) {
    next_ = 0;
    rest_.clear();
    return {[this, most](std::span<char> part) -> Result<std::size_t> {
              largest_part_ = std::max(largest_part_, part.size());
              if (rest_.empty() && next_ < pieces_) rest_ = piece_(next_++);
              const std::size_t count = rest_.copy(part.data(), std::min(part.size(), most));
              rest_.erase(0, count);
              return count;
            },
            size_,
            {}};
  }
  [[nodiscard]] std::size_t largest_part() const { return largest_part_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::string whole() const {
    std::string all;
    for (std::size_t i = 0; i < pieces_; ++i) all += piece_(i);
    return all;
  }

 private:
  Piece piece_;
  std::size_t pieces_, size_ = 0, next_ = 0, largest_part_ = 0;
  std::string rest_;
};

constexpr std::size_t kMegabyte = std::size_t{1} << 20;

/// Facets along a strip, with lines of varying length, so that they end anywhere in a part.
std::string text_facet(std::size_t i) {
  const std::string x = std::to_string(i), y = std::to_string(i + 1);
  return std::string(i % 97, ' ') + "facet normal 0 0 1\nouter loop\nvertex " + x +
         " 0 0\nvertex " + y + " 0 0\r\n" + std::string(i % 13, '\t') + "vertex " + x +
         " 1 0\nendloop\n\nendfacet\n";
}

MadeFile text_strip(std::size_t facets, const std::string& end = "endsolid strip\n") {
  return {facets + 2, [facets, end](std::size_t i) {
            if (i == 0) return std::string("solid strip\n");
            return i <= facets ? text_facet(i - 1) : end;
          }};
}

TEST(MeshStream, ReadsTextInPartsOfAtMostTwoMegabytes) {
  constexpr std::size_t kFacets = 40'000;
  MadeFile file = text_strip(kFacets);
  ASSERT_GT(file.size(), 5 * kMegabyte);
  for (const std::size_t most : {std::size_t{100}, kMegabyte, file.size()}) {
    const auto mesh = read_stl(file.source(most), "strip.stl");
    ASSERT_TRUE(mesh) << mesh.error().message;
    ASSERT_EQ(mesh->triangles.size(), kFacets);
    // Facet i has two new corners and shares the next one.
    ASSERT_EQ(mesh->points.size(), 2 * kFacets + 1);
    for (std::size_t i = 0; i < kFacets; ++i) {
      const auto& [a, b, c] = mesh->triangles[i];
      ASSERT_EQ(mesh->points[a], glm::dvec3(i, 0, 0));
      ASSERT_EQ(mesh->points[b], glm::dvec3(i + 1, 0, 0));
      ASSERT_EQ(mesh->points[c], glm::dvec3(i, 1, 0));
    }
  }
  EXPECT_LE(file.largest_part(), 2 * kMegabyte);
}

TEST(MeshStream, ErrorsNameALateLine) {
  // Seven lines and an empty one per facet, after the first line.
  constexpr std::size_t kFacets = 40'000;
  MadeFile file = text_strip(kFacets, "facet normal 0 0 up\n");
  const std::string line = std::to_string(8 * kFacets + 2);
  EXPECT_EQ(read_stl(file.source(kMegabyte), "strip.stl").error().message,
            "strip.stl:" + line + ": expected a number, found 'up'");
  MadeFile damaged = text_strip(kFacets, std::string("end\0solid\n", 10));
  EXPECT_EQ(read_stl(damaged.source(kMegabyte), "strip.stl").error().message,
            "strip.stl:" + line + ": expected text, found a NUL byte");
  MadeFile wide = text_strip(kFacets, "endsolid " + std::string(3 * kMegabyte, 'x'));
  EXPECT_EQ(read_stl(wide.source(kMegabyte), "strip.stl").error().message,
            "strip.stl:" + line + ": expected a line of at most 64 KiB");
}

TEST(MeshStream, ObjInPartsEqualsObjInOneBlock) {
  // Continued lines and comments at every position of a part.
  MadeFile file(60'000, [](std::size_t i) {
    const std::string x = std::to_string(i % 1000);
    if (i < 30'000)
      return "v " + x + " \\\n " + std::to_string(i / 1000) + " \\\r\n" + std::string(i % 31, ' ') +
             "0.5\n# " + std::string(i % 57, 'c') + "\\\n";
    const std::string corner = std::to_string(i - 29'999);
    return "f " + corner + " \\\n1 -1\n";
  });
  ASSERT_GT(file.size(), 2 * kMegabyte);
  const auto whole = decode_obj(file.whole(), "o.obj");
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole->triangles.size(), 30'000u);
  EXPECT_EQ(whole->points[12'345], glm::dvec3(345, 12, 0.5));
  EXPECT_EQ(read_obj(file.source(777), "o.obj").value(), *whole);
  EXPECT_LE(file.largest_part(), 2 * kMegabyte);
}

TEST(MeshStream, ReadsBinaryFilesInParts) {
  const TriangleMesh mesh = rounded_to_float(torus(400, 300));
  const std::string bytes = encode_stl_binary(mesh);
  MadeFile file(1, [&](std::size_t) { return bytes; });
  EXPECT_EQ(read_stl(file.source(1'001), "torus.stl").value(),
            decode_stl(bytes, "torus.stl").value());
  EXPECT_LE(file.largest_part(), 2 * kMegabyte);
}

TEST(MeshStream, ReportsAFileThatShrinksOrFailsDuringReading) {
  const std::string bytes = encode_stl_binary(torus(20, 10));
  const std::string size = std::to_string(bytes.size());
  MadeFile file(1, [&](std::size_t) { return bytes.substr(0, 1000); });
  ByteSource shorter = file.source(kMegabyte);
  shorter.size = bytes.size();
  EXPECT_EQ(read_stl(shorter, "torus.stl").error().message,
            "torus.stl: expected " + size +
                " bytes of binary STL for the 400 facets it counts, found 1000 bytes");
  for (const std::string& begin : {bytes.substr(0, 500), text_facet(0)}) {
    bool begun = false;
    const ByteSource failing{[&](std::span<char> part) -> Result<std::size_t> {
                               if (begun) return failure(ErrorKind::io, "disk on fire");
                               begun = true;
                               return begin.copy(part.data(), part.size());
                             },
                             bytes.size(),
                             {}};
    for (const auto read : {read_stl, read_obj}) {
      begun = false;
      const auto mesh = read(failing, "x", {});
      EXPECT_EQ(mesh.error().kind, ErrorKind::io);
      EXPECT_EQ(mesh.error().message, "disk on fire");
    }
  }
}

TEST(MeshStream, AnnouncesTheTrianglesBeforeReading) {
  const std::string binary = encode_stl_binary(torus(20, 10));
  const std::string text = encode_stl_ascii(torus(20, 10), "torus");
  const std::string obj = encode_obj(torus(20, 10), "torus");
  const auto announced = [](const std::string& bytes, const auto& read) {
    MadeFile file(1, [&](std::size_t) { return bytes; });
    ByteSource source = file.source(kMegabyte);
    std::uint64_t triangles = 0;
    source.announce = [&](std::uint64_t found) -> Result<void> {
      triangles = found;
      return failure(ErrorKind::io, "too many for me");
    };
    EXPECT_EQ(read(source, "x", {}).error().message, "too many for me");
    return static_cast<double>(triangles);
  };
  EXPECT_EQ(announced(binary, read_stl), 400.0);
  // For text an estimate, within a factor of two.
  EXPECT_NEAR(announced(text, read_stl), 400.0, 200.0);
  EXPECT_NEAR(announced(obj, read_obj), 400.0, 200.0);
}

TEST(MeshStream, RefusesTooMuchTextByFileSize) {
  const std::uint64_t size = (std::uint64_t{8} << 30) + 1;
  const ByteSource huge{[](std::span<char> part) -> Result<std::size_t> {
                          std::fill(part.begin(), part.end(), ' ');
                          std::string_view("solid").copy(part.data(), part.size());
                          return part.size();
                        },
                        size,
                        {}};
  EXPECT_EQ(read_stl(huge, "big.stl").error().message,
            "big.stl: expected at most 20000000 triangles, found about 33 million, by the file's "
            "size of 8589934593 bytes");
  EXPECT_EQ(read_obj(huge, "big.obj").error().message,
            "big.obj: expected at most 20000000 triangles, found about 195 million, by the file's "
            "size of 8589934593 bytes");
}

}  // namespace
}  // namespace clay::solid
