#include "app/cli/batch_jobs.hpp"
#include "app/cli/batch_outputs.hpp"
#include "app/cli/batch_pool.hpp"
#include "app/cli/batch_results.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/usage.hpp"

#include "core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace clay::cli {

namespace {

struct BatchOptions {
  std::string jobs;
  std::string results;  ///< empty: standard output
  std::string part;     ///< "K/N"
  std::string redo;     ///< "failed", "refused", "all" or empty
  std::size_t processes = std::max(std::thread::hardware_concurrency(), 1U);
  double time_limit_s = 600.0;
};

/// The first line that is not a warning; empty if there is none.
std::string_view first_error(std::string_view text) {
  while (text.starts_with("claystack: warning: "))
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find('\n'));
}

/// The JSON that the job printed; of a failed job the first line of its errors, or the fault that
/// its check found.
Json result_json(const BatchJob& job, const BatchOutcome& outcome) {
  Json json = {{"schema", kBatchSchema},
               {"id", job.id},
               {"run", job.words},
               {"status", outcome.status},
               {"seconds", std::round(1e3 * outcome.seconds) / 1e3}};
  if (outcome.status == kNotRun) {
    json["status"] = nullptr;
    json["error"] = "not run, because " + job.after + " failed";
    return json;
  }
  if (outcome.timed_out)
    json["error"] = "ended by the time limit";
  else if (outcome.status > 128)
    json["error"] = fmt::format("ended by signal {}", outcome.status - 128);
  else if (const auto error = first_error(outcome.err); outcome.status != kDone && !error.empty())
    json["error"] = error;
  if (outcome.cut)
    json["error"] = fmt::format("the output exceeds {} MiB and is omitted", kMostOutput >> 20);
  else if (Json printed = Json::parse(outcome.out, nullptr, false); !printed.is_discarded()) {
    const std::string fault = outcome.status == kDone ? std::string() : fault_in(printed);
    if (!fault.empty() && !json.contains("error")) json["error"] = fault;
    json["output"] = std::move(printed);
  }
  return json;
}

/// "bowl: status 2: bowl.pot.json: could not open".
void warn_of_failure(const Json& result, const Console& console) {
  const Json& status = result["status"];
  if (status == kDone) return;
  std::string why = result.value("error", "");
  constexpr std::string_view kProgram = "claystack: ";
  if (why.starts_with(kProgram)) why.erase(0, kProgram.size());
  console.warn(
      fmt::format("{}: {}{}{}", shown(result["id"].get<std::string>()),
                  status.is_null() ? std::string() : fmt::format("status {}", status.get<int>()),
                  why.empty() || status.is_null() ? "" : ": ", why));
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
Result<std::vector<BatchJob>> checked_jobs(const BatchOptions& options, const Console& console,
                                           std::vector<std::string>& wrong) {
  auto jobs = read_jobs(options.jobs, wrong).and_then([&](std::vector<BatchJob> all) {
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

/// Whether a job that has this result runs again.
bool runs_again(const EarlierResult& result, std::string_view redo) {
  return redo == "all" || (redo == "failed" && result.status != kDone) ||
         (redo == "refused" && result.refused);
}

/// `wrong`: the messages of wrong lines in the file of jobs.
Result<int> batch(BatchOptions options, const Console& console, std::vector<std::string>& wrong) {
  if (options.results == "-") options.results.clear();
  auto jobs = checked_jobs(options, console, wrong);
  if (!jobs) return tl::make_unexpected(jobs.error());
  auto results = ResultFile::open(options.results);
  if (!results) return tl::make_unexpected(results.error());
  const std::size_t asked = jobs->size();
  std::size_t failed = 0;
  BatchPool pool{options.processes, std::chrono::duration<double>(options.time_limit_s), {}};
  const std::size_t skipped = std::erase_if(*jobs, [&](const BatchJob& job) {
    const auto result = results->result_of(job);
    if (!result || runs_again(*result, options.redo)) return false;
    failed += result->status != kDone;
    pool.ended[job.id] = result->status;
    return true;
  });

  const std::vector<BatchJob> runs = runs_of(*jobs);
  std::size_t ended = 0;
  Result<void> written;
  Progress progress(console, "jobs", runs.size());
  const auto ran = run_batch(runs, pool, [&](const BatchOutcome& outcome) {
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

/// Of wrong lines all messages; JSON has them as `errors`.
int report_failure(const Error& error, const std::vector<std::string>& wrong,
                   const Console& console) {
  if (wrong.empty()) return report(error);
  const int exit = report(error, {{"errors", wrong}});
  for (std::size_t i = 1; i < wrong.size(); ++i) console.error(wrong[i]);
  return exit;
}

}  // namespace

void add_batch_command(CLI::App& app, Console& console, int& exit) {
  auto options = std::make_shared<BatchOptions>();
  CLI::App* command = app.add_subcommand(
      "batch", "Run many commands, several at a time: one line of JSON for each result");
  add_file(*command, "file", options->jobs,
           "JOBS.jsonl, or - for standard input: a line for each job, {\"id\": \"bowl\", "
           "\"run\": [\"export\", \"bowl.pot.json\", \"bowl.stl\"]}; it may run " +
               fmt::format("{}", fmt::join(kRunnable, ", ")) +
               ". Jobs run in any order; with \"after\": \"ID\", one runs after the job ID of an "
               "earlier line has ended with 0, or not at all")
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
      ->add_option(
          "--redo", options->redo,
          "Run again jobs that have a result: those that failed, those of them that were "
          "refused and wrote nothing, or all (default: jobs without a result with status 0 "
          "or 1)")
      ->check(one_of({"failed", "refused", "all"}));
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
    std::vector<std::string> wrong;
    const auto done = batch(*options, console, wrong);
    exit = done ? *done : report_failure(done.error(), wrong, console);
  });
}

}  // namespace clay::cli
