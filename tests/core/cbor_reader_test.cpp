#include "core/json/cbor_reader.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>

namespace clay::files {
namespace {

std::string from_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  return bytes;
}

std::string repeated(std::string_view hex, std::size_t times) {
  std::string bytes;
  for (std::size_t i = 0; i < times; ++i) bytes += from_hex(hex);
  return bytes;
}

/// The item, or the reason for refusing it.
struct Outcome {
  std::optional<Json> value;
  std::string refusal;
};

Outcome read(std::string_view bytes) {
  JsonBuilder builder(1000);
  if (read_cbor(bytes, builder)) return {builder.take(), {}};
  return {std::nullopt, builder.refusal()};
}

struct Example {
  const char* diagnostic;
  const char* hex;
};

// RFC 8949, appendix A.
TEST(CborReader, ReadsTheExamplesOfTheStandard) {
  for (const auto& [diagnostic, hex] : {
           Example{"0", "00"},
           {"1", "01"},
           {"10", "0a"},
           {"23", "17"},
           {"24", "1818"},
           {"100", "1864"},
           {"1000", "1903e8"},
           {"1000000", "1a000f4240"},
           {"1000000000000", "1b000000e8d4a51000"},
           {"18446744073709551615", "1bffffffffffffffff"},
           {"-1", "20"},
           {"-10", "29"},
           {"-100", "3863"},
           {"-1000", "3903e7"},
           {"0.0", "f90000"},
           {"-0.0", "f98000"},
           {"1.0", "f93c00"},
           {"1.1", "fb3ff199999999999a"},
           {"1.5", "f93e00"},
           {"65504.0", "f97bff"},
           {"100000.0", "fa47c35000"},
           {"3.4028234663852886e+38", "fa7f7fffff"},
           {"1.0e+300", "fb7e37e43c8800759c"},
           {"5.960464477539063e-8", "f90001"},
           {"0.00006103515625", "f90400"},
           {"-4.0", "f9c400"},
           {"-4.1", "fbc010666666666666"},
           {"false", "f4"},
           {"true", "f5"},
           {"null", "f6"},
           {R"("")", "60"},
           {R"("a")", "6161"},
           {R"("IETF")", "6449455446"},
           {R"("\"\\")", "62225c"},
           {R"("\u00fc")", "62c3bc"},
           {R"("\u6c34")", "63e6b0b4"},
           {R"("\ud800\udd51")", "64f0908591"},
           {"[]", "80"},
           {"[1, 2, 3]", "83010203"},
           {"[1, [2, 3], [4, 5]]", "8301820203820405"},
           {"{}", "a0"},
           {R"({"a": 1, "b": [2, 3]})", "a26161016162820203"},
           {R"(["a", {"b": "c"}])", "826161a161626163"},
       }) {
    const auto [value, refusal] = read(from_hex(hex));
    ASSERT_TRUE(value) << diagnostic << ": " << refusal;
    const Json expected = Json::parse(diagnostic);
    EXPECT_EQ(*value, expected);
    EXPECT_EQ(value->type(), expected.type()) << diagnostic;
  }
}

TEST(CborReader, RefusesTypesThatPotsDoNotUse) {
  for (const char* hex : {
           "3bffffffffffffffff",  // -2^64: no 64-bit integer
           "f97c00",
           "fa7f800000",  // infinity
           "f97e00",
           "fb7ff8000000000000",  // NaN
           "f7",
           "f0",
           "f818",            // undefined, unassigned
           "4401020304",      // byte string
           "c11a514b67b0",    // tag
           "a10102",          // integer key
           "a2616101616102",  // duplicate key
           "9f01ff",
           "bf616101ff",
           "7f6161ff",
           "5f4101ff",  // indefinite lengths
           "1c",
           "ff",  // reserved, a lone break
           "62c328",
           "61ff",      // malformed UTF-8
           "a161ff01",  // and in a key
           "0000",      // a second item
       })
    EXPECT_FALSE(read(from_hex(hex)).value) << hex;
}

TEST(CborReader, CountsTheBytesAfterTheEnd) {
  EXPECT_EQ(read(from_hex("80a0")).refusal, "expected the end of the file, found 1 more byte");
  EXPECT_EQ(read(from_hex("80a0a0")).refusal, "expected the end of the file, found 2 more bytes");
}

TEST(CborReader, RefusesHugeLengthsBeforeAllocating) {
  for (const char* hex : {"9bffffffffffffffff", "bbffffffffffffffff", "7bffffffffffffffff",
                          "9a7fffffff00", "ba7fffffff616100", "7a7fffffff61"})
    EXPECT_EQ(read(from_hex(hex)).refusal.substr(0, 42),
              "expected a length the file can hold, found")
        << hex;
}

TEST(CborReader, RefusesDeepNesting) {
  EXPECT_TRUE(read(repeated("81", 64) + from_hex("00")).value);
  EXPECT_FALSE(read(repeated("81", 65) + from_hex("00")).value);
  for (const char* hex : {"81", "9f", "a16161", "bf6161", "7f", "5f", "c1"})
    EXPECT_FALSE(read(repeated(hex, 2'000'000)).value) << hex;
}

TEST(CborReader, RefusesEveryTruncation) {
  const std::string whole = from_hex("a2616182fb3ff199999999999a1b000000e8d4a5100061626449455446");
  ASSERT_TRUE(read(whole).value);
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_FALSE(read(std::string_view(whole).substr(0, n)).value) << n;
}

}  // namespace
}  // namespace clay::files
