#include "app/cli/batch_jobs.hpp"

#include "app/cli/batch_results.hpp"

#include "claystack/core/atomic_file.hpp"
#include "core/json/object_reader.hpp"
#include "core/line_reader.hpp"
#include "core/number_parsing.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

namespace clay::cli {

static void describe(auto& io, Is<BatchJob> auto& job) {
  constexpr std::size_t kMostWords = 1000;
  io.require({"id", "run"});
  io.text("id", job.id);
  io.texts("run", job.words, kMostWords);
  io.text("after", job.after);
}

namespace {

constexpr std::size_t kMaxLineValues = 2000;

/// Reads jobs line by line, and knows the ids of the lines before.
class JobReader {
 public:
  explicit JobReader(const std::string& path) : path_(path) {}

  Result<BatchJob> read(std::string_view line, std::size_t number) {
    const auto document = LocatedJson::from_json(line, path_, kMaxLineValues, number);
    if (!document) return tl::make_unexpected(document.error());
    auto job = ObjectReader::read(*document, BatchJob{});
    // The id of a wrong line, too, so that the jobs that wait for it are not reported with it.
    const std::string* const id = id_in(document->root());
    const bool known_before = id != nullptr && !ids_.insert(*id).second;
    if (!job) return job;
    return check(*document, *job, known_before).map([&] { return std::move(*job); });
  }

 private:
  static const std::string* id_in(const Json& line) {
    const auto id = line.is_object() ? line.find("id") : line.end();
    return id == line.end() ? nullptr : id->get_ptr<const std::string*>();
  }

  [[nodiscard]] Result<void> check(const LocatedJson& document, const BatchJob& job,
                                   bool known_before) const {
    const auto refuse = [&](std::string_view field, const std::string& message) -> Result<void> {
      return tl::make_unexpected(document.field_error({field}, message));
    };
    if (known_before) return refuse("id", "expected a different id for each job, found " + job.id);
    if (job.words.empty() || std::ranges::find(kRunnable, job.words.front()) == kRunnable.end())
      return refuse("run", fmt::format("expected one of {}, and its arguments, found {}",
                                       fmt::join(kRunnable, ", "),
                                       job.words.empty() ? "nothing" : job.words.front()));
    // Only an earlier line: so no jobs wait for each other.
    if (!job.after.empty() && (job.after == job.id || !ids_.contains(job.after)))
      return refuse("after", "expected the id of a job on an earlier line, found " + job.after);
    return {};
  }

  const std::string& path_;
  std::set<std::string, std::less<>> ids_;
};

}  // namespace

Result<std::vector<BatchJob>> read_jobs(const std::string& path, std::vector<std::string>& wrong) {
  auto text = read_file(path, kMaxBatchBytes);
  if (!text) return tl::make_unexpected(text.error());
  if (!text->empty() && text->back() != '\n') *text += '\n';
  std::vector<BatchJob> jobs;
  JobReader reader(path);
  Error first;
  std::size_t more = 0;
  for (LineReader lines(*text); const auto line = lines.next();) {
    if (line->find_first_not_of(" \t\r") == std::string_view::npos) continue;
    auto job = reader.read(*line, lines.number());
    if (job) {
      jobs.push_back(std::move(*job));
      continue;
    }
    if (wrong.empty()) {
      first = kind_error(job.error(), *text, path, "jobs (.jsonl)");
      if (first.message != job.error().message) return tl::make_unexpected(first);
    }
    if (wrong.size() < kMostWrongLines)
      wrong.push_back(job.error().message);
    else
      ++more;
  }
  if (more > 0)
    wrong.push_back(fmt::format("{}: {} more wrong line{}", path, more, more == 1 ? "" : "s"));
  if (!wrong.empty()) return tl::make_unexpected(first);
  return jobs;
}

Result<std::vector<BatchJob>> jobs_of_part(std::vector<BatchJob> jobs, const std::string& part) {
  if (part.empty()) return jobs;
  const auto numbers = two_numbers<std::uint32_t>(part, '/');
  if (!numbers || numbers->first < 1 || numbers->first > numbers->second)
    return failure(ErrorKind::bad_input, "--part: expected K/N with K from 1 to N, found " + part);
  std::vector<BatchJob> mine;
  std::map<std::string, std::size_t> parts;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto waited = parts.find(jobs[i].after);
    const std::size_t number = waited == parts.end() ? i % numbers->second : waited->second;
    parts.emplace(jobs[i].id, number);
    if (number == numbers->first - 1) mine.push_back(std::move(jobs[i]));
  }
  return mine;
}

}  // namespace clay::cli
