#pragma once
// Checks pots in the background: on a thread, or in the worker of a web page.

#include "app/studio/readings/pot_check.hpp"

#include <memory>
#include <optional>

namespace clay::studio {

/// Answers the newest question only, see NewestWorker.
class PotChecker {
 public:
  /// Without `background`, the question is answered during the call that asks it.
  explicit PotChecker(bool background);
  ~PotChecker();
  PotChecker(const PotChecker&) = delete;
  PotChecker& operator=(const PotChecker&) = delete;

  void ask(PotQuestion question);
  /// The newest answer; each is returned once.
  [[nodiscard]] std::optional<PotCheck> take();
  /// True while a question waits or is worked on, or its answer has not been taken.
  [[nodiscard]] bool busy() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace clay::studio
