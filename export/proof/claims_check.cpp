#include "claystack/export/proof.hpp"

#include "core/text.hpp"

#include <cmath>

namespace clay::solid::inline proof {

std::vector<MeshProblem> compare_with_claims(const TriangleMesh& decoded,
                                             const DracoClaims& claims) {
  constexpr double kSummation = 1e-9;
  const double volume = signed_volume(decoded);
  const double allowed = claims.volume_bound_mm3 + kSummation * claims.volume_mm3;
  if (std::abs(volume - claims.volume_mm3) <= allowed) return {};
  return {{"volume differs from the one the file states",
           "expected " + nine_digit_text(claims.volume_mm3) + " mm3 within " +
               nine_digit_text(allowed) + ", found " + nine_digit_text(volume) + " mm3",
           1}};
}

}  // namespace clay::solid::inline proof
