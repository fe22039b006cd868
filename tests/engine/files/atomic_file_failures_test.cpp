// Writers that are killed, full disks, and system calls that fail: what stood there stays.

#include "engine/files/atomic_folder.hpp"
#include "engine/files/system_call_fault.hpp"

#include <sys/resource.h>
#include <cerrno>
#include <csignal>

namespace clay {
namespace {

namespace fs = std::filesystem;
using test::bytes_in;
using test::expect_io_error;
using test::mode_of;
using test::put;
using test::status_of_child;
using test::SystemCallFault;

class AtomicFileFailures : public test::AtomicFileFolder {};

TEST_F(AtomicFileFailures, AKilledWriterLeavesNoLitter) {
  const fs::path path = folder_ / "pot";
  put(path, "old");
  const int status = status_of_child([&] {
    auto file = AtomicFile::create(path);
    if (file && file->write(std::string(1'000'000, 'x'))) ::raise(SIGKILL);
    return false;
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(bytes_in(path), "old");
  EXPECT_EQ(names(), std::set<std::string>{"pot"});
}

TEST_F(AtomicFileFailures, AFullDiskLeavesTheOldFile) {
  const fs::path path = folder_ / "pot";
  put(path, "old");
  const int status = status_of_child([&] {
    // A limit on the size of files stands in for a disk that is full after a part of a write.
    const rlimit limit{100'000, 100'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::signal(SIGXFSZ, SIG_IGN);
    auto file = AtomicFile::create(path);
    const auto written = file->write(std::string(150'000, 'x'));
    // What failed once must not be published after all.
    return !written &&
           written.error().message == path.string() + ": cannot write: " + std::strerror(EFBIG) &&
           !file->commit();
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(bytes_in(path), "old");
  EXPECT_EQ(names(), std::set<std::string>{"pot"});
}

TEST_F(AtomicFileFailures, RefusesAReadOnlyFolderAndAReadOnlyFile) {
  const fs::path locked = folder_ / "locked";
  fs::create_directory(locked);
  put(folder_ / "read only", "old");
  ASSERT_EQ(::chmod(folder_.c_str(), 0777), 0);
  ASSERT_EQ(::chmod(locked.c_str(), 0555), 0);
  ASSERT_EQ(::chmod((folder_ / "read only").c_str(), 0444), 0);
  const int status = status_of_child([&] {
    // Modes do not bind root.
    constexpr uid_t kNobody = 65534;
    if (::getuid() == 0 && ::setuid(kNobody) != 0) return false;
    expect_io_error(publish(locked / "pot", "x"), locked / "pot", EACCES);
    expect_io_error(publish(folder_ / "read only", "x"), folder_ / "read only", EACCES);
    return !::testing::Test::HasFailure();
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(bytes_in(folder_ / "read only"), "old");
  EXPECT_EQ(names(), (std::set<std::string>{"locked", "read only"}));
}

TEST_F(AtomicFileFailures, FindsTheTargetGoneAtTheCommit) {
  fs::create_directory(folder_ / "kiln");
  auto orphan = AtomicFile::create(folder_ / "kiln/pot").value();
  fs::remove(folder_ / "kiln");
  expect_io_error(orphan.commit(), folder_ / "kiln/pot", ENOENT);

  auto blocked = AtomicFile::create(folder_ / "pot").value();
  fs::create_directory(folder_ / "pot");
  expect_io_error(blocked.commit(), folder_ / "pot", EISDIR);
  EXPECT_EQ(names(), std::set<std::string>{"pot"});
}

/// Runs `work` in a child in which a system call fails.
template <class Work>
int status_under(const SystemCallFault& fault, Work work) {
  return status_of_child([&] { return test::inject(fault) && work(); });
}

TEST_F(AtomicFileFailures, ReportsEverySystemCallThatFails) {
  const fs::path path = folder_ / "pot";
  put(path, "old");
  for (const SystemCallFault& fault : {
           SystemCallFault{SYS_openat, EMFILE, O_RDWR},
           {SYS_write, ENOSPC},
           {SYS_fchmod, EPERM},
           {SYS_fsync, EIO},
           {SYS_linkat, EXDEV},
           {SYS_close, EIO},
           {test::kRenameCall, EACCES},
       }) {
    const int status = status_under(fault, [&] {
      const auto published = publish(path, "new");
      return !published && published.error().kind == ErrorKind::io &&
             published.error().message.starts_with(path.string()) &&
             published.error().message.ends_with(std::strerror(static_cast<int>(fault.error)));
    });
    EXPECT_EQ(status, 0) << "system call " << fault.call;
    EXPECT_EQ(bytes_in(path), "old") << "system call " << fault.call;
    EXPECT_EQ(names(), std::set<std::string>{"pot"}) << "system call " << fault.call;
  }
}

constexpr SystemCallFault kNoUnnamedFiles{SYS_openat, EOPNOTSUPP, O_TMPFILE & ~O_DIRECTORY};

TEST_F(AtomicFileFailures, ReportsAFolderThatCannotBeSynced) {
  // Of two faults for one call the later counts: folders fail, unnamed files are unknown.
  const int status = status_under({SYS_openat, EIO, O_DIRECTORY}, [&] {
    if (!test::inject(kNoUnnamedFiles)) return false;
    expect_io_error(publish(folder_ / "pot", "new"), folder_, EIO);
    return !::testing::Test::HasFailure();
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(bytes_in(folder_ / "pot"), "new");
  EXPECT_EQ(names(), std::set<std::string>{"pot"});
}

TEST_F(AtomicFileFailures, TakesATemporaryNameWhereFilesCannotBeUnnamed) {
  const fs::path path = folder_ / "pot";
  put(path, "old");
  ASSERT_EQ(::chmod(path.c_str(), 0604), 0);
  EXPECT_EQ(status_under(kNoUnnamedFiles, [&] { return publish(path, "new").has_value(); }), 0);
  EXPECT_EQ(bytes_in(path), "new");
  EXPECT_EQ(mode_of(path), 0604u);
  const int status = status_under(kNoUnnamedFiles, [&] {
    auto file = AtomicFile::create(path);
    return file && file->write("newer").has_value() && names().size() == 2;
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(bytes_in(path), "new");
  EXPECT_EQ(names(), std::set<std::string>{"pot"});
}

}  // namespace
}  // namespace clay
