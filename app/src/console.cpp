#include "console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <limits>
#include <utility>

namespace clay::app {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(300);
constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr std::size_t kBarWidth = 32;

}  // namespace

void Console::print(const Json& data) const { fmt::print("{}\n", data.dump(2)); }

void Console::say(std::string_view line) const {
  if (!json && !quiet) fmt::print("{}\n", line);
}

void Console::warn(std::string_view line) const { fmt::print(stderr, "claystack: {}\n", line); }

int report(const Error& error) {
  fmt::print(stderr, "claystack: {}\n", error.message);
  switch (error.kind) {
    case ErrorKind::unsound:
      return kUnsound;
    case ErrorKind::bad_input:
      return kBadInput;
    case ErrorKind::io:
      return kIoFailed;
    case ErrorKind::device:
      return kDeviceFailed;
  }
  return kBadInput;
}

Json json_count(WideQuanta count) {
  using Limits = std::numeric_limits<std::int64_t>;
  if (count < Limits::min() || count > Limits::max()) return to_string(count);
  return static_cast<std::int64_t>(count);
}

Progress::Progress(const Console& console, std::string label, std::size_t total)
    : label_(std::move(label)),
      total_(total),
      enabled_(!console.quiet && isatty(STDERR_FILENO) == 1),
      next_(Clock::now() + kPatience) {}

Progress::~Progress() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

bool Progress::due() {
  if (!enabled_ || Clock::now() < next_) return false;
  next_ = Clock::now() + kRedraw;
  return true;
}

void Progress::draw(std::string_view text) {
  fmt::print(stderr, "\r\033[K{}", text);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::update(std::size_t done) {
  if (!due() || total_ == 0) return;
  const std::size_t filled = kBarWidth * done / total_;
  draw(fmt::format("{} [{}{}] {:3} %", label_, std::string(filled, '#'),
                   std::string(kBarWidth - filled, '.'), 100 * done / total_));
}

void Progress::stage(std::string_view name) {
  if (enabled_) draw(fmt::format("{}: {} ...", label_, name));
}

}  // namespace clay::app
