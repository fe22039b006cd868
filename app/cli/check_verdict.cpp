#include "app/cli/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace clay::cli {

std::string_view name_of(MeshState state) {
  switch (state) {
    case MeshState::sound:
      return "sound";
    case MeshState::prints:
      return "prints";
    case MeshState::will_not_print:
      return "will not print";
    default:
      return "unreadable";
  }
}

MeshState state_of(const solid::TriangleMesh& mesh, const solid::MeshReport& report) {
  if (report.sound()) return MeshState::sound;
  return solid::slicer_unites(mesh, report) ? MeshState::prints : MeshState::will_not_print;
}

std::string_view name_of(Grade grade) {
  return grade == Grade::pass ? "pass" : grade == Grade::warn ? "warn" : "fail";
}

std::string problem_text(const solid::MeshProblem& problem) {
  return fmt::format("{} ({}{}): {}", problem.what, problem.at_least ? "at least " : "",
                     problem.count, problem.where);
}

bool Verdict::passes(bool accept_prints) const {
  const bool accepted = state == MeshState::sound || (accept_prints && state == MeshState::prints);
  return accepted && !failure && std::ranges::none_of(findings, [](const Finding& finding) {
           return finding.grade == Grade::fail;
         });
}

Verdict not_examined(MeshState state, std::string what, std::string where) {
  Verdict verdict;
  verdict.state = state;
  verdict.examined = false;
  verdict.mesh.problems.push_back({std::move(what), std::move(where), 1, false});
  return verdict;
}

}  // namespace clay::cli
