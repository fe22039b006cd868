#pragma once
// A worker of the page: it has its own copy of the module `claystack`, so the picture does not stop
// while it works. Messages: job_message.hpp.

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace clay::web {

class PageWorker {
 public:
  enum class Slot { check, exporting, lesson };

  explicit PageWorker(Slot slot);
  ~PageWorker();
  PageWorker(const PageWorker&) = delete;
  PageWorker& operator=(const PageWorker&) = delete;

  /// Only when it is not busy.
  void post(std::string_view message);
  /// The answer, once. Empty text: the worker failed.
  [[nodiscard]] std::optional<std::string> take();
  /// True from the question until its answer has been taken.
  [[nodiscard]] bool busy() const noexcept { return busy_; }
  [[nodiscard]] const std::string& stage() const noexcept { return stage_; }
  /// Ends the job without an answer.
  void stop();

  /// Called by the page.
  static void receive(int slot, std::string_view message);
  static void show_stage(int slot, std::string_view stage);

 private:
  static std::array<PageWorker*, 3> all_;  // by slot
  Slot slot_;
  bool busy_ = false;
  std::optional<std::string> answer_;
  std::string stage_;
};

}  // namespace clay::web
