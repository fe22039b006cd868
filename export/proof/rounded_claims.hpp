#pragma once
#include "claystack/export/proof.hpp"
#include "export/solid/revolve_rule.hpp"

namespace clay::solid {

/// The claims on a solid before any rounding, widened for one: for several files of one solid.
SolidCertificate with_rounding(SolidCertificate claims, const RevolveRule& rule,
                               double rounding_mm);

}  // namespace clay::solid
