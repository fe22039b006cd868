// A library to preload (LD_PRELOAD): makes the n-th call that changes a folder fail, or ends the
// program there.
//
//   CLAYSTACK_FAULT_FOLDER   the folder to watch: absolute, without symbolic links
//   CLAYSTACK_FAULT_AT       the call that fails, counted from 1; without it none does
//   CLAYSTACK_FAULT_ERRNO    the error it gives
//   CLAYSTACK_FAULT_SIGNAL   raise this signal before the call instead
//   CLAYSTACK_FAULT_LOG      the name of the call that failed is written to this file
//   CLAYSTACK_FAULT_THREAD   the start of a thread that fails instead, counted from 1
//   CLAYSTACK_FAULT_WITHOUT  what the system does not have: a list of
//                            tmpfile (unnamed files), links (hard links), proc (/proc/self/fd)
//   CLAYSTACK_FAULT_ORPHAN   a process that asks for a signal at the end of its parent loses that
//                            before
//
// Counted are open, write, fsync, rename, link, linkat, close and ftruncate, on files of the folder
// and on the folder itself; an open or a link that fails by itself is not.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

long number(const char* variable) {
  const char* text = std::getenv(variable);
  return text == nullptr ? 0 : std::strtol(text, nullptr, 10);
}

bool is_without(const char* what) {
  const char* list = std::getenv("CLAYSTACK_FAULT_WITHOUT");
  return list != nullptr && std::strstr(list, what) != nullptr;
}

bool is_watched(const char* path) {
  const char* folder = std::getenv("CLAYSTACK_FAULT_FOLDER");
  return folder != nullptr && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool is_watched(int descriptor) {
  char name[64], path[4096] = {};
  std::snprintf(name, sizeof name, "/proc/self/fd/%d", descriptor);
  return syscall(SYS_readlinkat, AT_FDCWD, name, path, sizeof path - 1) > 0 && is_watched(path);
}

void log(const char* call) {
  const char* path = std::getenv("CLAYSTACK_FAULT_LOG");
  if (path == nullptr) return;
  const long file = syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND, 0666);
  (void)syscall(SYS_write, file, call, std::strlen(call));
  (void)syscall(SYS_close, file);
}

/// Whether this counted call is the one that fails; then `errno` is set.
bool fails(const char* call) {
  static std::atomic<long> calls = 0;
  if (++calls != number("CLAYSTACK_FAULT_AT")) return false;
  log(call);
  if (const long signal = number("CLAYSTACK_FAULT_SIGNAL"); signal != 0) {
    raise(static_cast<int>(signal));
    return false;
  }
  errno = static_cast<int>(number("CLAYSTACK_FAULT_ERRNO"));
  return true;
}

template <class Call>
Call* next(const char* name) {
  return reinterpret_cast<Call*>(dlsym(RTLD_NEXT, name));
}

int opened(const char* path, int flags, mode_t mode) {
  if (is_without("tmpfile") && (flags & O_TMPFILE) == O_TMPFILE && is_watched(path)) {
    errno = EOPNOTSUPP;
    return -1;
  }
  struct stat before {};
  const bool is_new = lstat(path, &before) == -1;
  const int file = static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  if (file == -1 || !is_watched(path) || !fails("open")) return file;
  const int error = errno;
  (void)syscall(SYS_close, file);
  if (is_new) (void)unlink(path);
  errno = error;
  return -1;
}

int linked(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  if (is_without("proc") && std::strncmp(from, "/proc/", 6) == 0) {
    errno = ENOENT;
    return -1;
  }
  if (is_without("links") && is_watched(to)) {
    errno = EPERM;
    return -1;
  }
  struct stat before {};
  if (is_watched(to) && lstat(to, &before) == -1 && fails("link")) return -1;
  return static_cast<int>(syscall(SYS_linkat, from_folder, from, to_folder, to, flags));
}

mode_t mode_in(int flags, va_list arguments) {
  const bool has_mode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  return has_mode ? static_cast<mode_t>(va_arg(arguments, int)) : 0;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_in(flags, arguments);
  va_end(arguments);
  return opened(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_in(flags, arguments);
  va_end(arguments);
  return opened(path, flags, mode);
}

int access(const char* path, int mode) noexcept {
  if (is_without("proc") && std::strncmp(path, "/proc/", 6) == 0) {
    errno = ENOENT;
    return -1;
  }
  return next<decltype(access)>("access")(path, mode);
}

ssize_t write(int file, const void* bytes, size_t count) {
  if (is_watched(file) && fails("write")) return -1;
  return syscall(SYS_write, file, bytes, count);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                   void* data) noexcept {
  static std::atomic<long> threads = 0;
  if (++threads == number("CLAYSTACK_FAULT_THREAD")) return EAGAIN;
  return next<decltype(pthread_create)>("pthread_create")(thread, attributes, run, data);
}

int prctl(int option, ...) noexcept {
  va_list arguments;
  va_start(arguments, option);
  const auto argument = va_arg(arguments, unsigned long);
  va_end(arguments);
  if (option == PR_SET_PDEATHSIG && std::getenv("CLAYSTACK_FAULT_ORPHAN") != nullptr) {
    const pid_t parent = getppid();
    (void)kill(parent, SIGKILL);
    while (getppid() == parent) (void)usleep(1000);
  }
  return static_cast<int>(syscall(SYS_prctl, option, argument, 0ul, 0ul, 0ul));
}

int fsync(int file) {
  if (is_watched(file) && fails("fsync")) return -1;
  return static_cast<int>(syscall(SYS_fsync, file));
}

int ftruncate(int file, off_t bytes) noexcept {
  if (is_watched(file) && fails("ftruncate")) return -1;
  return static_cast<int>(syscall(SYS_ftruncate, file, bytes));
}

int close(int file) {
  const bool failing = is_watched(file) && fails("close");
  const int error = errno;
  const int result = static_cast<int>(syscall(SYS_close, file));
  if (!failing) return result;
  errno = error;
  return -1;
}

int rename(const char* from, const char* to) noexcept {
  if (is_watched(to) && fails("rename")) return -1;
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int link(const char* from, const char* to) noexcept {
  return linked(AT_FDCWD, from, AT_FDCWD, to, 0);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  return linked(from_folder, from, to_folder, to, flags);
}

}  // extern "C"
