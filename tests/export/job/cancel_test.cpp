// A job that is cancelled at any check leaves no result.

#include "claystack/export/job.hpp"

#include "core/cancel.hpp"
#include "core/parallel_parts.hpp"
#include "export/solid/wall_curve.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <new>
#include <string>
#include <vector>

namespace clay::solid {
namespace {

using shapes::pot_of;

struct Job {
  Pot pot;
  ExportOptions options;
  std::vector<MeshFormat> formats;
};

/// The files, or the error.
Result<std::vector<std::string>> run(const Job& job) {
  std::vector<MemoryStore> stores(job.formats.size());
  std::vector<Output> outputs;
  for (std::size_t i = 0; i < stores.size(); ++i) outputs.push_back({job.formats[i], &stores[i]});
  return run_export(job.pot, outputs, job.options).map([&](const ExportReport&) {
    std::vector<std::string> files;
    for (const MemoryStore& store : stores) files.push_back(store.bytes());
    return files;
  });
}

/// Threads call `cancelled`, so the number of calls differs between runs. Near the end a job may
/// therefore finish: then its files are complete, to the byte.
void expect_cancelled_or_whole(Job job) {
  std::atomic<std::size_t> asked{0};
  job.options.cancelled = [&] { return ++asked == 0; };
  const auto whole = run(job);
  ASSERT_TRUE(whole) << whole.error().message;
  const std::size_t all = asked;
  ASSERT_GT(all, 8u);
  for (std::size_t until = 0; until <= all; until += 1 + until / 8) {
    asked = 0;
    job.options.cancelled = [&] { return ++asked > until; };
    const auto result = run(job);
    if (result) {
      EXPECT_GT(until, all / 2);
      EXPECT_EQ(*result, *whole);
    } else {
      EXPECT_EQ(result.error().kind, ErrorKind::io);
      EXPECT_EQ(result.error().message, "export stopped: cancelled") << until << " of " << all;
    }
  }
}

std::vector<MeshFormat> built_formats() {
  std::vector<MeshFormat> formats{MeshFormat::stl_binary, MeshFormat::stl_ascii, MeshFormat::obj};
#ifdef CLAYSTACK_DRACO
  formats.push_back(MeshFormat::drc);
#endif
  return formats;
}

TEST(Cancel, CancelsAStandingPotAtEveryCheck) {
  ExportOptions options;
  options.tolerance_mm = 0.3;
  options.wall_spacing_mm = 1.0;
  options.full_verification = true;
  for (const Smoothing smoothing : {Smoothing::none, Smoothing::fair, Smoothing::exact}) {
    options.smoothing = smoothing;
    expect_cancelled_or_whole({pot_of(shapes::vase(150)), options, built_formats()});
  }
}

TEST(Cancel, ExportNamesMissingMemory) {
  Job job{pot_of(shapes::vase(60)), {}, {MeshFormat::stl_binary}};
  job.options.cancelled = []() -> bool { throw std::bad_alloc(); };
  const auto result = run(job);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::io);
  EXPECT_EQ(result.error().message, "export stopped: not enough memory");
}

TEST(Cancel, CancelsAFallenPotAtEveryCheck) {
  Pot pot = pot_of(shapes::vase(60));
  pot.collapse = Collapse{20, {50, 70, 0}, {0, 0, 1}, 1.0, 12.0};
  ExportOptions options;
  options.tolerance_mm = 0.5;
  options.max_triangles = 6000;
  expect_cancelled_or_whole({pot, options, built_formats()});
}

/// A window that is closed waits for these stages.
TEST(Cancel, LongStagesCheckContinuously) {
  constexpr std::size_t kRings = 40'000;
  Job job{pot_of(shapes::vase(kRings)), {}, {MeshFormat::stl_binary, MeshFormat::obj}};
  std::string stage;
  std::map<std::string, std::size_t> asked;
  std::mutex mutex;
  job.options.tolerance_mm = 0.02;
  job.options.smoothing = Smoothing::fair;
  job.options.cancelled = [&] {
    const std::lock_guard lock(mutex);
    ++asked[stage];
    return false;
  };
  std::vector<MemoryStore> stores(2);
  const auto report =
      run_export(job.pot, {{job.formats[0], &stores[0]}, {job.formats[1], &stores[1]}}, job.options,
                 [&](std::string_view next) {
                   const std::lock_guard lock(mutex);
                   stage = next;
                 });
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_GE(asked["profile"], kRings / 1024);
  EXPECT_GE(asked["smooth"], 4 * kRings / 1024);
  for (const char* each :
       {"tessellate", "encode_stl_binary", "verify_stl_binary", "encode_obj", "verify_obj"})
    EXPECT_GE(asked[each], report->size.triangles / (2 * 1024)) << each;
}

TEST(Cancel, EncodersCheckContinuously) {
  const TriangleMesh mesh =
      revolve({{{{0, 0}, {30, 0}, {30, 20}, {28, 20}, {28, 2}, {0, 2}}}}, 20'000);
  std::atomic<std::size_t> asked{0};
  const CancelScope::Question question = [&] {
    ++asked;
    return false;
  };
  const CancelScope scope(&question);
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::stl_ascii, MeshFormat::glb}) {
    asked = 0;
    ASSERT_TRUE(encode_mesh(mesh, format, {.glb = GlbMesh::core}));
    EXPECT_GE(asked, mesh.triangles.size() / 1024) << name_of(format);
  }
}

TEST(Cancel, EachFitOfACurveChecks) {
  Polygon line;
  for (int i = 0; i <= 200; ++i) line.push_back({30.0 + 5.0 * std::sin(0.1 * i), 0.5 * i});
  std::size_t asked = 0;
  const CancelScope::Question question = [&] {
    ++asked;
    return false;
  };
  const CancelScope scope(&question);
  const WallCurve curve = fitted(line, 1e-3);
  EXPECT_GE(asked, curve.spans());
}

TEST(Cancel, NoStageBeginsAfterCancellation) {
  const Pot pot = pot_of(shapes::vase(200));
  std::atomic<bool> given_up{false};
  ExportOptions options;
  options.cancelled = [&] { return given_up.load(); };
  MemoryStore store;
  std::size_t stages = 0;
  const auto cancelled =
      run_export(pot, {{MeshFormat::stl_binary, &store}}, options, [&](std::string_view stage) {
        ++stages;
        if (stage == "certificate") given_up = true;
        EXPECT_NE(stage, "encode_stl_binary");
      });
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().kind, ErrorKind::io);
  EXPECT_GT(stages, 1u);
  EXPECT_TRUE(store.bytes().empty());
  const auto never =
      run_export(pot, {}, options, [](std::string_view) { FAIL() << "nothing begins"; });
  EXPECT_FALSE(never);
}

TEST(Cancel, HelperThreadsCheckToo) {
  std::atomic<bool> given_up{false};
  const CancelScope::Question question = [&] { return given_up.load(); };
  const CancelScope scope(&question);
  std::atomic<std::size_t> begun{0};
  const auto all = [&] {
    for_each_part(64, [&](std::size_t) {
      if (++begun == 8) given_up = true;
      stop_if_cancelled();
    });
  };
  EXPECT_THROW(all(), Cancelled);
  {
    const CancelScope other(nullptr);
    EXPECT_NO_THROW(stop_if_cancelled()) << "what is worked on in between is another's";
  }
  EXPECT_THROW(stop_if_cancelled(), Cancelled);
}

}  // namespace
}  // namespace clay::solid
