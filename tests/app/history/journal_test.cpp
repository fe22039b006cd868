#include "app/history/journal.hpp"

#include "app/history/file_lock.hpp"
#include "app/history/recovery.hpp"
#include "app/servo/recorder.hpp"
#include "tests/app/history/strokes.hpp"
#include "tests/core/system_call_fault.hpp"
#include "tests/support/no_new_threads.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/wait_until.hpp"

#include <gtest/gtest.h>
#include <pwd.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <new>
#include <thread>

namespace clay::history {
namespace {

using test::plainly_thrown;
using test::press_stroke;
using test::small_scene;

/// A separate folder for journals.
struct Folder {
  test::ScratchFolder scratch;
  std::filesystem::path path = scratch.file("state/claystack/recovery");
};

Work kept_work(const Folder& folder) {
  Work work = Work::begin(small_scene()).value();
  work.keep(Journal::begin(work.record(), folder.path).value());
  return work;
}

/// The journal of a work that `change` has changed and that is open no more.
template <class Change>
std::filesystem::path journal_left(const Folder& folder, Change change) {
  Work work = kept_work(folder);
  const std::filesystem::path path = work.journal()->path();
  change(work);
  return path;
}

TEST(Journal, RecordsEveryEvent) {
  const Folder folder;
  std::filesystem::path path;
  WorkRecord record;
  {
    Work work = kept_work(folder);
    path = work.journal()->path();
    (void)work.add(small_scene(), press_stroke(1)).value();
    (void)work.add(small_scene(5.0), press_stroke(2)).value();
    work.undo();
    (void)work.add(small_scene(8.0, ToolMode::trim), press_stroke(3)).value();
    work.undo();
    EXPECT_FALSE(work.journal()->trouble());
    record = work.record();
  }
  const auto all = recoverable(folder.path);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].path, path);
  EXPECT_EQ(all[0].scene, "small");
  EXPECT_EQ(all[0].strokes, 3u);
  EXPECT_NEAR(all[0].seconds, 0.54, 1e-9);
  EXPECT_FALSE(all[0].running || all[0].damage);
  Work work = recover(path).value();
  EXPECT_EQ(work.record().nodes, record.nodes);
  EXPECT_EQ(work.record().scenes, record.scenes);
  EXPECT_EQ(work.at(), 1u);
  EXPECT_TRUE(work.unsaved());
}

TEST(Journal, HoldsAStrokeFromItsFirstContactWithEarlierPoses) {
  const Folder folder;
  std::filesystem::path path;
  const auto poses = press_stroke(2);
  {
    Work work = kept_work(folder);
    path = work.journal()->path();
    (void)work.add(small_scene(), press_stroke(1)).value();
    test::record(press_stroke(3), *work.begin_stroke(small_scene()).value().sink, false);
    (void)work.end_stroke().value();
    PoseSink& sink = *work.begin_stroke(small_scene()).value().sink;
    test::record({poses.begin(), poses.begin() + 100}, sink, false);
    test::record({poses.begin() + 100, poses.end()}, sink);
    EXPECT_FALSE(work.journal()->trouble());
  }
  Work work = recover(path).value();
  ASSERT_EQ(work.size(), 3u);
  EXPECT_EQ(work.record().nodes[2].poses, poses);
}

TEST(Journal, ContinuesAfterARecovery) {
  const Folder folder;
  {
    Work work = kept_work(folder);
    (void)work.add(small_scene(), press_stroke(1)).value();
  }
  const auto path = recoverable(folder.path).at(0).path;
  {
    Work work = recover(path).value();
    (void)work.add(small_scene(5.0), press_stroke(2)).value();
  }
  Work work = recover(path).value();
  EXPECT_EQ(work.size(), 3u);
  EXPECT_EQ(**work.pot(), plainly_thrown(work.record(), 2));
  work.journal()->discard();
  EXPECT_TRUE(recoverable(folder.path).empty());
}

/// Otherwise the lines after the recovery would follow an open stroke, which no reader accepts.
TEST(Journal, EndsTheStrokeThatWasInProgress) {
  const Folder folder;
  const auto path = journal_left(folder, [](Work& work) {
    test::record(press_stroke(1), *work.begin_stroke(small_scene()).value().sink);
  });
  (void)recover(path).value().add(small_scene(), press_stroke(2)).value();
  const Work work = recover(path).value();
  ASSERT_EQ(work.size(), 3u);
  EXPECT_EQ(work.record().nodes[1].poses, press_stroke(1));
  EXPECT_EQ(work.record().nodes[2].poses, press_stroke(2));
}

TEST(Journal, DoesNotOfferSavedOrEmptyWorks) {
  const Folder folder;
  { const Work nothing = kept_work(folder); }
  {
    Work work = kept_work(folder);
    (void)work.add(small_scene(), press_stroke(1)).value();
    ASSERT_TRUE(work.save(folder.scratch.file("mine.work")));
  }
  EXPECT_TRUE(recoverable(folder.path).empty());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path)) << "and is cleared away";
}

/// Files of programs that were killed while they created a journal.
TEST(Journal, RemovesAnUnfinishedJournalOfAnEndedProgram) {
  const Folder folder;
  std::filesystem::create_directories(folder.path);
  const auto unfinished = [&](const char* name, std::chrono::hours age) {
    const auto path = folder.path / name;
    std::ofstream(path) << "{";
    std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now() - age);
    return path;
  };
  const auto left = unfinished("20261121T230307-4711.new-abc123", std::chrono::hours(1));
  const auto fresh = unfinished("20261121T230307-4712.new-abc123", std::chrono::hours(0));
  const auto held = unfinished("20261121T230307-4713.new-abc123", std::chrono::hours(1));
  const auto other = unfinished("notes.txt", std::chrono::hours(1));
  const FileLock lock(held, FileLock::Kind::exclusive);
  ASSERT_TRUE(lock.held());
  EXPECT_TRUE(recoverable(folder.path).empty());
  EXPECT_FALSE(std::filesystem::exists(left));
  for (const auto& path : {fresh, held, other}) EXPECT_TRUE(std::filesystem::exists(path)) << path;
}

TEST(Journal, IsNotOfferedWhileItsProgramRuns) {
  const Folder folder;
  int ready[2], done[2];
  ASSERT_EQ(pipe(ready) + pipe(done), 0);
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    Work work = kept_work(folder);
    (void)work.add(small_scene(), press_stroke(1)).value();
    char byte = 0;
    (void)!write(ready[1], &byte, 1);
    (void)!read(done[0], &byte, 1);
    _exit(0);
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_TRUE(recoverable(folder.path).empty());
  const auto path = std::filesystem::directory_iterator(folder.path)->path();
  Work mine = kept_work(folder);
  for (const auto& refused : {recover(path).map([](Work&&) {}), discard(path)}) {
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::io);
    EXPECT_EQ(refused.error().message, path.string() + ": in use by a program that is running");
  }
  (void)!write(done[1], &byte, 1);
  waitpid(child, nullptr, 0);
  EXPECT_EQ(recoverable(folder.path).at(0).strokes, 1u);
  EXPECT_TRUE(discard(path));
  EXPECT_TRUE(recoverable(folder.path).empty());
  for (const int fd : {ready[0], ready[1], done[0], done[1]}) close(fd);
}

/// A work whose process is killed during a stroke: the time of accepted poses that is not recovered
/// [us].
void kill_one(double& lost_us) {
  const Folder folder;
  using Time = std::atomic<std::int64_t>;
  void* shared =
      mmap(nullptr, sizeof(Time), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  Time* taken_us = new (shared) Time(0);
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    Work work = kept_work(folder);
    (void)work.add(small_scene(), press_stroke(1)).value();
    PoseSink* sink = work.begin_stroke(small_scene(5.0)).value().sink;
    const auto recorder = servo::Recorder::create(*sink).value();
    const auto start = std::chrono::steady_clock::now();
    for (std::int64_t last_us = -1;;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const auto now_us = std::chrono::duration_cast<std::chrono::microseconds>(
                              std::chrono::steady_clock::now() - start)
                              .count();
      if (now_us <= last_us) continue;
      last_us = now_us;
      const double t = 1e-6 * static_cast<double>(now_us);
      if (recorder->take(quantized({now_us, {40.0 - 5.0 * t, 10.0 + t, 0.0}, false, 0.0}), true))
        taken_us->store(now_us);
    }
  }
  test::wait_until([&] { return taken_us->load() >= 700'000; }, test::kDeadline, "poses");
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  const auto all = recoverable(folder.path);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(all[0].running);
  EXPECT_EQ(all[0].strokes, 2u);
  Work work = recover(all[0].path).value();
  ASSERT_EQ(work.at(), 2u);
  // The stroke's time begins with its first pose.
  lost_us = static_cast<double>(taken_us->load()) - 1e6 * work.view(2).seconds;
  EXPECT_EQ(**work.pot(), plainly_thrown(work.record(), 2));
  (void)work.add(small_scene(), press_stroke(3)).value();
  munmap(shared, sizeof(Time));
}

/// See the recorder's test of the same name.
TEST(Journal, LosesAtMost100MsWhenKilledDuringAStroke) {
  double lost_us = 0.0;
  const auto loses_little = [&] {
    kill_one(lost_us);
    return lost_us <= 100'000.0 || HasFailure();
  };
  test::wait_until(loses_little, test::kDeadline, "a journal that loses no more than 100 ms");
}

TEST(Journal, AFullDiskDoesNotStopTheWork) {
  const Folder folder;
  Work work = kept_work(folder);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{2000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  for (std::uint64_t i = 0; i < 5; ++i) (void)work.add(small_scene(), press_stroke(i)).value();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(**work.pot(), plainly_thrown(work.record(), 5));
  ASSERT_TRUE(work.journal()->trouble());
  EXPECT_NE(work.journal()->trouble()->message.find(": could not write: "), std::string::npos);
}

TEST(Journal, RecoversEverythingBeforeADamagedLine) {
  const Folder folder;
  const auto path = journal_left(folder, [](Work& work) {
    (void)work.add(small_scene(), press_stroke(1)).value();
    (void)work.add(small_scene(), press_stroke(2)).value();
  });
  std::string text = test::read_text(path);
  const auto second = text.find("{\"node\":2");
  text.replace(text.find("\"x\":[", second), 6, "\"x\":[9");
  std::ofstream(path, std::ios::binary) << text;
  const auto all = recoverable(folder.path);
  ASSERT_EQ(all.size(), 1u);
  ASSERT_TRUE(all[0].damage);
  EXPECT_NE(all[0].damage->message.find("the line is damaged"), std::string::npos);
  Work work = recover(path).value();
  EXPECT_EQ(**work.pot(1), plainly_thrown(work.record(), 1));
  EXPECT_EQ(test::read_text(path.string() + ".damaged"), text);
}

/// The lines that cannot be read may be strokes after the save.
TEST(Journal, OffersASavedWorkIfItsJournalIsDamaged) {
  const Folder folder;
  const auto path = journal_left(folder, [&](Work& work) {
    (void)work.add(small_scene(), press_stroke(1)).value();
    ASSERT_TRUE(work.save(folder.scratch.file("saved.work")));
  });
  std::ofstream(path, std::ios::app) << "{ damaged\n";
  const auto all = recoverable(folder.path);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(all[0].damage);
  EXPECT_TRUE(std::filesystem::exists(path));
}

TEST(Journal, KeepsTheCopyOfAnEarlierDamage) {
  const Folder folder;
  const auto path = journal_left(folder, [](Work&) {});
  for (const char* damage : {"first", "second"}) {
    std::ofstream(path, std::ios::binary | std::ios::app) << damage << "\n";
    ASSERT_TRUE(recover(path));
  }
  EXPECT_TRUE(test::read_text(path.string() + ".damaged").ends_with("first\n"));
  EXPECT_TRUE(test::read_text(path.string() + ".damaged-2").ends_with("second\n"));
}

TEST(Journal, IsStoredInTheStateFolder) {
  setenv("XDG_STATE_HOME", "/var/state", 1);
  EXPECT_EQ(recovery_folder(), "/var/state/claystack/recovery");
  setenv("XDG_STATE_HOME", "relative", 1);
  setenv("HOME", "/potter", 1);
  EXPECT_EQ(recovery_folder(), "/potter/.local/state/claystack/recovery");
  unsetenv("XDG_STATE_HOME");
  EXPECT_EQ(recovery_folder(), "/potter/.local/state/claystack/recovery");
  const std::string home = getpwuid(getuid())->pw_dir;
  for (const char* none : {"", "relative"}) {
    setenv("HOME", none, 1);
    EXPECT_EQ(recovery_folder(), home + "/.local/state/claystack/recovery");
  }
  unsetenv("HOME");
  EXPECT_EQ(recovery_folder(), home + "/.local/state/claystack/recovery");
}

TEST(Journal, ReportsAMissingFolder) {
  const Work work = Work::begin(small_scene()).value();
  const auto journal = Journal::begin(work.record(), "");
  ASSERT_FALSE(journal);
  EXPECT_NE(journal.error().message.find("home folder"), std::string::npos);
}

TEST(Journal, ReportsAThreadThatDoesNotStart) {
  const Folder folder;
  const Work work = Work::begin(small_scene()).value();
  const auto left = journal_left(
      folder, [](Work& changed) { (void)changed.add(small_scene(), press_stroke(1)).value(); });
  const test::NoNewThreads none;
  const auto expect_reported = [](const auto& journal) {
    ASSERT_FALSE(journal);
    EXPECT_EQ(journal.error().kind, ErrorKind::io);
    EXPECT_TRUE(journal.error().message.starts_with("could not start the journal's thread: "))
        << journal.error().message;
  };
  expect_reported(Journal::begin(work.record(), folder.path));
  WorkReading found;
  expect_reported(Journal::take_over(left, found));
  std::size_t files = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path)) {
    EXPECT_EQ(file.path(), left) << "the journal from before alone is left";
    ++files;
  }
  EXPECT_EQ(files, 1u);
}

// Opening a pipe without a writer blocks without end.
TEST(Journal, SkipsAPipeInTheFolder) {
  const Folder folder;
  const auto journal = journal_left(
      folder, [](Work& work) { (void)work.add(small_scene(), press_stroke(1)).value(); });
  const std::filesystem::path pipe = folder.path / "pipe.work";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(test::status_of_child([&] {
              alarm(10);
              const auto all = recoverable(folder.path);
              return all.size() == 1 && all[0].path == journal && !discard(pipe) && !recover(pipe);
            }),
            0);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(Journal, WorksInAFolderThatCannotBeSynced) {
  const Folder folder;
  const Work work = Work::begin(small_scene()).value();
  EXPECT_EQ(test::status_of_child([&] {
              // The journal's file can be opened, but not its folder for syncing.
              if (!test::inject({SYS_openat, EIO, O_DIRECTORY})) return false;
              return Journal::begin(work.record(), folder.path).has_value();
            }),
            0);
}

TEST(Journal, ReportsAFolderThatCannotBeCreated) {
  const Work work = Work::begin(small_scene()).value();
  const auto journal = Journal::begin(work.record(), "/proc/no/such");
  ASSERT_FALSE(journal);
  EXPECT_EQ(journal.error().kind, ErrorKind::io);
  EXPECT_TRUE(recoverable("/no/such").empty());
}

}  // namespace
}  // namespace clay::history
