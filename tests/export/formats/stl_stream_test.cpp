#include "export/formats/stl_stream.hpp"

#include "claystack/export/formats.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>
#include <string>
#include <utility>

namespace clay::solid {
namespace {

/// Lets a test change the written bytes, and make writing fail.
class TamperedStore final : public FileStore {
 public:
  explicit TamperedStore(std::string bytes) : bytes_(std::move(bytes)) {}
  Result<void> write(std::span<const std::byte>) override {
    ++writes;
    return failure(ErrorKind::io, "disk full");
  }
  [[nodiscard]] bool rereadable() const noexcept override { return true; }
  Result<void> read_at(std::uint64_t offset, std::span<std::byte> bytes) const override {
    if (offset + bytes.size() > bytes_.size()) return failure(ErrorKind::io, "ends early");
    const auto all = std::as_bytes(std::span(bytes_));
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(offset), bytes.size(), bytes.begin());
    return {};
  }
  int writes = 0;

 private:
  std::string bytes_;
};

Profile cup_with_cavity() {
  return profile_of(shapes::stack_of(4.0, {{30, 0}, {32, 12}, {33, 0}, {35, 31}, {35.5, 32}}))
      ->profile;
}

std::string streamed(const RevolveLayout& rule) {
  MemoryStore store;
  EXPECT_TRUE(stream_stl(rule, store));
  return store.bytes();
}

RC_GTEST_PROP(StlStream, EqualsTheEncodedMesh, (const ClayStack& stack)) {
  const auto section = profile_of(stack, 1e-4);
  if (!section || !certify(section->profile)) return;
  const RevolveLayout rule(section->profile, *rc::gen::inRange<std::size_t>(3, 40));
  const TriangleMesh mesh = revolve(rule);
  RC_ASSERT(mesh.triangles.size() == rule.triangles());
  RC_ASSERT(mesh.points.size() == rule.vertices());
  RC_ASSERT(streamed(rule) == encode_stl_binary(mesh));
}

TEST(StlStream, ManyBlocksAndTwoThreadsGiveTheSameBytes) {
  const RevolveLayout rule(cup_with_cavity(), 20'000);  // 440 000 facets: 22 blocks
  MemoryStore store;
  const auto file = stream_stl(rule, store);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->bytes, store.bytes().size());
  EXPECT_EQ(file->hash, hash_of(std::as_bytes(std::span(store.bytes()))));
  EXPECT_TRUE(store.bytes() == encode_stl_binary(revolve(rule)));
  EXPECT_TRUE(verify_stl(rule, store));
}

TEST(StlStream, ReportsTheStoresError) {
  TamperedStore store{""};
  const auto file = stream_stl(RevolveLayout(cup_with_cavity(), 12), store);
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().message, "disk full");
  EXPECT_EQ(file.error().kind, ErrorKind::io);
}

TEST(VerifyStl, DetectsEveryFlippedBitOfACorner) {
  const RevolveLayout rule(cup_with_cavity(), 5);
  const std::string good = streamed(rule);
  ASSERT_TRUE(verify_stl(rule, TamperedStore(good)));
  for (std::size_t facet = 0; facet < rule.triangles(); ++facet)
    for (std::size_t byte = 12; byte < 48; ++byte) {
      std::string bad = good;
      bad[84 + 50 * facet + byte] ^= 1;
      const auto verdict = verify_stl(rule, TamperedStore(bad));
      ASSERT_FALSE(verdict);
      EXPECT_EQ(verdict.error().kind, ErrorKind::io);
      EXPECT_EQ(verdict.error().message, "stl_binary as written: facet " +
                                             std::to_string(facet + 1) +
                                             ": found corners that are not those of the solid");
    }
}

TEST(VerifyStl, DetectsAWrongCountAndAMissingEnd) {
  const RevolveLayout rule(cup_with_cavity(), 6);
  std::string bytes = streamed(rule);
  EXPECT_FALSE(verify_stl(rule, TamperedStore(bytes.substr(0, bytes.size() - 10))));
  ++bytes[80];
  const auto verdict = verify_stl(rule, TamperedStore(bytes));
  ASSERT_FALSE(verdict);
  EXPECT_NE(verdict.error().message.find("facets, found"), std::string::npos);
}

TEST(VerifyStl, DetectsExchangedFacets) {
  const RevolveLayout rule(cup_with_cavity(), 6);
  std::string bytes = streamed(rule);
  std::swap_ranges(bytes.begin() + 84, bytes.begin() + 134, bytes.begin() + 134);
  EXPECT_FALSE(verify_stl(rule, TamperedStore(bytes)));
}

}  // namespace
}  // namespace clay::solid
