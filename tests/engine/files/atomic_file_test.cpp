#include "claystack/engine/atomic_file.hpp"

#include "engine/files/system_call_fault.hpp"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/stat.h>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace clay {
namespace {

namespace fs = std::filesystem;
using test::status_of_child;
using test::SystemCallFault;

std::string bytes_in(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

class AtomicFileTest : public ::testing::Test {
 protected:
  AtomicFileTest() {
    std::string pattern = ::testing::TempDir() + "claystack-XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  ~AtomicFileTest() override { fs::remove_all(folder_); }

  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
      names.insert(entry.path().filename().string());
    return names;
  }

  fs::path folder_;
};

/// The message says which file and why.
void expect_io_error(const Result<void>& result, const fs::path& path, int error) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::io);
  EXPECT_NE(result.error().message.find(path.string()), std::string::npos)
      << result.error().message;
  EXPECT_NE(result.error().message.find(std::strerror(error)), std::string::npos)
      << result.error().message;
}

void expect_says(const Result<void>& result, std::string_view says) {
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find(says), std::string::npos) << result.error().message;
}

TEST_F(AtomicFileTest, PublishesAndReadsBack) {
  const fs::path path = folder_ / "pot";
  const std::string bytes = std::string(1'000'000, 'x') + '\0' + "end\n";
  ASSERT_TRUE(publish(path, bytes));
  EXPECT_EQ(bytes_in(path), bytes);
  EXPECT_EQ(read_file(path).value(), bytes);
  ASSERT_TRUE(publish(path, "less"));
  EXPECT_EQ(bytes_in(path), "less");
  ASSERT_TRUE(publish(path, ""));
  EXPECT_EQ(read_file(path).value(), "");
  EXPECT_EQ(names(), std::set<std::string>{"pot"});
}

TEST_F(AtomicFileTest, ShowsNothingBeforeTheCommit) {
  const fs::path path = folder_ / "pot";
  put(path, "old");
  auto file = AtomicFile::create(path);
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->write("ne"));
  EXPECT_EQ(names(), std::set<std::string>{"pot"});
  EXPECT_EQ(bytes_in(path), "old");
  ASSERT_TRUE(file->write("w"));
  AtomicFile moved = std::move(*file);
  ASSERT_TRUE(moved.commit());
  EXPECT_EQ(bytes_in(path), "new");
  EXPECT_FALSE(moved.commit());
  EXPECT_EQ(names(), std::set<std::string>{"pot"});
}

TEST_F(AtomicFileTest, WhatIsWrittenCanBeReadAgainBeforeTheCommit) {
  auto file = AtomicFile::create(folder_ / "pot").value();
  ASSERT_TRUE(file.rereadable());
  ASSERT_TRUE(file.write(std::string_view("clay and water")));
  std::string again(5, ' ');
  ASSERT_TRUE(file.read_at(9, std::as_writable_bytes(std::span(again))));
  EXPECT_EQ(again, "water");
  expect_says(file.read_at(10, std::as_writable_bytes(std::span(again))), "ends early");
  ASSERT_TRUE(file.write(std::string_view("!")));  // reading has not moved the end
  ASSERT_TRUE(file.commit());
  EXPECT_EQ(bytes_in(folder_ / "pot"), "clay and water!");
}

TEST_F(AtomicFileTest, DevicesCannotBeReadAgain) {
  auto file = AtomicFile::create("/dev/null").value();
  EXPECT_FALSE(file.rereadable());
  std::string again(1, ' ');
  expect_says(file.read_at(0, std::as_writable_bytes(std::span(again))), "cannot be read again");
}

TEST_F(AtomicFileTest, LeavesNoTraceWithoutACommit) {
  { ASSERT_TRUE(AtomicFile::create(folder_ / "pot")->write("x")); }
  EXPECT_TRUE(names().empty());
}

TEST_F(AtomicFileTest, KeepsTheModeOfAnExistingFile) {
  const fs::path path = folder_ / "pot";
  put(path, "old");
  ASSERT_EQ(::chmod(path.c_str(), 0751), 0);
  ASSERT_TRUE(publish(path, "new"));
  EXPECT_EQ(mode_of(path), 0751u);
}

TEST_F(AtomicFileTest, RespectsTheUmask) {
  const mode_t before = ::umask(027);
  const auto published = publish(folder_ / "pot", "new");
  ::umask(before);
  ASSERT_TRUE(published);
  EXPECT_EQ(mode_of(folder_ / "pot"), 0640u);
}

TEST_F(AtomicFileTest, KeepsSymbolicLinks) {
  fs::create_directory(folder_ / "kiln");
  put(folder_ / "kiln/pot", "old");
  fs::create_symlink("kiln/pot", folder_ / "link");
  fs::create_symlink("link", folder_ / "link to link");
  fs::create_symlink(folder_ / "kiln/new pot", folder_ / "dangling");
  ASSERT_TRUE(publish(folder_ / "link to link", "new"));
  ASSERT_TRUE(publish(folder_ / "dangling", "first"));
  EXPECT_EQ(fs::read_symlink(folder_ / "link to link"), "link");
  EXPECT_EQ(fs::read_symlink(folder_ / "link"), "kiln/pot");
  EXPECT_TRUE(fs::is_symlink(folder_ / "dangling"));
  EXPECT_EQ(bytes_in(folder_ / "kiln/pot"), "new");
  EXPECT_EQ(bytes_in(folder_ / "kiln/new pot"), "first");
}

TEST_F(AtomicFileTest, RefusesTargetsThatCannotBeFiles) {
  const auto refused = publish(folder_, "x");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            folder_.string() + ": expected the name of a file, found a folder");
  EXPECT_FALSE(publish(folder_ / "", "x"));
  EXPECT_FALSE(publish("", "x"));
  expect_io_error(publish(folder_ / "missing/pot", "x"), folder_ / "missing/pot", ENOENT);
  const fs::path long_name = folder_ / std::string(300, 'n');
  expect_io_error(publish(long_name, "x"), long_name, ENAMETOOLONG);
  fs::create_symlink("loop", folder_ / "loop");
  expect_io_error(publish(folder_ / "loop", "x"), folder_ / "loop", ELOOP);
  EXPECT_EQ(names(), std::set<std::string>{"loop"});
}

TEST_F(AtomicFileTest, WritesStraightToPipesAndDevices) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_TRUE(publish(pipe, "through"));
  char text[16] = {};
  EXPECT_EQ(::read(reader, text, sizeof text), 7);
  EXPECT_STREQ(text, "through");
  ::close(reader);
  EXPECT_TRUE(publish("/dev/null", "gone"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  expect_io_error(publish("/dev/full", "x"), "/dev/full", ENOSPC);
}

TEST_F(AtomicFileTest, TakesADashForTheStandardStreams) {
  put(folder_ / "in", "through");
  const int status = status_of_child([&] {
    ::dup2(::open((folder_ / "in").c_str(), O_RDONLY), STDIN_FILENO);
    ::dup2(::open((folder_ / "out").c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    const auto text = read_file("-");
    return text && publish("-", *text) && publish("-", "!");
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(bytes_in(folder_ / "out"), "through!");
}

TEST_F(AtomicFileTest, ReadFileRefusesWhatIsNotThereOrTooLarge) {
  put(folder_ / "ten", "0123456789");
  EXPECT_EQ(read_file(folder_ / "ten", 10).value(), "0123456789");
  EXPECT_EQ(read_file(folder_ / "ten", 9).error().message,
            (folder_ / "ten").string() + ": expected at most 9 bytes, found 10");
  EXPECT_EQ(read_file("/dev/zero", 1000).error().message,
            "/dev/zero: expected at most 1000 bytes, found more");
  // Tells no size before it is read.
  EXPECT_TRUE(read_file("/proc/self/status", 1'000'000));
  EXPECT_FALSE(read_file("/proc/self/status", 10));
  EXPECT_EQ(read_file(folder_).error().message,
            folder_.string() + ": expected a file, found a folder");
  const auto missing = read_file(folder_ / "missing");
  EXPECT_EQ(missing.error().kind, ErrorKind::io);
  EXPECT_EQ(missing.error().message,
            (folder_ / "missing").string() + ": cannot open: " + std::strerror(ENOENT));
}

TEST_F(AtomicFileTest, AKilledWriterLeavesNoLitter) {
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

TEST_F(AtomicFileTest, AFullDiskLeavesTheOldFile) {
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

TEST_F(AtomicFileTest, RefusesAReadOnlyFolderAndAReadOnlyFile) {
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

TEST_F(AtomicFileTest, FindsTheTargetGoneAtTheCommit) {
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

TEST_F(AtomicFileTest, ReportsEverySystemCallThatFails) {
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

TEST_F(AtomicFileTest, ReportsAFolderThatCannotBeSynced) {
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

TEST_F(AtomicFileTest, TakesATemporaryNameWhereFilesCannotBeUnnamed) {
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
