#include "app/cli/batch_outputs.hpp"
#include "app/cli/batch_pool.hpp"
#include "app/cli/batch_results.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/usage.hpp"

#include "claystack/core/atomic_file.hpp"
#include "core/json/object_reader.hpp"
#include "core/line_reader.hpp"
#include "core/number_parsing.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
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

constexpr std::size_t kMaxLineValues = 2000;
constexpr std::array kRunnable = {"check",  "export",  "import", "plan",
                                  "render", "strokes", "throw"};

struct BatchOptions {
  std::string jobs;
  std::string results;  ///< empty: standard output
  std::string part;     ///< "K/N"
  std::string redo;     ///< "failed", "all" or empty
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
  const auto refuse = [&](const Error& error) {
    return tl::make_unexpected(kind_error(error, *text, path, "jobs (.jsonl)"));
  };
  while (const auto line = lines.next()) {
    if (line->find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const auto document = LocatedJson::from_json(*line, path, kMaxLineValues, lines.number());
    if (!document) return refuse(document.error());
    auto job = ObjectReader::read(*document, BatchJob{});
    if (!job) return refuse(job.error());
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
Result<std::vector<BatchJob>> jobs_of_part(std::vector<BatchJob> jobs, const std::string& part) {
  if (part.empty()) return jobs;
  const auto numbers = two_numbers<std::uint32_t>(part, '/');
  if (!numbers || numbers->first < 1 || numbers->first > numbers->second)
    return failure(ErrorKind::bad_input, "--part: expected K/N with K from 1 to N, found " + part);
  const std::size_t number = numbers->first, parts = numbers->second;
  std::vector<BatchJob> mine;
  for (std::size_t i = number - 1; i < jobs.size(); i += parts) mine.push_back(std::move(jobs[i]));
  return mine;
}

/// The first line that is not a warning; empty if there is none.
std::string_view first_error(std::string_view text) {
  while (text.starts_with("claystack: warning: "))
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find('\n'));
}

/// The JSON that the job printed; of a failed job the first line of its errors.
Json result_json(const BatchJob& job, const BatchOutcome& outcome) {
  Json json = {{"schema", kBatchSchema},
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

/// "bowl: status 2: bowl.pot.json: could not open"; of a check that fails, its verdict.
void warn_of_failure(const Json& result, const Console& console) {
  const auto status = result["status"].get<int>();
  if (status == kDone) return;
  std::string why;
  if (result.contains("error")) {
    why = result["error"].get<std::string>();
    constexpr std::string_view kProgram = "claystack: ";
    if (why.starts_with(kProgram)) why.erase(0, kProgram.size());
  } else if (result.contains("output") && result["output"].contains("verdict"))
    why = result["output"]["verdict"].get<std::string>();
  console.warn(fmt::format("{}: status {}{}{}", shown(result["id"].get<std::string>()), status,
                           why.empty() ? "" : ": ", why));
}

/// `summary`: docs/json.md.
void print_summary(const Json& summary, const Console& console) {
  if (console.json) print_json(summary);
  const auto count = [&](const char* field) { return summary[field].get<std::size_t>(); };
  const auto results = summary["results"].get<std::string>();
  std::string line = fmt::format("{}: {} done, {} failed", counted(count("jobs"), "job"),
                                 count("done"), count("failed"));
  if (count("skipped") > 0)
    line += fmt::format("; {} of them skipped, because {} has their results", count("skipped"),
                        results);
  console.print(line);
}

/// The jobs of this part. An error if two of them write the same file.
Result<std::vector<BatchJob>> checked_jobs(const BatchOptions& options, const Console& console) {
  auto jobs = read_jobs(options.jobs).and_then([&](std::vector<BatchJob> all) {
    return jobs_of_part(std::move(all), options.part);
  });
  if (!jobs) return jobs;
  if (auto free = check_outputs({{options.results}}, {options.jobs}, console); !free)
    return tl::make_unexpected(free.error());
  if (options.processes > 1)
    if (auto apart = check_job_outputs(*jobs, options.jobs); !apart)
      return tl::make_unexpected(apart.error());
  return jobs;
}

/// The jobs with the options that all of them have: JSON on standard output, and the memory limit
/// of the batch, unless a job has its own.
std::vector<BatchJob> runs_of(std::vector<BatchJob> jobs) {
  for (BatchJob& job : jobs) {
    const auto has = [&](std::string_view option) {
      return std::ranges::any_of(job.words, [&](std::string_view word) {
        return word == option || (word.starts_with(option) && word[option.size()] == '=');
      });
    };
    // Directly after the command: at the end they might follow "--" and count as files.
    if (!has("--json")) job.words.insert(job.words.begin() + 1, "--json");
    if (memory_limit() > 0 && !has("--memory"))
      job.words.insert(job.words.begin() + 1, fmt::format("--memory={}", memory_limit()));
  }
  return jobs;
}

Result<int> batch(BatchOptions options, const Console& console) {
  if (options.results == "-") options.results.clear();
  auto jobs = checked_jobs(options, console);
  if (!jobs) return tl::make_unexpected(jobs.error());
  auto results = ResultFile::open(options.results);
  if (!results) return tl::make_unexpected(results.error());
  const std::size_t asked = jobs->size();
  std::size_t failed = 0;
  const std::size_t skipped = std::erase_if(*jobs, [&](const BatchJob& job) {
    const auto status = results->status_of(job);
    const bool again = options.redo == "all" || (options.redo == "failed" && status != kDone);
    if (!status || again) return false;
    failed += *status != kDone;
    return true;
  });

  const std::vector<BatchJob> runs = runs_of(*jobs);
  std::size_t ended = 0;
  Result<void> written;
  Progress progress(console, "jobs", runs.size());
  const auto ran =
      run_batch(runs, {options.processes, std::chrono::duration<double>(options.time_limit_s)},
                [&](const BatchOutcome& outcome) {
                  if (!written) return false;  // its job runs again with the next batch
                  const Json result = result_json((*jobs)[outcome.job], outcome);
                  failed += outcome.status != kDone;
                  written = results->add(result);
                  if (!results->is_standard_output()) warn_of_failure(result, console);
                  progress.update(++ended);
                  return written.has_value();
                });
  if (!written) return tl::make_unexpected(written.error());
  if (!ran) return tl::make_unexpected(ran.error());
  if (results->is_standard_output()) return failed == 0 ? kDone : kUnsound;
  print_summary({{"jobs", asked},
                 {"done", asked - failed},
                 {"failed", failed},
                 {"skipped", skipped},
                 {"results", options.results}},
                console);
  return failed == 0 ? kDone : kUnsound;
}

}  // namespace

void add_batch_command(CLI::App& app, Console& console, int& exit) {
  auto options = std::make_shared<BatchOptions>();
  CLI::App* command = app.add_subcommand(
      "batch", "Run many commands, several at a time: one line of JSON for each result");
  add_file(*command, "file", options->jobs,
           "JOBS.jsonl, or - for standard input: a line for each job, {\"id\": \"bowl\", "
           "\"run\": [\"export\", \"bowl.pot.json\", \"bowl.stl\"]}; it may run " +
               fmt::format("{}", fmt::join(kRunnable, ", ")))
      ->required();
  add_file(*command, "-o,--output", options->results,
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
  command
      ->add_option("--redo", options->redo,
                   "Run again jobs that have a result: those that failed, or all (default: jobs "
                   "without a result with status 0 or 1)")
      ->check(one_of({"failed", "all"}));
  command
      ->add_option("--part", options->part,
                   "Run only the jobs K, K+N, K+2N, ..., for one task of a job array")
      ->type_name("K/N");
  command->footer(
      "\nExamples:\n"
      "  claystack batch samples/jobs.jsonl -o results.jsonl\n"
      "  claystack batch samples/jobs.jsonl -j 4 --time-limit 60\n"
      "  claystack batch samples/jobs.jsonl --part 1/2 -o results-1.jsonl\n\n"
      "--memory limits the batch, and each job that does not have this option.\n\n"
      "Exit status: 0 every job ended with 0; 1 a job did not; 2 a line of the file is "
      "wrong, and no job ran.");
  command->callback([options, &console, &exit] {
    const auto done = batch(*options, console);
    exit = done ? *done : report(done.error());
  });
}

}  // namespace clay::cli
