#include "tests/core/atomic_folder.hpp"
#include "tests/core/system_call_fault.hpp"

#include <cerrno>
#include <span>

namespace clay {
namespace {

namespace fs = std::filesystem;
using test::bytes_in;
using test::expect_io_error;
using test::mode_of;
using test::put;
using test::status_of_child;

class AtomicFileTest : public test::AtomicFileFolder {};

void expect_message(const Result<void>& result, std::string_view part) {
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
}

TEST_F(AtomicFileTest, PublishesAndReadsBack) {
  const fs::path path = folder_ / "pot";
  std::string bytes(1'000'000, 'x');
  bytes.append("\0end\n", 5);
  ASSERT_TRUE(publish(path, bytes));
  EXPECT_EQ(bytes_in(path), bytes);
  EXPECT_EQ(read_file(path).value(), bytes);
  ASSERT_TRUE(publish(path, "less"));
  EXPECT_EQ(bytes_in(path), "less");
  ASSERT_TRUE(publish(path, ""));
  EXPECT_EQ(read_file(path).value(), "");
  EXPECT_EQ(names(), std::set<std::string>{"pot"});
}

TEST_F(AtomicFileTest, IsInvisibleBeforeCommit) {
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

TEST_F(AtomicFileTest, WrittenBytesAreReadableBeforeCommit) {
  auto file = AtomicFile::create(folder_ / "pot").value();
  ASSERT_TRUE(file.rereadable());
  ASSERT_TRUE(file.write(std::string_view("clay and water")));
  std::string again(5, ' ');
  ASSERT_TRUE(file.read_at(9, std::as_writable_bytes(std::span(again))));
  EXPECT_EQ(again, "water");
  expect_message(file.read_at(10, std::as_writable_bytes(std::span(again))), "ends early");
  ASSERT_TRUE(file.write(std::string_view("!")));  // reading has not moved the write position
  ASSERT_TRUE(file.commit());
  EXPECT_EQ(bytes_in(folder_ / "pot"), "clay and water!");
}

TEST_F(AtomicFileTest, DevicesAreNotRereadable) {
  auto file = AtomicFile::create("/dev/null").value();
  EXPECT_FALSE(file.rereadable());
  std::string again(1, ' ');
  expect_message(file.read_at(0, std::as_writable_bytes(std::span(again))), "cannot be read again");
}

TEST_F(AtomicFileTest, LeavesNoFileWithoutCommit) {
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

TEST_F(AtomicFileTest, WritesDirectlyToPipesAndDevices) {
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

TEST_F(AtomicFileTest, ADashMeansTheStandardStreams) {
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

TEST_F(AtomicFileTest, ReadFileRefusesMissingAndLargeFiles) {
  put(folder_ / "ten", "0123456789");
  EXPECT_EQ(read_file(folder_ / "ten", 10).value(), "0123456789");
  EXPECT_EQ(read_file(folder_ / "ten", 9).error().message,
            (folder_ / "ten").string() + ": expected at most 9 bytes, found 10");
  EXPECT_EQ(read_file("/dev/zero", 1000).error().message,
            "/dev/zero: expected at most 1000 bytes, found more");
  // A file that reports no size before it is read.
  EXPECT_TRUE(read_file("/proc/self/status", 1'000'000));
  EXPECT_FALSE(read_file("/proc/self/status", 10));
  EXPECT_EQ(read_file(folder_).error().message,
            folder_.string() + ": expected a file, found a folder");
  const auto missing = read_file(folder_ / "missing");
  EXPECT_EQ(missing.error().kind, ErrorKind::io);
  EXPECT_EQ(missing.error().message,
            (folder_ / "missing").string() + ": could not open: " + std::strerror(ENOENT));
}

}  // namespace
}  // namespace clay
