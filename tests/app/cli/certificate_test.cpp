// Certificates as files: written by export, verified by check.

#include "claystack/export/formats.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>
#include <filesystem>
#include <string>

namespace clay::test {
namespace {

class CertifiedVase : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(claystack("throw -q " + sample("vase.scene.json") + " -o " + pot).status, 0);
    const Ran run = claystack(std::string("export -q --certificate ") + pot + " " + stl + " " +
                              obj + " " + drc + " " + ply + " " + three_mf + " " + glb);
    ASSERT_EQ(run.status, 0) << run.err;
  }
  static Ran check(const std::string& file, const std::string& certificate) {
    return claystack(std::string("check ") + file + " --certificate " + certificate);
  }
  ScratchFolder folder;
  std::string pot = folder.file("v.pot.json");
  std::string stl = folder.file("v.stl"), obj = folder.file("v.obj"), drc = folder.file("v.drc");
  std::string ply = folder.file("v.PLY"), three_mf = folder.file("v.3MF"),
              glb = folder.file("v.GLB");
};

TEST_F(CertifiedVase, IsVerifiedInEveryFormat) {
  for (const std::string& file : {stl, obj, drc, ply, three_mf, glb}) {
    const Ran run = check(file, file + ".certificate.json");
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("certificate holds"), std::string::npos) << run.out;
    const auto json = claystack(std::string("check --json ") + file + " --certificate " + file +
                                ".certificate.json")
                          .json();
    EXPECT_TRUE(json.at("certificate").at("holds"));
  }
}

TEST_F(CertifiedVase, ConformsToItsSchema) {
  const Json schema = load_schema("certificate");
  for (const std::string& file : {stl, obj, drc, ply, three_mf, glb})
    EXPECT_EQ(violation(schema, Json::parse(read_text(file + ".certificate.json"))), "");
  const Json process = Json::parse(read_text(sample("workshop.process.json")));
  EXPECT_EQ(violation(load_schema("process"), process), "");
}

TEST(CertificateSchema, NamesEveryWrittenFormat) {
  std::vector<std::string> names;
  for (const solid::FormatFacts& facts : solid::kFormatFacts)
    if (facts.written || facts.ending.empty()) names.emplace_back(facts.name);
  EXPECT_EQ(load_schema("certificate").at("properties").at("format").at("enum"), Json(names));
}

TEST_F(CertifiedVase, ReportsASwappedCertificate) {
  const Ran run = check(stl, obj + ".certificate.json");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE((run.out + run.err).find("format: the certificate states obj"), std::string::npos)
      << run.out << run.err;
}

TEST_F(CertifiedVase, ReportsAnEditedByte) {
  std::string bytes = read_text(stl);
  bytes[84 + 50 * 7 + 20] ^= 1;
  write_text(stl, bytes);
  const Ran run = check(stl, stl + ".certificate.json");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE((run.out + run.err).find("content hash"), std::string::npos) << run.out << run.err;
}

TEST_F(CertifiedVase, ReportsAnEditedDracoByteWithoutACertificate) {
  std::string bytes = read_text(drc);
  bytes[bytes.size() / 2] ^= 1;
  write_text(drc, bytes);
  const Ran run = claystack("check " + drc);
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("checksum: expected"), std::string::npos) << run.err;
}

TEST_F(CertifiedVase, ReportsAFalseClaim) {
  std::string text = read_text(stl + ".certificate.json");
  const std::string field = "\"wall_lower_mm\": ";
  const std::size_t at = text.find(field);
  ASSERT_NE(at, std::string::npos);
  text[at + field.size()] = '9';
  write_text(stl + ".certificate.json", text);
  const Ran run = check(stl, stl + ".certificate.json");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE((run.out + run.err).find("minimum wall"), std::string::npos) << run.out << run.err;
}

TEST_F(CertifiedVase, RefusesAFileThatIsNotACertificate) {
  EXPECT_EQ(check(stl, pot).status, 2);
  EXPECT_EQ(check(stl, folder.file("none.json")).status, 3);
  const Ran pots = check(pot, stl + ".certificate.json");
  EXPECT_EQ(pots.status, 2) << pots.out;
}

TEST_F(CertifiedVase, RefusesAHostileCertificateInOneLine) {
  const std::string good = read_text(stl + ".certificate.json"), bad = folder.file("bad.json");
  const auto refused = [&](const std::string& text, int status, const std::string& says) {
    write_text(bad, text);
    const Ran run = check(stl, bad);
    EXPECT_EQ(run.status, status) << says;
    EXPECT_NE((run.out + run.err).find(says), std::string::npos) << run.err.substr(0, 500);
    EXPECT_LT((run.out + run.err).size(), 1000u) << says;
  };
  const auto with = [&](const std::string& field, const std::string& value) {
    std::string text = good;
    const std::size_t begin = text.find("\"" + field + "\": ") + field.size() + 4;
    return text.replace(begin, text.find(",\n", begin) - begin, value);
  };
  refused(with("segments", "1000000000"), 1, "3 to 1048576 segments");
  refused(with("segments", "1048576"), 1, "profile and segments: the certificate states");
  refused(with("bytes", std::string(1'000'000, '[')), 2, "nested 4 deep");
  refused(with("rounding_mm", "1e999"), 2, "number overflow");
  refused(with("format", "\"obj\""), 1, "format: the certificate states obj");
  refused(good.substr(0, good.size() / 2), 2, "parse error");
  refused("", 2, "found an empty file");
  refused(with("format", "\"\xff\""), 2, "UTF-8");
}

}  // namespace
}  // namespace clay::test
