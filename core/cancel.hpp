#pragma once
// Giving up in mid-work: long loops ask now and then whether anyone still wants what comes of them.

#include <functional>

namespace clay {

/// The job is no longer wanted; no fault of its own. No std::exception: who makes errors of those
/// lets it pass.
struct Cancelled {};

/// For as long as it lives, what this thread works on is part of a job that may be given up. A
/// thread that helps it begins a scope of its own, with its `current()`. Scopes nest.
class CancelScope {
 public:
  using Question = std::function<bool()>;  ///< true: given up; asked from several threads

  /// Null: what is worked on is not given up. The question outlives the scope.
  explicit CancelScope(const Question* question) noexcept;
  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

  [[nodiscard]] static const Question* current() noexcept;

 private:
  const Question* before_;
};

/// Throws Cancelled where the job has been given up.
void stop_if_cancelled();

inline thread_local unsigned loop_steps = 0;

/// Of a long loop, once around: stop_if_cancelled() at every 1024th.
inline void step_of_loop() {
  if (++loop_steps % 1024 == 0) stop_if_cancelled();
}

}  // namespace clay
