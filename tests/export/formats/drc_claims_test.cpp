#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"

#include "core/content_hash.hpp"
#include "tests/export/fallen/peer_program.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

namespace clay::solid {
namespace {

using samples::tetrahedron;
using samples::torus;

constexpr std::size_t kHeaderBytes = 11;
const DracoClaims kClaims{.volume_mm3 = 123.25,
                          .volume_bound_mm3 = 0.5,
                          .counted_volume_mm3 = 123.0,
                          .vertex_error_mm = 0.01};

std::string with_claims(const TriangleMesh& mesh, const DracoClaims& claims = kClaims) {
  return encode_drc(mesh, {}, &claims).value();
}

template <class Value>
std::string message_of(const Result<Value>& result) {
  return result ? "no error" : result.error().message;
}

std::string decode_message(const std::string& bytes) {
  return message_of(decode_drc(bytes, "pot.drc"));
}

/// A file without metadata, with this block inserted after the header.
std::string with_block(const std::string& block) {
  std::string bytes = encode_drc(tetrahedron(), {}).value();
  bytes[kHeaderBytes - 1] = static_cast<char>(0x80);
  return bytes.insert(kHeaderBytes, block);
}

std::string short_text(const std::string& text) { return static_cast<char>(text.size()) + text; }
std::string entry(const std::string& key, const std::string& value) {
  return short_text(key) + short_text(value);
}
std::string number(double value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// A block of these entries with a checksum that matches its file.
std::string with_entries_and_checksum(const std::vector<std::string>& entries) {
  std::string block = std::string(1, '\0') + static_cast<char>(entries.size() + 1);
  for (const std::string& each : entries) block += each;
  const std::string digits(32, '#');
  std::string bytes = with_block(block + entry("claystack.checksum", digits) + '\0');
  const std::size_t at = bytes.find(digits);
  bytes.erase(at, digits.size());
  return bytes.insert(at, hash_of(std::as_bytes(std::span(bytes))));
}

std::vector<std::string> all_entries(double volume_mm3) {
  return {entry("claystack.volume_mm3", number(volume_mm3)),
          entry("claystack.volume_bound_mm3", number(0.5)),
          entry("claystack.counted_volume_mm3", number(123.0)),
          entry("claystack.vertex_error_mm", number(0.01))};
}

TEST(DrcClaims, RoundTrip) {
  EXPECT_EQ(drc_claims(with_claims(torus(12, 8)), "x").value(), kClaims);
  EXPECT_EQ(drc_claims(encode_drc(torus(12, 8), {}).value(), "x").value(), std::nullopt);
}

TEST(DrcClaims, DoNotChangeTheMesh) {
  const TriangleMesh mesh = torus(12, 8);
  const std::string plain = encode_drc(mesh, {}).value();
  const std::string claimed = with_claims(mesh);
  EXPECT_TRUE(claimed.ends_with(plain.substr(kHeaderBytes)));
  EXPECT_EQ(decode_drc(claimed, "x").value(), decode_drc(plain, "x").value());
}

TEST(DrcClaims, FollowTheDocumentedLayout) {
  EXPECT_EQ(drc_claims(with_entries_and_checksum(all_entries(123.25)), "x").value(), kClaims);
}

TEST(DrcClaims, AreMetadataToDracoItself) {
  const std::string bytes = with_claims(torus(12, 8));
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  const auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
  ASSERT_TRUE(mesh.ok());
  double volume = 0.0;
  ASSERT_TRUE(mesh.value()->GetMetadata()->GetEntryDouble("claystack.volume_mm3", &volume));
  EXPECT_EQ(volume, kClaims.volume_mm3);
  std::string checksum;
  ASSERT_TRUE(mesh.value()->GetMetadata()->GetEntryString("claystack.checksum", &checksum));
  std::string rest = bytes;
  rest.erase(bytes.find(checksum), checksum.size());
  EXPECT_EQ(checksum, hash_of(std::as_bytes(std::span(rest))));
}

TEST(DrcClaims, AreIgnoredByDracosProgram) {
  const TriangleMesh mesh = torus(20, 10);
  const auto decoded_by_draco = [](const std::string& bytes) {
    const samples::ScratchFile packed(".drc", bytes);
    const samples::ScratchFile unpacked(".obj");
    samples::output_of("draco_decoder -i " + packed.path() + " -o " + unpacked.path());
    std::ostringstream text;
    text << std::ifstream(unpacked.path()).rdbuf();
    return text.str();
  };
  const std::string text = decoded_by_draco(with_claims(mesh));
  EXPECT_EQ(decode_obj(text, "x").value().triangles.size(), mesh.triangles.size());
  EXPECT_EQ(text, decoded_by_draco(encode_drc(mesh, {}).value()));
}

/// Each byte changed to every other value: header, metadata and mesh.
TEST(DrcClaims, DetectEveryChangedByte) {
  const std::string good = with_claims(torus(4, 3));
  const std::size_t body = good.size() - encode_drc(torus(4, 3), {})->size() + kHeaderBytes;
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (int change = 1; change < 256; ++change) {
      std::string bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ change);
      const std::string message = decode_message(bytes);
      ASSERT_TRUE(message.starts_with("pot.drc: ")) << at << " by " << change << ": " << message;
      if (at < body) continue;
      ASSERT_TRUE(message.starts_with("pot.drc: checksum: expected ")) << message;
      ASSERT_TRUE(message.ends_with(": the file has been changed")) << message;
    }
  }
}

TEST(DrcClaims, DetectTruncatedOrAppendedBytes) {
  const std::string good = with_claims(torus(4, 3));
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_TRUE(decode_message(good.substr(0, size)).starts_with("pot.drc: ")) << size;
  EXPECT_TRUE(decode_message(good + "x").ends_with(": the file has been changed"));
}

TEST(DrcClaims, AreReadCompletelyOrRefused) {
  const std::string none =
      "pot.drc: expected a checksum of 32 digits beside other claims, found none";
  EXPECT_EQ(decode_message(with_block(std::string("\0\1", 2) +
                                      entry("claystack.volume_mm3", number(1.0)) + '\0')),
            none);
  EXPECT_EQ(decode_message(
                with_block(std::string("\0\1", 2) + entry("claystack.checksum", "0123") + '\0')),
            none);
  auto entries = all_entries(123.25);
  entries.erase(entries.begin() + 1);
  EXPECT_EQ(decode_message(with_entries_and_checksum(entries)),
            "pot.drc: claystack.volume_bound_mm3: expected a float64 of 0 or more, found none");
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(decode_message(with_entries_and_checksum(all_entries(bad))),
              "pot.drc: claystack.volume_mm3: expected a float64 of 0 or more, found none");
  entries[0] = entry("claystack.volume_mm3", "123.25");
  EXPECT_EQ(decode_message(with_entries_and_checksum(entries)),
            "pot.drc: claystack.volume_mm3: expected a float64 of 0 or more, found none");
}

TEST(DrcClaims, AreRefusedInABrokenBlock) {
  const std::string huge = "\xFF\xFF\xFF\xFF\x0F";
  auto twice = all_entries(1.0);
  twice.push_back(twice.front());
  std::string deep(1, '\0');
  for (int level = 0; level < 1000; ++level) deep += std::string("\0\1\0", 3);
  deep += std::string("\0\0", 2);
  for (const std::string& bytes :
       {with_block(huge), with_block('\0' + huge), with_block(std::string("\0\0", 2) + huge),
        with_block(std::string("\0\1", 2) + "\1k" + huge), with_block(deep),
        with_entries_and_checksum(twice)}) {
    EXPECT_EQ(decode_message(bytes),
              "pot.drc: expected metadata after the header, found a block that ends early, nests "
              "deeper than 16 or states a claim twice");
    EXPECT_EQ(message_of(drc_claims(bytes, "pot.drc")), decode_message(bytes));
  }
}

/// Metadata of other programs, including attribute metadata and nested blocks.
TEST(DrcClaims, IgnoreOtherMetadata) {
  auto metadata = std::make_unique<draco::GeometryMetadata>();
  metadata->AddEntryString("name", std::string(300, 'x'));
  metadata->AddEntryIntArray("numbers", {1, 2, 3});
  auto nested = std::make_unique<draco::Metadata>();
  nested->AddEntryDouble("depth", 1.0);
  metadata->AddSubMetadata("nested", std::move(nested));
  draco::Mesh mesh;
  mesh.set_num_points(3);
  draco::GeometryAttribute layout;
  layout.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int id = mesh.AddAttribute(layout, true, 3);
  const float corners[3][3] = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
  for (std::uint32_t i = 0; i < 3; ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), corners[i]);
  mesh.AddFace({draco::PointIndex(0), draco::PointIndex(1), draco::PointIndex(2)});
  mesh.AddMetadata(std::move(metadata));
  auto of_attribute = std::make_unique<draco::AttributeMetadata>();
  of_attribute->AddEntryString("of", "positions");
  mesh.AddAttributeMetadata(id, std::move(of_attribute));
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
  const std::string_view bytes(buffer.data(), buffer.size());
  ASSERT_NE(bytes.find("positions"), std::string_view::npos);
  EXPECT_EQ(decode_drc(bytes, "x").value(),
            (TriangleMesh{{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}, {{0, 1, 2}}}));
  EXPECT_EQ(drc_claims(bytes, "x").value(), std::nullopt);
}

TEST(DrcClaims, RefuseUnkeepableClaims) {
  const auto message = [](const DracoClaims& claims) {
    return message_of(encode_drc(tetrahedron(), {}, &claims));
  };
  for (double DracoClaims::*const field :
       {&DracoClaims::volume_mm3, &DracoClaims::volume_bound_mm3, &DracoClaims::counted_volume_mm3,
        &DracoClaims::vertex_error_mm}) {
    for (const double bad : {-1e-300, std::nan(""), std::numeric_limits<double>::infinity()}) {
      DracoClaims claims = kClaims;
      claims.*field = bad;
      EXPECT_EQ(message(claims), "cannot write .drc: expected claims of 0 or more");
    }
  }
  DracoClaims claims = kClaims;
  claims.vertex_error_mm = 0.0099;
  EXPECT_EQ(message(claims),
            "cannot write .drc: expected no smaller vertex error claimed than allowed");
}

TEST(CompareWithClaims, AllowsUpToTheBound) {
  const TriangleMesh mesh = tetrahedron();  // 1000/6 mm3
  const auto problems = [&](double volume_mm3, double bound_mm3) {
    return compare_with_claims(mesh, {.volume_mm3 = volume_mm3, .volume_bound_mm3 = bound_mm3});
  };
  EXPECT_TRUE(problems(1000.0 / 6.0, 0.0).empty());
  EXPECT_TRUE(problems(1000.0 / 6.0 + 0.499, 0.5).empty());
  EXPECT_TRUE(problems(1000.0 / 6.0 - 0.499, 0.5).empty());
  EXPECT_EQ(problems(1000.0 / 6.0 + 0.501, 0.5).size(), 1u);
  const auto found = problems(166.0, 0.5);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].what, "volume differs from the one the file states");
  EXPECT_EQ(found[0].where, "expected 166 mm3 within 0.500000166, found 166.666667 mm3");
}

}  // namespace
}  // namespace clay::solid
