#include "app/cli/batch_results.hpp"

#include "app/cli/console.hpp"
#include "core/file_reader.hpp"
#include "core/json/json_text.hpp"
#include "core/json/located_json.hpp"
#include "core/system_calls.hpp"
#include "core/text.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace clay::cli {
namespace {

/// The key of a job, by which results belong to it.
std::string key_of(const Json& words, const std::string& id) { return words.dump() + id; }

bool is_result(const Json& line) {
  return line.is_object() && line.contains("id") && line.at("id").is_string() &&
         line.contains("run") && line.contains("status") &&
         (line.at("status").is_number_integer() || line.at("status").is_null());
}

/// The output of a command that could not finish has the fields of an error.
bool is_refused(const Json& line) {
  return line.contains("output") && line.at("output").is_object() &&
         line.at("output").contains("kind");
}

std::string first_problem(const Json& output) {
  const auto problems = output.find("problems");
  if (problems == output.end() || problems->empty() || !problems->front().contains("where"))
    return {};
  const Json& first = problems->front();
  return fmt::format("{} ({}): {}", first.value("what", ""), first.value("count", 1),
                     first.value("where", ""));
}

std::string first_failed_check(const Json& output) {
  for (const Json& check : output.value("checks", Json::array()))
    if (check.value("verdict", "") == "fail")
      return check.value("check", "") + ": " + check.value("text", "");
  return {};
}

}  // namespace

std::string fault_in(const Json& output) {
  if (!output.is_object()) return {};
  const std::string problem = first_problem(output), check = first_failed_check(output);
  // The faults of a mesh that prints may be accepted; then the check is the reason.
  const bool prints = output.value("verdict", "") == "prints";
  return problem.empty() || (prints && !check.empty()) ? check : problem;
}

ResultFile::ResultFile(std::string path) : path_(std::move(path)) {}

ResultFile::ResultFile(ResultFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      done_(std::move(other.done_)) {}

ResultFile::~ResultFile() {
  if (descriptor_ != -1) ::close(descriptor_);
}

Result<ResultFile> ResultFile::open(const std::string& path) {
  ResultFile file(path);
  if (path.empty()) return file;
  // A pipe is opened for writing only: if this process could also read it, it would never see the
  // end of the pipe, and a write after the reader has ended would not fail.
  struct stat kind {};
  const bool written_only = ::stat(path.c_str(), &kind) == 0 && !S_ISREG(kind.st_mode);
  const int mode = written_only ? O_WRONLY : O_RDWR | O_CREAT;
  file.descriptor_ = ::open(path.c_str(), mode | O_APPEND | O_CLOEXEC, 0666);
  if (file.descriptor_ == -1) return io_failure(path, "could not open");
  if (::fstat(file.descriptor_, &kind) != 0) return io_failure(path, "could not open");
  if (!S_ISREG(kind.st_mode)) return file;
  if (::flock(file.descriptor_, LOCK_EX | LOCK_NB) != 0)
    return io_failure(path, "could not lock, another batch may write it");
  return file.read_done().map([&] { return std::move(file); });
}

bool ResultFile::is_standard_output() const {
  struct stat own {};
  struct stat standard {};
  return descriptor_ == -1 || (::fstat(descriptor_, &own) == 0 &&
                               ::fstat(STDOUT_FILENO, &standard) == 0 && same_file(own, standard));
}

std::optional<EarlierResult> ResultFile::result_of(const BatchJob& job) const {
  const auto found = done_.find(key_of(Json(job.words), job.id));
  return found == done_.end() ? std::nullopt : std::optional(found->second);
}

Result<void> ResultFile::add(const Json& result) {
  const std::string line = json_line(result) + "\n";
  if (descriptor_ == -1) {
    put_out(line);
    if (flush_out()) return {};
    return failure(ErrorKind::io, "standard output: could not write");
  }
  const auto size = ::lseek(descriptor_, 0, SEEK_END);
  if (write_all(descriptor_, line)) return {};
  const auto failed = io_failure(path_, "could not write");
  if (size >= 0) (void)::ftruncate(descriptor_, size);  // if it fails, the next batch removes it
  return failed;
}

Result<void> ResultFile::read_done() {
  auto file = FileReader::open(path_);
  if (!file) return tl::make_unexpected(file.error());
  FileLines lines(std::move(*file), kMaxBatchBytes);
  for (;;) {
    const auto line = lines.next();
    if (!line) return tl::make_unexpected(line.error());
    if (!*line) return remove_unfinished(lines.rest(), lines.bytes());
    if (auto read = read_line(**line, lines.number()); !read) return read;
  }
}

Result<void> ResultFile::read_line(std::string_view line, std::size_t number) {
  const auto document = LocatedJson::from_json(line, path_, SIZE_MAX, number);
  if (!document || !is_result(document->root()))
    return failure(ErrorKind::bad_input,
                   fmt::format("{}:{}: expected a result of claystack batch, found {}", path_,
                               number, line.empty() ? "an empty line" : kind_of_file(line)));
  const Json& one = document->root();
  const auto status = one.at("status").is_null() ? kNotRun : one.at("status").get<int>();
  const std::string key = key_of(one.at("run"), one.at("id").get<std::string>());
  if (status == kDone || status == kUnsound)
    done_[key] = {status, is_refused(one)};
  else
    done_.erase(key);
  return {};
}

/// Removes the last line that a killed batch has left unfinished. Refuses any other file without a
/// line feed at its end.
Result<void> ResultFile::remove_unfinished(std::string_view rest, std::uint64_t size) {
  if (rest.empty()) return {};
  const std::string begin = fmt::format(R"({{"schema":"{}",)", kBatchSchema);
  if (!rest.starts_with(begin) && !begin.starts_with(rest))
    return failure(ErrorKind::bad_input,
                   path_ + ": expected a result of claystack batch, found " + kind_of_file(rest));
  if (::ftruncate(descriptor_, static_cast<off_t>(size - rest.size())) != 0)
    return io_failure(path_, "could not remove the unfinished last line");
  return {};
}

}  // namespace clay::cli
