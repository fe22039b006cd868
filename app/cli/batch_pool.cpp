#include "app/cli/batch_pool.hpp"

#include "core/system_calls.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <list>
#include <optional>
#include <utility>

namespace clay::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPollMs = 50;
constexpr int kSuccess = 0;

/// The reading end of a pipe from a process; closed with it.
class Output {
 public:
  explicit Output(int descriptor) : descriptor_(descriptor) {}
  Output(Output&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)),
        text_(std::move(other.text_)),
        cut_(other.cut_) {}
  Output& operator=(Output&&) = delete;
  ~Output() {
    if (descriptor_ != -1) ::close(descriptor_);
  }

  /// Reads the available bytes without waiting, and drops bytes beyond kMostOutput.
  void drain() {
    std::array<char, 4096> part;
    for (;;) {
      const auto count = ::read(descriptor_, part.data(), part.size());
      if (count <= 0) return;
      const auto kept = std::min(static_cast<std::size_t>(count), kMostOutput - text_.size());
      text_.append(part.data(), kept);
      cut_ |= kept < static_cast<std::size_t>(count);
    }
  }
  [[nodiscard]] pollfd polled() const { return {descriptor_, POLLIN, 0}; }
  [[nodiscard]] std::string take() { return std::move(text_); }
  [[nodiscard]] bool cut() const { return cut_; }

 private:
  int descriptor_;
  std::string text_;
  bool cut_ = false;
};

struct Running {
  std::size_t job;
  pid_t process;
  Clock::time_point begin;
  Output out, err;
  bool timed_out = false;
};

/// In the child of `batch`: never returns.
[[noreturn]] void become(const std::vector<std::string>& words, pid_t batch, int out, int err) {
  // A separate process group, so that a time limit ends all of its processes; and no job outlives
  // the batch, even if the batch ended before this process asked for the signal.
  (void)::setpgid(0, 0);
  (void)::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != batch) ::_exit(128 + SIGTERM);
  (void)::dup2(out, STDOUT_FILENO);
  (void)::dup2(err, STDERR_FILENO);
  ::close(STDIN_FILENO);  // its number is then the lowest free one, even if no other is left
  (void)::open("/dev/null", O_RDONLY);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) ::signal(signal, SIG_DFL);
  std::vector<char*> pointers;
  static std::string program = "claystack";
  pointers.push_back(program.data());
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  ::execv("/proc/self/exe", pointers.data());
  ::_exit(127);
}

Result<Running> start(const std::vector<BatchJob>& jobs, std::size_t job) {
  std::array<int, 2> out{}, err{};
  if (::pipe2(out.data(), O_CLOEXEC) != 0) return io_failure("batch", "could not make a pipe");
  Output out_end(out[0]);
  if (::pipe2(err.data(), O_CLOEXEC) != 0) {
    ::close(out[1]);
    return io_failure("batch", "could not make a pipe");
  }
  Output err_end(err[0]);
  const pid_t batch = ::getpid(), process = ::fork();
  if (process == 0) become(jobs[job].words, batch, out[1], err[1]);
  const int failed = errno;
  ::close(out[1]);
  ::close(err[1]);
  errno = failed;
  if (process == -1) return io_failure("batch", "could not start a process");
  for (const int end : {out[0], err[0]}) (void)::fcntl(end, F_SETFL, O_NONBLOCK);
  return Running{job, process, Clock::now(), std::move(out_end), std::move(err_end)};
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Empty while it runs.
std::optional<BatchOutcome> outcome_of(Running& running) {
  running.out.drain();
  running.err.drain();
  int status = 0;
  if (::waitpid(running.process, &status, WNOHANG) != running.process) return std::nullopt;
  running.out.drain();
  running.err.drain();
  BatchOutcome outcome{running.job,
                       WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
                       running.timed_out,
                       seconds_since(running.begin),
                       running.out.cut(),
                       {},
                       {}};
  outcome.out = running.out.take();
  outcome.err = running.err.take();
  return outcome;
}

void wait_for_any(const std::list<Running>& all) {
  std::vector<pollfd> ends;
  for (const Running& running : all) {
    ends.push_back(running.out.polled());
    ends.push_back(running.err.polled());
  }
  (void)::poll(ends.data(), ends.size(), kPollMs);
}

/// The jobs of a batch: those that run, and the next one to start.
class Batch {
 public:
  Batch(const std::vector<BatchJob>& jobs, const BatchPool& pool,
        const std::function<bool(const BatchOutcome&)>& done)
      : jobs_(jobs), pool_(pool), done_(done), ended_(pool.ended) {
    for (std::size_t job = 0; job < jobs.size(); ++job) pending_.push_back(job);
  }

  Result<void> run() {
    while (!running_.empty() || !pending_.empty()) {
      start_jobs();
      wait_for_any(running_);
      running_.remove_if([&](Running& running) { return has_ended(running); });
    }
    return result_;
  }

 private:
  void start_jobs() {
    for (auto next = pending_.begin();
         next != pending_.end() && running_.size() < pool_.processes && !full_;) {
      const std::size_t job = *next;
      const auto before = ended_.find(jobs_[job].after);
      if (!jobs_[job].after.empty() && before == ended_.end()) {
        ++next;  // the job before it runs, or is pending
        continue;
      }
      if (!jobs_[job].after.empty() && before->second != kSuccess) {
        next = pending_.erase(next);
        BatchOutcome not_run;
        not_run.job = job;
        if (!finish(not_run)) return;
        continue;
      }
      auto started = start(jobs_, job);
      if (started) {
        running_.push_back(std::move(*started));
        next = pending_.erase(next);
      } else if (!running_.empty()) {
        full_ = true;
      } else {
        result_ = tl::make_unexpected(started.error());
        return pending_.clear();
      }
    }
  }

  /// Passes the outcome on. False: the batch ends early.
  bool finish(const BatchOutcome& outcome) {
    ended_[jobs_[outcome.job].id] = outcome.status;
    if (done_(outcome)) return true;
    pending_.clear();
    return false;
  }

  /// Passes on the outcome of a job that has ended; kills one whose time is over.
  bool has_ended(Running& running) {
    if (const auto outcome = outcome_of(running)) {
      (void)finish(*outcome);
      full_ = false;
      return true;
    }
    const double limit_s = pool_.time_limit.count();
    if (limit_s > 0.0 && !running.timed_out && seconds_since(running.begin) > limit_s) {
      running.timed_out = true;
      if (::kill(-running.process, SIGKILL) != 0) (void)::kill(running.process, SIGKILL);
    }
    return false;
  }

  const std::vector<BatchJob>& jobs_;
  const BatchPool& pool_;
  const std::function<bool(const BatchOutcome&)>& done_;
  std::list<Running> running_;
  std::list<std::size_t> pending_;
  std::map<std::string, int> ended_;  // statuses by id
  bool full_ = false;                 // the system starts no more until one ends
  Result<void> result_;
};

}  // namespace

Result<void> run_batch(const std::vector<BatchJob>& jobs, const BatchPool& pool,
                       const std::function<bool(const BatchOutcome&)>& done) {
  return Batch(jobs, pool, done).run();
}

}  // namespace clay::cli
