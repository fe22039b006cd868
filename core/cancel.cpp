#include "core/cancel.hpp"

namespace clay {
namespace {

thread_local const CancelScope::Question* asked = nullptr;

}  // namespace

CancelScope::CancelScope(const Question* question) noexcept : before_(asked) {
  asked = question;
  loop_steps = 0;
}

CancelScope::~CancelScope() { asked = before_; }

const CancelScope::Question* CancelScope::current() noexcept { return asked; }

void stop_if_cancelled() {
  if (asked != nullptr && (*asked)()) throw Cancelled();
}

}  // namespace clay
