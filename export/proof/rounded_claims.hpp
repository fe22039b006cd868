#pragma once
#include "claystack/export/proof.hpp"
#include "export/solid/revolve_layout.hpp"

namespace clay::solid::inline proof {

/// The claims on a solid before any rounding, widened for one: for several files of one solid.
SolidCertificate with_rounding(SolidCertificate claims, const RevolveLayout& rule,
                               double rounding_mm);

}  // namespace clay::solid::inline proof
