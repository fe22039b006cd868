#pragma once
// What every command says the same way: errors, progress, JSON, exit status.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"

#include <chrono>
#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace clay::cli {

using Json = nlohmann::ordered_json;

/// Exit statuses of the outer face.
enum Exit { kDone = 0, kUnsound = 1, kBadInput = 2, kIoFailed = 3, kDeviceFailed = 4 };

/// A whole JSON document for a file or a script. Names of files may be no UTF-8: what is none is
/// replaced, as a document cannot hold it.
[[nodiscard]] std::string pretty(const Json& data);

/// Text to standard output, in the order of the calls. Never throws; a failure is remembered until
/// the end, where it makes the exit status 3. Nothing else in the programs writes there.
void put_out(std::string_view text) noexcept;
/// Sends on what put_out holds back. False: some of it could not be written, now or before.
bool flush_out() noexcept;
/// Text to standard error, at once. Never throws: what nobody can read is lost.
void put_err(std::string_view text) noexcept;

struct Console {
  bool json = false;   ///< data as JSON on stdout
  bool quiet = false;  ///< no progress, no summary: errors and asked-for data only

  void print(const Json& data) const;      ///< one JSON document, pretty
  void say(std::string_view line) const;   ///< to stdout, for people; silent with json or quiet
  void warn(std::string_view line) const;  ///< to stderr
};

/// Refuses, before any work, files to write that are one and the same, or one of the inputs. "-"
/// and empty names are let pass.
Result<void> check_distinct(const std::vector<std::string>& outputs,
                            const std::vector<std::string>& inputs);

/// For CLI options: a finite number within the range, said in short numbers.
[[nodiscard]] std::function<std::string(const std::string&)> in_range(double low, double high);

/// "claystack: MESSAGE" on stderr; the exit status of the error's kind.
int report(const Error& error);

/// Prints what the parser has to say: help, the version or what is wrong with the command line.
int report(const CLI::App& app, const CLI::ParseError& error);

/// The whole of a program: what `run` returns is the exit status, unless standard output could not
/// be written or an exception came out of it. Standard streams that are closed become ones that
/// fail, so that no file takes their number. A file that grows past its limit is an error, no
/// signal.
int run_program(int (*run)(int argc, char** argv), int argc, char** argv) noexcept;

/// A count for JSON: a number where 64 bits hold it, decimal digits in a string where not.
[[nodiscard]] Json json_count(WideQuanta count);

/// One line on stderr that is written over again, only on a terminal.
class StatusLine {
 public:
  explicit StatusLine(const Console& console);
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  [[nodiscard]] bool due();  ///< ten times a second, where there is anything to draw on
  void show(std::string_view text);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_;
  bool drawn_ = false;
  Clock::time_point next_;
};

/// A bar on stderr, drawn only on a terminal and only for work that takes a while.
class Progress {
 public:
  Progress(const Console& console, std::string label, std::size_t total);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void update(std::size_t done);
  void stage(std::string_view name);  ///< for work in named stages instead of counts

 private:
  StatusLine line_;
  std::string label_;
  std::size_t total_;
};

}  // namespace clay::cli
