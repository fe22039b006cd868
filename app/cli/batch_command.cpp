#include "app/cli/batch_outputs.hpp"
#include "app/cli/batch_pool.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/usage.hpp"

#include "claystack/core/atomic_file.hpp"
#include "core/file_reader.hpp"
#include "core/json/object_reader.hpp"
#include "core/line_reader.hpp"
#include "core/number_parsing.hpp"
#include "core/system_calls.hpp"
#include "core/text.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

namespace clay::cli {

static void describe(auto& io, Is<BatchJob> auto& job) {
  constexpr std::size_t kMostWords = 1000;
  io.require({"id", "run"});
  io.text("id", job.id);
  io.texts("run", job.words, kMostWords);
}

namespace {

constexpr std::size_t kMaxLineValues = 2000, kMaxBatchBytes = std::size_t{256} << 20;
constexpr const char* kSchema = "claystack-batch-1";
constexpr std::array kRunnable = {"check",  "export",  "import", "plan",
                                  "render", "strokes", "throw"};

struct BatchOptions {
  std::string jobs;
  std::string results;  ///< empty: standard output
  std::string part;     ///< "K/N"
  std::size_t processes = std::max(std::thread::hardware_concurrency(), 1U);
  double time_limit_s = 600.0;
};

/// Strict: a wrong line refuses the whole batch before the first job.
Result<std::vector<BatchJob>> read_jobs(const std::string& path) {
  auto text = read_file(path, kMaxBatchBytes);
  if (!text) return tl::make_unexpected(text.error());
  if (!text->empty() && text->back() != '\n') *text += '\n';
  std::vector<BatchJob> jobs;
  std::set<std::string> ids;
  LineReader lines(*text);
  while (const auto line = lines.next()) {
    if (line->find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const auto document = LocatedJson::from_json(*line, path, kMaxLineValues, lines.number());
    if (!document) return tl::make_unexpected(document.error());
    auto job = ObjectReader::read(*document, BatchJob{});
    if (!job) return tl::make_unexpected(job.error());
    if (!ids.insert(job->id).second)
      return tl::make_unexpected(
          document->field_error({"id"}, "expected a different id for each job, found " + job->id));
    if (job->words.empty() || std::ranges::find(kRunnable, job->words.front()) == kRunnable.end())
      return tl::make_unexpected(document->field_error(
          {"run"},
          fmt::format("expected one of {}, and its arguments, found {}", fmt::join(kRunnable, ", "),
                      job->words.empty() ? "nothing" : job->words.front())));
    jobs.push_back(std::move(*job));
  }
  return jobs;
}

/// Job K, K + N, ... of "K/N": the part of one task of a job array.
Result<std::vector<BatchJob>> part_of(std::vector<BatchJob> jobs, const std::string& part) {
  if (part.empty()) return jobs;
  const auto numbers = two_numbers<std::uint32_t>(part, '/');
  if (!numbers || numbers->first < 1 || numbers->first > numbers->second)
    return failure(ErrorKind::bad_input, "--part: expected K/N with K from 1 to N, found " + part);
  const std::size_t number = numbers->first, parts = numbers->second;
  std::vector<BatchJob> mine;
  for (std::size_t i = number - 1; i < jobs.size(); i += parts) mine.push_back(std::move(jobs[i]));
  return mine;
}

/// The results, one line per job, appended as the jobs end. A killed batch leaves whole lines.
class ResultFile {
 public:
  static Result<ResultFile> open(const std::string& path) {
    ResultFile file(path);
    if (path.empty()) return file;
    // A pipe that this process could read too would never end, and would outlive its reader.
    struct stat kind {};
    const bool written_only = ::stat(path.c_str(), &kind) == 0 && !S_ISREG(kind.st_mode);
    const int mode = written_only ? O_WRONLY : O_RDWR | O_CREAT;
    file.descriptor_ = ::open(path.c_str(), mode | O_APPEND | O_CLOEXEC, 0666);
    if (file.descriptor_ == -1) return file.io_failure("cannot open");
    if (::fstat(file.descriptor_, &kind) != 0) return file.io_failure("cannot open");
    if (!S_ISREG(kind.st_mode)) return file;
    if (::flock(file.descriptor_, LOCK_EX | LOCK_NB) != 0)
      return file.io_failure("cannot lock, another batch may write it");
    return file.read_done().map([&] { return std::move(file); });
  }

  ResultFile(ResultFile&& other) noexcept
      : path_(std::move(other.path_)),
        descriptor_(std::exchange(other.descriptor_, -1)),
        done_(std::move(other.done_)) {}
  ResultFile& operator=(ResultFile&&) = delete;
  ~ResultFile() {
    if (descriptor_ != -1) ::close(descriptor_);
  }

  /// Whether the lines go to standard output, by whatever name.
  [[nodiscard]] bool is_standard_output() const {
    struct stat own {};
    struct stat standard {};
    return descriptor_ == -1 ||
           (::fstat(descriptor_, &own) == 0 && ::fstat(STDOUT_FILENO, &standard) == 0 &&
            own.st_dev == standard.st_dev && own.st_ino == standard.st_ino);
  }

  /// The status of a job that an earlier batch finished: done, with a verdict. Empty for others,
  /// which run again.
  [[nodiscard]] std::optional<int> status_of(const BatchJob& job) const {
    const auto found = done_.find(Json(job.words).dump() + job.id);
    return found == done_.end() ? std::nullopt : std::optional(found->second);
  }

  Result<void> add(const Json& result) {
    const std::string line = result.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    if (descriptor_ == -1) {
      put_out(line);
      if (flush_out()) return {};
      return failure(ErrorKind::io, "standard output: could not write");
    }
    const auto size = ::lseek(descriptor_, 0, SEEK_END);
    if (write_all(descriptor_, line)) return {};
    const auto failed = io_failure("cannot write");
    if (size >= 0) (void)::ftruncate(descriptor_, size);  // if it fails, the next batch removes it
    return failed;
  }

 private:
  explicit ResultFile(std::string path) : path_(std::move(path)) {}

  [[nodiscard]] tl::unexpected<Error> io_failure(const char* what) const {
    return failure(ErrorKind::io,
                   path_ + ": " + what + ": " + std::generic_category().message(errno));
  }

  Result<void> read_done() {
    auto file = FileReader::open(path_);
    if (!file) return tl::make_unexpected(file.error());
    FileLines lines(std::move(*file), kMaxBatchBytes);
    for (;;) {
      const auto line = lines.next();
      if (!line) return tl::make_unexpected(line.error());
      if (!*line) break;
      const auto document = LocatedJson::from_json(**line, path_, SIZE_MAX, lines.number());
      if (!document) return tl::make_unexpected(document.error());
      const Json& one = document->root();
      const bool is_result = one.is_object() && one.contains("id") && one.at("id").is_string() &&
                             one.contains("run") && one.contains("status") &&
                             one.at("status").is_number_integer();
      if (!is_result)
        return tl::make_unexpected(
            document->error_at({}, "expected a result of claystack batch, found something else"));
      const auto status = one.at("status").get<int>();
      if (status == kDone || status == kUnsound)
        done_[one.at("run").dump() + one.at("id").get<std::string>()] = status;
    }
    return remove_unfinished(lines.rest(), lines.bytes());
  }

  /// The last line that a killed batch left. Any other file without a line feed at its end stays.
  Result<void> remove_unfinished(std::string_view rest, std::uint64_t size) {
    if (rest.empty()) return {};
    const std::string begin = fmt::format(R"({{"schema":"{}",)", kSchema);
    if (!rest.starts_with(begin) && !begin.starts_with(rest))
      return failure(ErrorKind::bad_input,
                     path_ + ": expected results of claystack batch, found something else");
    if (::ftruncate(descriptor_, static_cast<off_t>(size - rest.size())) != 0)
      return io_failure("cannot remove the unfinished last line");
    return {};
  }

  std::string path_;
  int descriptor_ = -1;
  std::map<std::string, int> done_;
};

/// The first line that is not a warning; empty if there is none.
std::string_view first_error(std::string_view text) {
  while (text.starts_with("claystack: warning: "))
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find('\n'));
}

/// The JSON that the job printed; of a failed job the first line of its errors.
Json result_json(const BatchJob& job, const BatchOutcome& outcome) {
  Json json = {{"schema", kSchema},
               {"id", job.id},
               {"run", job.words},
               {"status", outcome.status},
               {"seconds", std::round(1e3 * outcome.seconds) / 1e3}};
  if (outcome.timed_out)
    json["error"] = "ended by the time limit";
  else if (outcome.status > 128)
    json["error"] = fmt::format("ended by signal {}", outcome.status - 128);
  else if (const auto error = first_error(outcome.err); outcome.status != kDone && !error.empty())
    json["error"] = error;  // a check that fails has its reasons in the output
  if (outcome.cut)
    json["error"] = fmt::format("the output exceeds {} MiB and is omitted", kMostOutput >> 20);
  else if (Json printed = Json::parse(outcome.out, nullptr, false); !printed.is_discarded())
    json["output"] = std::move(printed);
  return json;
}

Result<int> batch(BatchOptions options, const Console& console) {
  if (options.results == "-") options.results.clear();
  auto jobs = read_jobs(options.jobs).and_then([&](std::vector<BatchJob> all) {
    return part_of(std::move(all), options.part);
  });
  if (!jobs) return tl::make_unexpected(jobs.error());
  if (auto free = check_outputs({{options.results}}, {options.jobs}, console); !free)
    return tl::make_unexpected(free.error());
  if (options.processes > 1)
    if (auto apart = check_job_outputs(*jobs, options.jobs); !apart)
      return tl::make_unexpected(apart.error());
  auto results = ResultFile::open(options.results);
  if (!results) return tl::make_unexpected(results.error());
  const std::size_t asked = jobs->size();
  std::size_t failed = 0;
  const std::size_t skipped = std::erase_if(*jobs, [&](const BatchJob& job) {
    const auto status = results->status_of(job);
    failed += status && *status != kDone;
    return status.has_value();
  });

  std::vector<BatchJob> runs = *jobs;
  for (BatchJob& run : runs)
    if (std::ranges::find(run.words, "--json") == run.words.end()) run.words.push_back("--json");
  std::size_t ended = 0;
  Result<void> written;
  Progress progress(console, "jobs", runs.size());
  const auto ran =
      run_batch(runs, {options.processes, std::chrono::duration<double>(options.time_limit_s)},
                [&](const BatchOutcome& outcome) {
                  if (!written) return false;  // its job runs again with the next batch
                  failed += outcome.status != kDone;
                  written = results->add(result_json((*jobs)[outcome.job], outcome));
                  progress.update(++ended);
                  return written.has_value();
                });
  if (!written) return tl::make_unexpected(written.error());
  if (!ran) return tl::make_unexpected(ran.error());
  if (results->is_standard_output()) return failed == 0 ? kDone : kUnsound;
  if (console.json)
    print_json({{"jobs", asked},
                {"done", asked - failed},
                {"failed", failed},
                {"skipped", skipped},
                {"results", options.results}});
  else if (!console.quiet)
    console.print(fmt::format("{}: {} done, {} failed; {} skipped, because {} has their results",
                              counted(asked, "job"), asked - failed, failed, skipped,
                              options.results));
  return failed == 0 ? kDone : kUnsound;
}

}  // namespace

void add_batch_command(CLI::App& app, Console& console, int& exit) {
  auto options = std::make_shared<BatchOptions>();
  CLI::App* command = app.add_subcommand(
      "batch", "Run many commands, several at a time: one line of JSON for each result");
  command
      ->add_option("file", options->jobs,
                   "JOBS.jsonl, or - for standard input: a line for each job, {\"id\": \"bowl\", "
                   "\"run\": [\"export\", \"bowl.pot.json\", \"bowl.stl\"]}; it may run " +
                       fmt::format("{}", fmt::join(kRunnable, ", ")))
      ->required();
  command->add_option("-o,--output", options->results,
                      "File for the results, appended; jobs that have a result with status 0 or 1 "
                      "in it are skipped (default: standard output)");
  command
      ->add_option("-j,--jobs", options->processes,
                   "Number of jobs that run at the same time (default: one for each core)")
      ->check(in_whole_range(1, 1024));
  command
      ->add_option("--time-limit", options->time_limit_s,
                   "Time after which a job is ended [s] (default: 600)")
      ->check(in_range(0.01, 1e6));
  command->add_option("--part", options->part,
                      "Run only the jobs K, K+N, K+2N, ...: K/N, for one task of a job array");
  command->footer(
      "\nExamples:\n"
      "  claystack batch samples/jobs.jsonl -o results.jsonl\n"
      "  claystack batch samples/jobs.jsonl -j 4 --time-limit 60\n"
      "  claystack batch samples/jobs.jsonl --part 1/2 -o results-1.jsonl\n\n"
      "Exit status: 0 every job ended with 0; 1 a job did not; 2 a line of the file is "
      "wrong, and no job ran.");
  command->callback([options, &console, &exit] {
    const auto done = batch(*options, console);
    exit = done ? *done : report(done.error());
  });
}

}  // namespace clay::cli
