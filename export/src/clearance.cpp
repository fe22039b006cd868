#include "claystack/export/clearance.hpp"
#include <algorithm>
#include <cmath>
namespace clay::solid {
double clearance_mm(const Profile& profile) {
  double least = 1e300;
  for (const auto& A : profile.pieces)
    for (std::size_t i = 0; i < A.size(); ++i)
      for (const auto& B : profile.pieces)
        for (std::size_t j = 0; j < B.size(); ++j) {
          const auto &a = B[j], &b = B[(j + 1) % B.size()];
          const auto& p = A[i];
          if (&p == &a || &p == &b) continue;
          const double x = b.rho - a.rho, y = b.y - a.y;
          const double t =
              std::clamp(((p.rho - a.rho) * x + (p.y - a.y) * y) / (x * x + y * y), 0.0, 1.0);
          least = std::min(least, std::hypot(p.rho - a.rho - t * x, p.y - a.y - t * y));
        }
  return least;
}
}  // namespace clay::solid
