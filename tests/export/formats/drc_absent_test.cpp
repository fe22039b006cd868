#include "claystack/export/formats.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>

namespace clay::solid {
namespace {

TEST(DrcAbsent, ReportsThatDracoIsAbsent) {
  EXPECT_EQ(encode_drc(samples::tetrahedron(), {}).error().message,
            "cannot write .drc: this build has no Draco");
  EXPECT_EQ(drc_claims("DRACO", "pot.drc").error().message,
            "pot.drc: cannot read .drc: this build has no Draco");
  EXPECT_EQ(decode_drc("DRACO", "pot.drc").error().message,
            "pot.drc: cannot read .drc: this build has no Draco");
}

}  // namespace
}  // namespace clay::solid
