// The properties of a Draco file of a pot, on the sample pots.

#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"
#include "export/solid/vertex_distance.hpp"
#include "tests/export/job/sample_pots.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace clay::solid {
namespace {

constexpr double kToleranceMm = 0.01;

struct Written {
  ExportReport report;
  std::string stl, drc;
};

class DrcOfSample : public testing::TestWithParam<const char*> {
 protected:
  static Written written() {
    MemoryStore stl, drc;
    ExportOptions options;
    options.tolerance_mm = kToleranceMm;
    auto report = run_export(samples::thrown_pot(GetParam()).value(),
                             {{MeshFormat::stl_binary, &stl}, {MeshFormat::drc, &drc}}, options);
    return {std::move(report.value()), stl.bytes(), drc.bytes()};
  }
};

TEST_P(DrcOfSample, IsAtMost15ThousandthsOfTheStl) {
  const Written pot = written();
  EXPECT_LE(1000 * pot.drc.size(), 15 * pot.stl.size());
}

TEST_P(DrcOfSample, KeepsEveryVertexWithinTheTolerance) {
  const Written pot = written();
  const TriangleMesh stl = decode_stl(pot.stl, "stl").value();
  const TriangleMesh drc = decode_drc(pot.drc, "drc").value();
  ASSERT_EQ(drc.triangles.size(), stl.triangles.size());
  ASSERT_EQ(drc.points.size(), stl.points.size());
  // Twice float32's rounding at 200 mm: the grid was chosen for the rounded points in the STL.
  EXPECT_LE(vertex_distance(stl, drc), kToleranceMm + 2.0 * 200.0 * 0x1p-24);
}

TEST_P(DrcOfSample, ClaimsMatchTheReport) {
  const Written pot = written();
  const DracoClaims claims = drc_claims(pot.drc, "drc").value().value();
  EXPECT_EQ(claims.volume_mm3, pot.report.volume.solid_mm3);
  EXPECT_EQ(claims.counted_volume_mm3, pot.report.prepared.counted_volume_mm3);
  EXPECT_NEAR(claims.counted_volume_mm3 / claims.volume_mm3, 1.0, 1e-9);
  EXPECT_LE(claims.vertex_error_mm, kToleranceMm);
  EXPECT_GE(claims.vertex_error_mm, pot.report.files[1].max_error_mm);
  EXPECT_EQ(pot.report.files[1].certificate->counted_volume_mm3,
            pot.report.prepared.counted_volume_mm3);
  EXPECT_LT(claims.volume_bound_mm3, 0.01 * claims.volume_mm3);
  EXPECT_TRUE(compare_with_claims(decode_drc(pot.drc, "drc").value(), claims).empty());
}

INSTANTIATE_TEST_SUITE_P(All, DrcOfSample, testing::ValuesIn(samples::kStandingPots),
                         [](const auto& sample) { return std::string(sample.param); });

}  // namespace
}  // namespace clay::solid
