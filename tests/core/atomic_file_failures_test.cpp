// The old file survives killed writers, full disks and failing system calls.

#include "core/temporary_name.hpp"
#include "tests/core/atomic_folder.hpp"
#include "tests/core/system_call_fault.hpp"

#include <sys/resource.h>
#include <array>
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

TEST_F(AtomicFileFailures, KilledWriterLeavesNoTemporaryFile) {
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

/// File systems with names in Unicode refuse half a character.
TEST_F(AtomicFileFailures, CutsALongNameBetweenTwoCharacters) {
  std::string name = "p";
  for (int k = 0; k < 40; ++k) name += "\u00F6";  // 2 bytes: those before byte 64 end at 63
  const auto [descriptor, temporary] = open_temporary(folder_ / name);
  ASSERT_NE(descriptor, -1);
  ::close(descriptor);
  EXPECT_EQ(temporary.path().filename().string(), "." + name.substr(0, 63) + ".claystack-1");
}

TEST_F(AtomicFileFailures, FullDiskKeepsTheOldFile) {
  const fs::path path = folder_ / "pot";
  put(path, "old");
  const int status = status_of_child([&] {
    // A limit on file size simulates a disk that becomes full during a write.
    const rlimit limit{100'000, 100'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::signal(SIGXFSZ, SIG_IGN);
    auto file = AtomicFile::create(path);
    const auto written = file->write(std::string(150'000, 'x'));
    // A failed file must not be published later.
    return !written &&
           written.error().message ==
               path.string() + ": could not write: " + std::strerror(EFBIG) &&
           !file->commit();
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(bytes_in(path), "old");
  EXPECT_EQ(names(), std::set<std::string>{"pot"});
}

// Until several files are published, the old ones wait under temporary names.
TEST_F(AtomicFileFailures, AnotherWriterRemovesNoOldFileThatIsInUse) {
  const fs::path path = folder_ / "pot";
  put(path, "old");
  for (const bool locked : {true, false}) {
    TemporaryName old = TemporaryName::take(path, [&](const char* fresh) {
                          return ::link(path.c_str(), fresh);
                        }).second;
    if (locked) old.lock();
    ASSERT_TRUE(AtomicFile::create(path));
    EXPECT_EQ(fs::exists(old.path()), locked);
  }
}

TEST_F(AtomicFileFailures, RefusesAReadOnlyFolderAndAReadOnlyFile) {
  const fs::path locked = folder_ / "locked";
  fs::create_directory(locked);
  put(folder_ / "read only", "old");
  ASSERT_EQ(::chmod(folder_.c_str(), 0777), 0);
  ASSERT_EQ(::chmod(locked.c_str(), 0555), 0);
  ASSERT_EQ(::chmod((folder_ / "read only").c_str(), 0444), 0);
  const int status = status_of_child([&] {
    // Permissions do not restrict root.
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

TEST_F(AtomicFileFailures, ReportsATargetFolderRemovedBeforeCommit) {
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

TEST_F(AtomicFileFailures, ReportsEveryFailingSystemCall) {
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

TEST_F(AtomicFileFailures, PublishesInAFolderThatCannotBeSynced) {
  for (const SystemCallFault& folder_fault :
       {SystemCallFault{SYS_openat, EIO, O_DIRECTORY}, {SYS_openat, EACCES, O_DIRECTORY}}) {
    const int status = status_under(folder_fault, [&] {
      auto pot = AtomicFile::create(folder_ / "pot").value();
      auto cup = AtomicFile::create(folder_ / "cup").value();
      return pot.write("new") && cup.write("too") && commit_all(std::array{&pot, &cup});
    });
    EXPECT_EQ(status, 0);
    EXPECT_EQ(bytes_in(folder_ / "pot"), "new");
    EXPECT_EQ(bytes_in(folder_ / "cup"), "too");
    EXPECT_EQ(names(), (std::set<std::string>{"cup", "pot"}));
  }
}

/// Runs `work` in a child process without root rights, which permissions restrict.
template <class Work>
int status_as_nobody(Work work) {
  return status_of_child([&] {
    constexpr uid_t kNobody = 65534;
    return (::getuid() != 0 || ::setuid(kNobody) == 0) && work();
  });
}

TEST_F(AtomicFileFailures, PublishesInAFolderThatCannotBeRead) {
  ASSERT_EQ(::chmod(folder_.c_str(), 0777), 0);
  const fs::path unreadable = folder_ / "unreadable";
  EXPECT_EQ(status_as_nobody([&] {
              return ::mkdir(unreadable.c_str(), 0777) == 0 &&
                     ::chmod(unreadable.c_str(), 0333) == 0 &&
                     publish(unreadable / "pot", "new").has_value();
            }),
            0);
  EXPECT_EQ(bytes_in(unreadable / "pot"), "new");
}

TEST_F(AtomicFileFailures, PublishesAllFilesOrNone) {
  const fs::path kiln = folder_ / "kiln";
  fs::create_directory(kiln);
  put(folder_ / "old", "old");
  ASSERT_EQ(::chmod((folder_ / "old").c_str(), 0604), 0);
  auto old = AtomicFile::create(folder_ / "old").value();
  auto fresh = AtomicFile::create(folder_ / "fresh").value();
  auto blocked = AtomicFile::create(folder_ / "blocked").value();
  for (AtomicFile* file : {&old, &fresh, &blocked}) {
    ASSERT_TRUE(file->write("new"));
    ASSERT_TRUE(file->prepare());
  }
  fs::create_directory(folder_ / "blocked");
  const std::array all{&old, &fresh, &blocked};
  expect_io_error(commit_all(all), folder_ / "blocked", EISDIR);
  EXPECT_EQ(bytes_in(folder_ / "old"), "old");
  EXPECT_EQ(mode_of(folder_ / "old"), 0604u);
  EXPECT_EQ(names(), (std::set<std::string>{"blocked", "kiln", "old"}));
  EXPECT_FALSE(old.commit());  // a failed file is not published later

  // Fails before any file gets its name; then succeeds without a fault.
  auto orphan = AtomicFile::create(kiln / "pot").value();
  auto first = AtomicFile::create(folder_ / "old").value();
  ASSERT_TRUE(first.write("new"));
  fs::remove(kiln);
  expect_io_error(commit_all(std::array{&first, &orphan}), kiln / "pot", ENOENT);
  EXPECT_EQ(bytes_in(folder_ / "old"), "old");
  auto again = AtomicFile::create(folder_ / "old").value();
  auto pot = AtomicFile::create(folder_ / "pot").value();
  ASSERT_TRUE(again.write("1") && pot.write("2"));
  ASSERT_TRUE(commit_all(std::array{&again, &pot}));
  EXPECT_EQ(bytes_in(folder_ / "old"), "1");
  EXPECT_EQ(bytes_in(folder_ / "pot"), "2");
  EXPECT_EQ(names(), (std::set<std::string>{"blocked", "old", "pot"}));
}

TEST_F(AtomicFileFailures, UsesATemporaryNameWithoutUnnamedFiles) {
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

/// The exit status of a writer of `path` that a signal ends; it leaves a temporary file.
int status_of_writer(const fs::path& path, int signal) {
  return status_under(kNoUnnamedFiles, [&] {
    auto file = AtomicFile::create(path);
    if (file && file->write("part")) ::raise(signal);
    return false;
  });
}

TEST_F(AtomicFileFailures, NextWriterRemovesFilesOfAKilledWriter) {
  const std::string longest(255, 'n');
  for (const std::string& name : {std::string("pot"), longest}) {
    const fs::path path = folder_ / name;
    put(path, "old");
    ASSERT_TRUE(WIFSIGNALED(status_of_writer(path, SIGKILL)));
    ASSERT_TRUE(WIFSIGNALED(status_of_writer(folder_ / "cup", SIGKILL)));
    ASSERT_EQ(names().size(), 3u);
    ASSERT_TRUE(publish(folder_ / "cup", "new"));
    ASSERT_EQ(names().size(), 3u);  // the file of another target stays
    ASSERT_TRUE(publish(path, "new"));
    EXPECT_EQ(names(), (std::set<std::string>{"cup", name}));
    fs::remove(folder_ / "cup");
    fs::remove(path);
  }
}

TEST_F(AtomicFileFailures, ConcurrentWritersDoNotInterfere) {
  const int status = status_under(kNoUnnamedFiles, [&] {
    auto first = AtomicFile::create(folder_ / "pot").value();
    auto second = AtomicFile::create(folder_ / "pot").value();
    if (names().size() != 2 || !first.write("first") || !second.write("second")) return false;
    return first.commit() && bytes_in(folder_ / "pot") == "first" && second.commit().has_value();
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(bytes_in(folder_ / "pot"), "second");
  EXPECT_EQ(names(), std::set<std::string>{"pot"});
}

TEST_F(AtomicFileFailures, SignalHandlerRemovesTemporaryFiles) {
  const int status = status_under(kNoUnnamedFiles, [&] {
    auto gone = AtomicFile::create(folder_ / "pot").value();
    auto kept = AtomicFile::create(folder_ / "cup").value();
    if (!kept.commit() || names().size() != 2) return false;
    remove_temporary_files();
    return names() == std::set<std::string>{"cup"};
  });
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace clay
