#pragma once
#include "claystack/export/proof.hpp"
#include "export/solid/revolve_layout.hpp"

namespace clay::solid::inline proof {

/// Widens the claims on a solid before rounding by one rounding: for several files of one solid.
SolidCertificate with_rounding(SolidCertificate claims, const RevolveLayout& rule,
                               double rounding_mm);

}  // namespace clay::solid::inline proof
