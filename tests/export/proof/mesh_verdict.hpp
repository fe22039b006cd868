#pragma once
// The verdicts of a report, for tests to compare and to print.

#include "claystack/export/proof.hpp"

#include <algorithm>
#include <ostream>
#include <string>

namespace clay::solid::samples {

/// The verdicts of a report as one comparable value.
struct Verdict {
  bool closed, manifold, oriented, bounds_volume, crosses;
  friend bool operator==(const Verdict&, const Verdict&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Verdict& v) {
    return out << "closed " << v.closed << " manifold " << v.manifold << " oriented " << v.oriented
               << " bounds_volume " << v.bounds_volume << " crosses " << v.crosses;
  }
};

inline Verdict verdict(const MeshReport& r) {
  return {r.closed, r.manifold, r.oriented, r.bounds_volume, r.self_intersections > 0};
}

inline constexpr Verdict kSound{true, true, true, true, false};

inline const MeshProblem* find(const MeshReport& report, const std::string& what) {
  const auto found = std::find_if(report.problems.begin(), report.problems.end(),
                                  [&](const MeshProblem& p) { return p.what == what; });
  return found == report.problems.end() ? nullptr : &*found;
}

inline std::string names(const MeshReport& report) {
  std::string all;
  for (const MeshProblem& p : report.problems)
    all += p.what + " (" + std::to_string(p.count) + ") " + p.where + "; ";
  return all;
}

}  // namespace clay::solid::samples
