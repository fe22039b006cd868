#include "app/cli/console.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/usage.hpp"
#include "claystack/core/atomic_file.hpp"
#include "core/text.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace clay::cli {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(300);
constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr std::size_t kBarWidth = 32;

/// Opens closed standard streams, so that no file gets their numbers. Opened in the wrong
/// direction: using them still fails.
void reserve_standard_streams() noexcept {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1)
      (void)open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

bool json_errors = false;

/// Formats without an allocation.
template <class... Values>
void put_formatted(void (*put)(std::string_view) noexcept, const char* format, Values... values) {
  std::array<char, 256> text{};
  const int size = std::snprintf(text.data(), text.size(), format, values...);
  put({text.data(), static_cast<std::size_t>(size)});
}

int out_of_memory() noexcept {
  std::array<char, 160> message{"out of memory; close other programs, or choose a smaller job"};
  if (memory_limit() > 0)
    (void)std::snprintf(message.data(), message.size(),
                        "out of memory, with a limit of %.2g GB; raise --memory, close other "
                        "programs, or choose a smaller job",
                        static_cast<double>(memory_limit()) / 1e9);
  put_formatted(put_err, "claystack: %s\n", message.data());
  if (json_errors && !json_printed())
    put_formatted(put_out, "{\n  \"error\": \"%s\",\n  \"kind\": \"io\",\n  \"status\": %d\n}\n",
                  message.data(), static_cast<int>(kIoFailed));
  (void)flush_out();
  return kIoFailed;
}

/// For std::terminate: a failed allocation may end here, because a destructor of the JSON library
/// allocates, and threads have no handler. Does nothing where a handler of SIGABRT releases a
/// device.
[[noreturn]] void end_without_memory() noexcept {
  struct sigaction abort_action {};
  const bool released =
      ::sigaction(SIGABRT, nullptr, &abort_action) == 0 && abort_action.sa_handler == SIG_DFL;
  try {
    if (released && std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::bad_alloc&) {
    remove_temporary_files();
    ::_exit(out_of_memory());
  } catch (...) {
  }
  std::abort();
}

constexpr std::string_view kEraseLine = "\r\033[K";
/// Whether the terminal shows a status line, which must be cleared before anything else is printed.
bool line_shown = false;

void write_err(std::string_view text) noexcept {
  (void)std::fwrite(text.data(), 1, text.size(), stderr);
}

void erase_line() noexcept {
  if (std::exchange(line_shown, false)) write_err(kEraseLine);
}

/// A name of a file may hold characters that act on the terminal, hide text or begin a new line.
std::string one_line(std::string_view text) { return shown(text, text.size()) + "\n"; }

/// "claystack: MESSAGE" on one line.
void put_message(std::string_view message) { put_err("claystack: " + one_line(message)); }

int unexpected(const char* what) noexcept try {
  return report({ErrorKind::io, std::string("unexpected failure: ").append(what)});
} catch (...) {
  return kIoFailed;
}

}  // namespace

void put_out(std::string_view text) noexcept {
  erase_line();
  (void)std::fwrite(text.data(), 1, text.size(), stdout);
}

bool flush_out() noexcept { return std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

void put_err(std::string_view text) noexcept {
  erase_line();
  write_err(text);
}

void Console::print(std::string_view line) const {
  if (!json && !quiet) put_out(one_line(line));
}

void Console::detail(std::string_view line) const {
  if (verbose) print(line);
}

void Console::warn(std::string_view line) const {
  put_message(std::string("warning: ").append(line));
}

void Console::error(std::string_view line) const { put_message(line); }

namespace {

struct KindText {
  const char* name;
  Exit exit;
};
KindText text_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::unsound:
      return {"unsound", kUnsound};
    case ErrorKind::bad_input:
      return {"bad_input", kBadInput};
    case ErrorKind::io:
      return {"io", kIoFailed};
    case ErrorKind::device:
      return {"device", kDeviceFailed};
  }
  return {"bad_input", kBadInput};
}

/// One JSON document at most: the summary of a command that fails late has the fields already.
int report_as(const Error& error, Json fields) {
  fields.update(error_json(error));
  if (json_errors && !json_printed()) print_json(fields);
  return text_of(error.kind).exit;
}

}  // namespace

void print_errors_as_json() noexcept { json_errors = true; }

Json error_json(const Error& error) {
  const KindText kind = text_of(error.kind);
  return {{"error", error.message}, {"kind", kind.name}, {"status", static_cast<int>(kind.exit)}};
}

int report(const Error& error) { return report(error, Json::object()); }

int report(const Error& error, Json fields) {
  put_message(error.message);
  return report_as(error, std::move(fields));
}

int report(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    std::ostringstream out;
    app.exit(error, out, out);
    put_out(out.str());
    return kDone;
  }
  const std::string message = usage_message(app, error);
  const auto parsed = app.get_subcommands();
  put_message(message);
  put_err(fmt::format("run {}{} --help for usage\n", app.get_name(),
                      parsed.empty() ? "" : " " + parsed.front()->get_name()));
  return report_as({ErrorKind::bad_input, message}, Json::object());
}

int run_program(int (*run)(int argc, char** argv), int argc, char** argv) noexcept {
  reserve_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(end_without_memory);
  try {
    const int exit = run(argc, argv);
    // Output that could not be printed is a failure.
    return flush_out() ? exit : report({ErrorKind::io, "standard output: could not write"});
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  } catch (const std::exception& error) {
    return unexpected(error.what());
  } catch (...) {
    return unexpected("an unknown exception");
  }
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
  write_err(fmt::format("{}{}", kEraseLine, text));
  line_shown = true;
}

void StatusLine::clear() {
  if (enabled_) erase_line();
}

Progress::Progress(const Console& console, std::string label, std::size_t total)
    : line_(console), label_(std::move(label)), total_(total) {}

void Progress::update(std::size_t done) {
  if (!line_.due() || total_ == 0) return;
  const std::size_t filled = kBarWidth * done / total_;
  line_.show(fmt::format("{} [{}{}] {:3} %", label_, std::string(filled, '#'),
                         std::string(kBarWidth - filled, '.'), 100 * done / total_));
}

void Progress::stage(std::string_view name, double share) {
  if (share > 0.0)
    line_.show(fmt::format("{}: {} ... {:.0f} %", label_, name, 100.0 * share));
  else
    line_.show(fmt::format("{}: {} ...", label_, name));
}

}  // namespace clay::cli
