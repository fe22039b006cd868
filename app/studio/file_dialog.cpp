#include "app/studio/file_dialog.hpp"

#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>

extern char** environ;

namespace clay::studio {
namespace {

std::optional<std::string> program(std::string_view name) {
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "/usr/bin:/bin";
  while (!rest.empty()) {
    const auto end = std::min(rest.find(':'), rest.size());
    std::string file(rest.substr(0, end));
    file.append("/").append(name);
    if (access(file.c_str(), X_OK) == 0) return file;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return std::nullopt;
}

/// Starts a process, with its output sent to `output` unless that is negative. Returns its id; 0:
/// it did not start.
int start(std::vector<std::string> words, int output) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  if (output >= 0) posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  pid_t child = 0;
  const int failed = posix_spawn(&child, arguments[0], &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  return failed == 0 ? child : 0;
}

/// In the order of FileDialog::Kind: the title, and the option of kdialog.
struct Question {
  const char* title;
  const char* kdialog;
};
constexpr std::array kQuestions = {Question{"Open", "--getopenfilename"},
                                   Question{"Save as", "--getsavefilename"},
                                   Question{"Choose a folder", "--getexistingdirectory"},
                                   Question{"Open a process", "--getopenfilename"},
                                   Question{"Open a target", "--getopenfilename"}};

std::vector<std::string> words_of(FileDialog::Kind kind, const std::string& start_at) {
  const Question& question = kQuestions[static_cast<std::size_t>(kind)];
  const std::string title = std::string("--title=").append(question.title);
  if (auto zenity = program("zenity")) {
    std::vector<std::string> words = {*zenity, "--file-selection", title, "--filename=" + start_at};
    if (kind == FileDialog::Kind::save)
      words.insert(words.end(), {"--save", "--confirm-overwrite"});
    if (kind == FileDialog::Kind::folder) words.emplace_back("--directory");
    return words;
  }
  if (auto kdialog = program("kdialog")) return {*kdialog, title, question.kdialog, start_at};
  return {};
}

}  // namespace

FileDialog::~FileDialog() {
  if (pipe_ >= 0) close(pipe_);
  if (child_ <= 0) return;
  kill(child_, SIGTERM);
  waitpid(child_, nullptr, 0);
}

bool FileDialog::begin(Kind kind, const std::filesystem::path& start_at) {
  if (open()) return false;
  const std::vector<std::string> words = words_of(kind, start_at.string());
  std::array<int, 2> ends{};
  if (words.empty() || pipe2(ends.data(), O_CLOEXEC) != 0) return false;
  fcntl(ends[0], F_SETFL, O_NONBLOCK);
  child_ = start(words, ends[1]);
  close(ends[1]);
  kind_ = kind;
  chosen_.clear();
  if (child_ > 0) {
    pipe_ = ends[0];
    return true;
  }
  close(ends[0]);
  return false;
}

std::optional<std::string> FileDialog::take() {
  if (!open()) return std::nullopt;
  std::array<char, 4096> part{};
  ssize_t count = 0;
  while ((count = read(pipe_, part.data(), part.size())) > 0)
    chosen_.append(part.data(), static_cast<std::size_t>(count));
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  close(pipe_);
  pipe_ = -1;
  int status = 0;
  waitpid(child_, &status, 0);  // it has closed its output, so it is about to exit
  child_ = 0;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::string();
  while (!chosen_.empty() && chosen_.back() == '\n') chosen_.pop_back();
  return chosen_;
}

bool show_folder(const std::filesystem::path& folder) {
  const auto opener = program("xdg-open");
  // Forked twice, so that no process remains to be waited for: `sh` exits at once.
  if (!opener) return false;
  const int child = start({"/bin/sh", "-c", "\"$0\" \"$1\" >/dev/null 2>&1 &", *opener,
                           folder.empty() ? std::string(".") : folder.string()},
                          -1);
  if (child <= 0) return false;
  waitpid(child, nullptr, 0);
  return true;
}

}  // namespace clay::studio
