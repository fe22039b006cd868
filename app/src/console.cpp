#include "console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <utility>

namespace clay::app {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(300);
constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr std::size_t kBarWidth = 32;

}  // namespace

std::string pretty(const Json& data) {
  return data.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void Console::print(const Json& data) const { fmt::print("{}", pretty(data)); }

void Console::say(std::string_view line) const {
  if (!json && !quiet) fmt::print("{}\n", line);
}

void Console::warn(std::string_view line) const { fmt::print(stderr, "claystack: {}\n", line); }

Result<void> check_distinct(const std::vector<std::string>& outputs,
                            const std::vector<std::string>& inputs) {
  std::vector<std::filesystem::path> seen;
  const auto place = [](const std::string& name) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(name, ignored);
  };
  const auto named = [](const std::string& name) { return !name.empty() && name != "-"; };
  for (const std::string& input : inputs)
    if (named(input)) seen.push_back(place(input));
  for (const std::string& output : outputs) {
    if (!named(output)) continue;
    if (std::find(seen.begin(), seen.end(), place(output)) != seen.end())
      return failure(
          ErrorKind::bad_input,
          output + ": expected a file of its own to write, found it named twice or read from");
    seen.push_back(place(output));
  }
  return {};
}

std::function<std::string(const std::string&)> in_range(double low, double high) {
  return [=](const std::string& text) -> std::string {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    // Not (value < low): NaN must fail.
    if (error == std::errc() && end == text.data() + text.size() && value >= low && value <= high)
      return {};
    return fmt::format("expected a number from {:g} to {:g}, found {}", low, high, text);
  };
}

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

StatusLine::StatusLine(const Console& console)
    : enabled_(!console.quiet && isatty(STDERR_FILENO) == 1), next_(Clock::now() + kPatience) {}

bool StatusLine::due() {
  if (!enabled_ || Clock::now() < next_) return false;
  next_ = Clock::now() + kRedraw;
  return true;
}

void StatusLine::show(std::string_view text) {
  if (!enabled_) return;
  fmt::print(stderr, "\r\033[K{}", text);
  std::fflush(stderr);
  drawn_ = true;
}

void StatusLine::clear() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
  drawn_ = false;
}

Progress::Progress(const Console& console, std::string label, std::size_t total)
    : line_(console), label_(std::move(label)), total_(total) {}

void Progress::update(std::size_t done) {
  if (!line_.due() || total_ == 0) return;
  const std::size_t filled = kBarWidth * done / total_;
  line_.show(fmt::format("{} [{}{}] {:3} %", label_, std::string(filled, '#'),
                         std::string(kBarWidth - filled, '.'), 100 * done / total_));
}

void Progress::stage(std::string_view name) { line_.show(fmt::format("{}: {} ...", label_, name)); }

}  // namespace clay::app
