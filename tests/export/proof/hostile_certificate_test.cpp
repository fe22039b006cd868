// Malicious certificates: each is refused with a reason, at little cost.

#include "claystack/export/job.hpp"
#include "claystack/export/proof.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid {
namespace {

struct Certified {
  std::string text, file;
};

const Certified& cup() {
  static const Certified made = [] {
    MemoryStore store;
    ExportOptions options;
    options.segments = 16;
    const auto report = run_export(shapes::pot_of(shapes::stack_of(5, {{30, 0}, {30, 26}})),
                                   {{MeshFormat::stl_binary, &store}}, options);
    return Certified{write_certificate(report->files.at(0).certificate.value()), store.bytes()};
  }();
  return made;
}

/// The cup's certificate with the value of one field replaced.
std::string with(const std::string& field, const std::string& value) {
  std::string text = cup().text;
  const std::string name = std::string("\"").append(field).append("\": ");
  const std::size_t begin = text.find(name) + name.size();
  const std::size_t end = text.find(field == "profile_mm" ? "\n}" : ",\n", begin);
  return text.replace(begin, end - begin, value);
}

/// `part` repeated, after `before`.
std::string repeated(const std::string& part, std::size_t times, std::string before = "") {
  std::string text = std::move(before);
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

/// The same as `check --certificate` on the two.
Result<void> checked(const std::string& text) {
  return parse_certificate(text, "c.json").and_then([](const SolidCertificate& certificate) {
    return verify_certificate(certificate, cup().file, "cup.stl");
  });
}

::testing::AssertionResult refused(const std::string& text, const std::string& says) {
  const auto verdict = checked(text);
  if (verdict) return ::testing::AssertionFailure() << "was accepted";
  const std::string& message = verdict.error().message;
  if (message.find(says) == std::string::npos)
    return ::testing::AssertionFailure() << message.substr(0, 500);
  if (message.size() > 500) return ::testing::AssertionFailure() << "an error of many lines";
  return ::testing::AssertionSuccess();
}

TEST(HostileCertificate, AcceptsTheValidCertificate) {
  const auto verdict = checked(cup().text);
  EXPECT_TRUE(verdict) << verdict.error().message;
}

TEST(HostileCertificate, RefusesInvalidNumbers) {
  for (const char* field :
       {"bytes", "segments", "rounding_mm", "clearance_mm", "chord_mm", "wall_lower_mm",
        "wall_upper_mm", "volume_mm3", "volume_bound_mm3", "counted_volume_mm3"}) {
    EXPECT_TRUE(refused(with(field, "NaN"), "parse error")) << field;
    EXPECT_TRUE(refused(with(field, "-Infinity"), "parse error")) << field;
    EXPECT_TRUE(refused(with(field, "1e999"), "number overflow")) << field;
    EXPECT_TRUE(refused(with(field, "null"), std::string(field) + ": expected a")) << field;
    EXPECT_TRUE(refused(with(field, "\"7\""), std::string(field) + ": expected a")) << field;
    const bool counts = field == std::string_view("bytes") || field == std::string_view("segments");
    EXPECT_TRUE(refused(with(field, "1e308"), counts ? "whole number" : "found 1e+308")) << field;
    EXPECT_FALSE(checked(with(field, "-1"))) << field;
    EXPECT_FALSE(checked(with(field, "18446744073709551615"))) << field;
  }
}

TEST(HostileCertificate, RefusesSegmentsOutOfRange) {
  for (const char* segments : {"0", "2", "1048577", "1000000000", "18446744073709551615"})
    EXPECT_TRUE(refused(with("segments", segments), "3 to 1048576 segments")) << segments;
  // In range, but the file has another number: detected before any circle is made.
  EXPECT_TRUE(refused(with("segments", "1048576"), "triangles, found"));
}

TEST(HostileCertificate, RefusesInvalidProfiles) {
  for (const char* profile : {"[]", "[[[1,0],[2,0],[2,1]]]"})
    EXPECT_TRUE(refused(with("profile_mm", profile), "profile hash")) << profile;
  for (const char* profile : {"[[]]", "[[[1,0],[2,0]]]"})
    EXPECT_TRUE(refused(with("profile_mm", profile), "expected pieces of 3 points")) << profile;
  for (const char* profile : {"7", "null", "\"[]\""})
    EXPECT_TRUE(refused(with("profile_mm", profile), "profile_mm: expected an array")) << profile;
  for (const char* profile :
       {"[7]", "[[7]]", "[[[]]]", "[[[1]]]", "[[[1,2,3]]]", "[[[1,null]]]", "[[[1,\"2\"]]]"})
    EXPECT_TRUE(refused(with("profile_mm", profile), "expected points [rho, y]")) << profile;
  for (const char* profile : {"{}", "[{}]", "[[{\"rho\": 1}]]", "{\"a\": [[1,2],[1,2],[1,2]]}"})
    EXPECT_TRUE(refused(with("profile_mm", profile), "found an object")) << profile;
  EXPECT_TRUE(refused(with("profile_mm", "[[[1e300,0],[2,0],[2,1]]]"), "within +-1e6 mm"));
}

TEST(HostileCertificate, RefusesDuplicateUnknownOrMissingFields) {
  const std::string text = cup().text;
  const auto after_brace = [&](const std::string& more) {
    return std::string("{").append(more).append(text.substr(1));
  };
  EXPECT_TRUE(
      refused(after_brace("\"wall_lower_mm\": 9,"), "wall_lower_mm: expected this field once"));
  EXPECT_TRUE(refused(after_brace("\"profile_mm\": [],"), "profile_mm: expected this field once"));
  EXPECT_TRUE(refused(after_brace("\"more\": [[[1,2],[1,2],[1,2]]],"), "more: unknown field"));
  for (const char* field : {"written_by", "claim", "proof", "profile_mm"}) {
    std::string renamed = text;
    renamed.replace(renamed.find(field), 1, "_");
    EXPECT_FALSE(checked(renamed)) << field;
  }
  EXPECT_TRUE(
      refused(std::string("[").append(text).append("]"), "expected an object, found an array"));
  EXPECT_TRUE(refused("7", "expected a JSON object, found text that begins with '7'"));
}

// Each of these once exhausted the parser's stack, gigabytes of memory, or hours.
TEST(HostileCertificate, RefusesBombs) {
  EXPECT_TRUE(refused(repeated("[", 1'000'000), "expected an object"));
  EXPECT_TRUE(refused(with("profile_mm", repeated("[", 1'000'000)), "nested 4 deep"));
  EXPECT_TRUE(refused(with("bytes", repeated("[", 100'000) + repeated("]", 100'000)), "nested"));
  EXPECT_TRUE(refused(repeated("{\"a\":", 1'000'000), "found an object"));
  EXPECT_TRUE(refused(with("profile_mm", repeated("[],", 1'000'000, "[") + "[]]"), "3 points"));
  EXPECT_TRUE(refused(with("profile_mm", repeated("0,", 1'000'000, "[") + "0]"), "points"));
  EXPECT_TRUE(refused(with("profile_mm", repeated("0,", 1'000'000, "[[[") + "0]]]"), "a third"));
  std::string keys = "{";
  for (int i = 0; i < 300'000; ++i) keys.append("\"").append(std::to_string(i)).append("\":0,");
  EXPECT_TRUE(refused(keys + "\"z\":0}", "at most 64 fields"));
  const std::string long_text = repeated("x", 10'000'000, "\"") + "\"";
  for (const char* field : {"schema", "format", "proof", "content_hash", "claim"})
    EXPECT_TRUE(refused(with(field, long_text), "at most 1000 bytes")) << field;
  EXPECT_TRUE(refused(std::string("{").append(long_text).append(":0}"), "unknown field"))
      << "a long key";
  EXPECT_TRUE(
      refused(std::string(kMaxCertificateBytes + 1, ' '), "expected a certificate of at most"));
}

// The sweep would compare every tooth with every other.
TEST(HostileCertificate, RefusesCombs) {
  constexpr std::size_t kTeeth = 50'000;
  Polygon comb{{1, 0}};
  for (std::size_t i = 0; i < kTeeth; ++i) {
    const double rho = 1.0 + 1e-3 * static_cast<double>(i + 1);
    comb.push_back({rho, i % 2 == 0 ? 1.0 : 50.0});
  }
  comb.push_back({comb.back().rho, 0.0});
  const auto verdict = certify({{comb}});
  ASSERT_FALSE(verdict);
  EXPECT_NE(verdict.error().message.find("at most 1000 edges at one height"), std::string::npos)
      << verdict.error().message;
}

TEST(HostileCertificate, RandomEditsNeverPassNorThrow) {
  std::mt19937_64 random(7);
  const std::string& good = cup().text;
  const std::string alphabet = "0123456789-+.eE[]{},:\"ntu\\ \n\xff";
  const auto same = parse_certificate(good, "c.json").value();
  for (int k = 0; k < 3000; ++k) {
    std::string text = good;
    for (std::size_t edits = 1 + random() % 3; edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = alphabet[random() % alphabet.size()];
          break;
        case 1:
          text.erase(at, 1 + random() % 20);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 40));
      }
    }
    if (!checked(text)) continue;
    // Unchanged except for whitespace, text for people, or digits beyond double.
    const auto parsed = parse_certificate(text, "c.json");
    EXPECT_EQ(parsed->profile, same.profile);
    EXPECT_EQ(parsed->segments, same.segments);
    EXPECT_NEAR(parsed->wall_lower_mm, same.wall_lower_mm, 1e-8);
    EXPECT_NEAR(parsed->volume_mm3, same.volume_mm3, 1e-8 * same.volume_mm3);
  }
}

}  // namespace
}  // namespace clay::solid
