#pragma once
// Shared by all commands: errors, progress, output, exit status.

#include "claystack/core/result.hpp"

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace clay::cli {

/// Exit statuses of all programs.
enum Exit { kDone = 0, kUnsound = 1, kBadInput = 2, kIoFailed = 3, kDeviceFailed = 4 };

/// Writes text to standard output, in the order of calls. Never throws; a failure is recorded and
/// makes the exit status 3 at the end. Nothing else in the programs writes there.
void put_out(std::string_view text) noexcept;
/// Writes the buffer of put_out. False: a write failed, now or before.
bool flush_out() noexcept;
/// Writes text to standard error, unbuffered. Never throws; failures are ignored.
void put_err(std::string_view text) noexcept;

struct Console {
  bool json = false;          ///< data as JSON on stdout
  bool quiet = false;         ///< no progress, no summary: errors and requested data only
  bool verbose = false;       ///< also details for engineers
  bool no_overwrite = false;  ///< refuse outputs that exist

  void print(std::string_view line) const;   ///< to stdout, for people; silent with json or quiet
  void detail(std::string_view line) const;  ///< as `print`, if verbose
  void warn(std::string_view line) const;    ///< "claystack: warning: LINE" to stderr
  void error(std::string_view line) const;   ///< "claystack: LINE" to stderr; the work goes on
};

/// "claystack: MESSAGE" on stderr; the exit status of the error's kind. With `print_errors_as_json`
/// also an object on stdout, samples/schema/error.schema.json.
int report(const Error& error);
/// For `--json`, from now on.
void print_errors_as_json() noexcept;

/// Prints the parser's output: help, version or a usage error.
int report(const CLI::App& app, const CLI::ParseError& error);

/// Runs a whole program: returns the result of `run` as exit status, unless standard output could
/// not be written or an exception occurred. Closed standard streams are opened so that they fail,
/// so that no file takes their number. A file that exceeds its size limit is an error, not a
/// signal.
int run_program(int (*run)(int argc, char** argv), int argc, char** argv) noexcept;

/// One line on stderr that is overwritten, and cleared when anything else is printed; only on a
/// terminal.
class StatusLine {
 public:
  explicit StatusLine(const Console& console);
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  [[nodiscard]] bool due();  ///< ten times a second, if there is a terminal
  void show(std::string_view text);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_;
  Clock::time_point next_;
};

/// A progress bar on stderr; only on a terminal and for longer work. Everything that may take more
/// than 2 s has one, or a stage.
class Progress {
 public:
  Progress(const Console& console, std::string label, std::size_t total);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void update(std::size_t done);
  /// For work in named stages instead of counts: the part of the stage that is done, 0 to 1.
  void stage(std::string_view name, double share = 0.0);
  void clear() { line_.clear(); }

 private:
  StatusLine line_;
  std::string label_;
  std::size_t total_;
};

}  // namespace clay::cli
