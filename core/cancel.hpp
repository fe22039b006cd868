#pragma once
// Cancellation: long loops check at intervals whether their result is still needed.

#include <functional>

namespace clay {

/// Thrown when the job was cancelled; not an error. It does not derive from std::exception, so that
/// handlers of errors let it pass.
struct Cancelled {};

/// While a scope exists, the work of this thread belongs to a job that can be cancelled. A helper
/// thread opens its own scope with the `current()` of the thread it helps. Scopes nest.
class CancelScope {
 public:
  using Question = std::function<bool()>;  ///< true: cancelled; called from several threads

  /// Null: the work cannot be cancelled. `question` must outlive the scope.
  explicit CancelScope(const Question* question) noexcept;
  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

  [[nodiscard]] static const Question* current() noexcept;

 private:
  const Question* before_;
};

/// Throws Cancelled if the job was cancelled.
void stop_if_cancelled();

inline thread_local unsigned loop_steps = 0;

/// Call once per iteration of a long loop: calls stop_if_cancelled() every 1024th time.
inline void step_of_loop() {
  if (++loop_steps % 1024 == 0) stop_if_cancelled();
}

}  // namespace clay
