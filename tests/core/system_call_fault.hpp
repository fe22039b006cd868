#pragma once
// Makes system calls fail by a seccomp filter: the kernel returns the error, so the code under test
// needs no hooks.

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace clay::test {

#ifdef SYS_rename
inline constexpr long kRenameCall = SYS_rename;
#else
inline constexpr long kRenameCall = SYS_renameat;  // the replacement on newer architectures
#endif

struct SystemCallFault {
  long call;                           ///< SYS_...
  unsigned error;                      ///< the errno it returns
  std::optional<unsigned> flags = {};  ///< only if the third argument has these
};

/// Applies to this process permanently.
inline bool inject(const SystemCallFault& fault) {
  const auto load = [](std::size_t offset) {
    return sock_filter(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
  };
  const auto answer = [](unsigned value) { return sock_filter(BPF_STMT(BPF_RET | BPF_K, value)); };
  const auto unless = [](std::uint16_t test, std::uint32_t operand, std::uint8_t skip) {
    return sock_filter(
        BPF_JUMP(static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), operand, 0, skip));
  };
  std::vector<sock_filter> program = {
      load(offsetof(seccomp_data, nr)),
      unless(BPF_JEQ, static_cast<std::uint32_t>(fault.call), fault.flags ? 3 : 1)};
  if (fault.flags) {
    program.push_back(load(offsetof(seccomp_data, args) + 2 * sizeof(std::uint64_t)));
    program.push_back(unless(BPF_JSET, *fault.flags, 1));
  }
  program.push_back(answer(SECCOMP_RET_ERRNO | fault.error));
  program.push_back(answer(SECCOMP_RET_ALLOW));
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

/// The wait status of a child that runs `work` and exits with its result, 0 for true.
template <class Work>
int status_of_child(Work work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work() ? 0 : 1);
  int status = -1;
  ::waitpid(child, &status, 0);
  return status;
}

}  // namespace clay::test
