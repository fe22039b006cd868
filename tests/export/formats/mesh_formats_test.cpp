#include "claystack/export/formats.hpp"
#include "export/formats/mesh_limits.hpp"
#include "tests/export/solid/mesh_generators.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>

#include <sys/mman.h>
#include <cstring>
#include <stdexcept>
#include <string>

namespace clay::solid {
namespace {

using samples::corners_of;
using samples::torus;

/// Pages of zeros that use no memory until they are written.
class HugeFile {
 public:
  explicit HugeFile(std::size_t size)
      : size_(size),
        data_(mmap(nullptr, size, PROT_READ | PROT_WRITE,
                   MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)) {}
  HugeFile(const HugeFile&) = delete;
  HugeFile& operator=(const HugeFile&) = delete;
  ~HugeFile() { munmap(data_, size_); }
  [[nodiscard]] char* data() const { return static_cast<char*>(data_); }
  [[nodiscard]] std::string_view bytes() const { return {data(), size_}; }

 private:
  std::size_t size_;
  void* data_;
};

TEST(MeshFormats, RefuseLargeCountsBeforeAllocating) {
  const HugeFile facets(84 + std::size_t{50} * 20'000'001);
  const std::uint32_t count = 20'000'001;
  std::memcpy(facets.data() + 80, &count, sizeof count);
  EXPECT_EQ(decode_stl(facets.bytes(), "big").error().message,
            "big: expected 1 to 20000000 triangles, found 20000001");
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 60000001\nproperty uchar x\n"
      "property uchar y\nproperty uchar z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const HugeFile points(header.size() + std::size_t{3} * 60'000'001 + 13);
  std::memcpy(points.data(), header.data(), header.size());
  EXPECT_EQ(decode_ply(points.bytes(), "big").error().message,
            "big: expected at most 60000000 vertices, found 60000001");
  const HugeFile bytes((std::size_t{1} << 30) + 1);
  for (const auto decode : {decode_stl, decode_obj}) {
    EXPECT_EQ(decode(bytes.bytes(), "big", {}).error().message,
              "big: expected at most 1073741824 bytes, found 1073741825");
  }
}

TEST(MeshFormats, ExceptionsBecomeErrors) {
  const auto starved = [](const std::string& what) -> Result<TriangleMesh> {
    throw std::length_error(what);
  };
  EXPECT_EQ(guarded("pot.stl", [&] { return starved("too long"); }).error().message,
            "pot.stl: cannot be read: too long");
}

TEST(MeshFormats, AreChosenByExtension) {
  EXPECT_EQ(mesh_format_of("a/b.stl").value(), MeshFormat::stl_binary);
  EXPECT_EQ(mesh_format_of("pot.v2.OBJ").value(), MeshFormat::obj);
  EXPECT_EQ(mesh_format_of(".drc").value(), MeshFormat::drc);
  for (const char* other : {"pot", "pot.step", "pot.stl.gz", "stl", ""}) {
    EXPECT_EQ(
        mesh_format_of(other).error().message,
        std::string(other) + ": expected a name that ends in " + format_endings(FormatUse::read));
  }
}

TEST(MeshFormats, AreRecognisedByFirstBytesAsTheReadersDo) {
  const TriangleMesh mesh = torus(8, 6);
  for (const FormatFacts& facts : kFormatFacts) {
    const auto bytes = encode_mesh(mesh, facts.format, {});
    if (!bytes || facts.ending.empty()) continue;
    const MeshFormat found = mesh_format_of_bytes(*bytes);
    EXPECT_EQ(facts_of(found).ending, facts.ending) << facts.name;
  }
  for (const char* stl : {"SOLID a\n", "Solid a\n", "\n solid a\n", "\xEF\xBB\xBFsolid a\n"})
    EXPECT_EQ(facts_of(mesh_format_of_bytes(stl)).ending, ".stl") << stl;
  for (const char* off : {"OFF\n", "COFF 4 4 6\n", "NOFF\n", "STCNOFF\n", "\n# a cup\nOFF # b\n",
                          "\xEF\xBB\xBFOFF\n", "4 4 6\n"})
    EXPECT_EQ(mesh_format_of_bytes(off), MeshFormat::off) << off;
  for (const char* obj : {"# a cup\nv 0 0 0\n", "v 0 0 0\n", "OFFSET\n", "o solid\n", ""})
    EXPECT_EQ(mesh_format_of_bytes(obj), MeshFormat::obj) << obj;
}

TEST(MeshFormats, HaveOneTable) {
  EXPECT_TRUE(format_endings(FormatUse::write).starts_with(".stl, .obj, .drc"));
  EXPECT_NE(format_endings(FormatUse::read).find(".off"), std::string::npos);
  EXPECT_EQ(format_endings(FormatUse::write).find(".off"), std::string::npos);
  for (const FormatFacts& facts : kFormatFacts) {
    EXPECT_EQ(mesh_format_named(facts.name).value(), facts.format);
    EXPECT_EQ(facts_of(facts.format).name, facts.name);
    if (facts.ending.empty()) continue;
    std::string capitals(facts.ending);
    for (char& c : capitals) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    EXPECT_EQ(facts_of(mesh_format_of("pot" + capitals).value()).ending, facts.ending);
    EXPECT_EQ(mesh_format_of("pot" + capitals, FormatUse::write).has_value(), facts.written);
    EXPECT_EQ(encode_mesh(torus(4, 3), facts.format).has_value(), facts.written);
  }
}

TEST(MeshFormats, DecodeMeshUsesTheGivenFormat) {
  const auto as_float = rounded_to_float(torus(6, 5));
  EXPECT_EQ(decode_mesh(encode_obj(as_float, "o"), MeshFormat::obj, "x").value(), as_float);
  for (const auto format : {MeshFormat::stl_binary, MeshFormat::stl_ascii}) {
    EXPECT_TRUE(name_of(format).starts_with("stl_"));
    EXPECT_EQ(corners_of(decode_mesh(encode_stl_ascii(as_float, "s"), format, "x").value()),
              corners_of(as_float));
  }
}

TEST(MeshFormats, RoundedToFloatHasNoNegativeZero) {
  const auto rounded = rounded_to_float({{{-0.0, 0.1, -1e-60}}, {}});
  EXPECT_EQ(rounded.points[0], glm::dvec3(0.0, double{0.1F}, 0.0));
  EXPECT_FALSE(samples::has_negative_zero(rounded));
}

}  // namespace
}  // namespace clay::solid
