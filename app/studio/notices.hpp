#pragma once
// What the window has to tell: one banner at a time, the gravest first, until it is closed or its
// time is over.

#include <optional>
#include <string>

namespace clay::studio {

enum class Grade { note, warning, fault };

struct Notice {
  Grade grade = Grade::note;
  std::string text;
  double until_s = 0.0;  ///< of the host's clock; 0: until it is closed
};

class Notices {
 public:
  void say(Grade grade, std::string text, double until_s = 0.0) {
    if (!notice_ || grade >= notice_->grade) notice_ = Notice{grade, std::move(text), until_s};
  }
  void close() { notice_.reset(); }
  /// What is no longer so.
  void take_back(const std::string& text) {
    if (notice_ && notice_->text == text) notice_.reset();
  }
  void forget_old(double now_s) {
    if (notice_ && notice_->until_s > 0.0 && now_s > notice_->until_s) notice_.reset();
  }
  [[nodiscard]] const std::optional<Notice>& shown() const noexcept { return notice_; }

 private:
  std::optional<Notice> notice_;
};

}  // namespace clay::studio
