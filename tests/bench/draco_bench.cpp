// Draco's speeds on the sample pots: bytes, encoding and decoding time. The default of
// DracoSettings::speed gives the smallest files of this table.

#include "claystack/export/job.hpp"
#include "tests/export/job/sample_pots.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace clay;
using namespace clay::solid;

constexpr double kToleranceMm = 0.01;
constexpr std::size_t kRounds = 5;
constexpr std::size_t kSpeeds = 11;

using Times = std::array<double, kRounds>;  ///< [ms], of one kind of work

double median(Times times) {
  std::sort(times.begin(), times.end());
  return times[kRounds / 2];
}

template <class Work>
double milliseconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

double stage_ms(const ExportReport& report, std::string_view name) {
  const auto stage = std::find_if(report.stages.begin(), report.stages.end(),
                                  [&](const StageTime& time) { return time.name == name; });
  return stage == report.stages.end() ? 0.0 : 1000.0 * stage->seconds;
}

/// The whole job of `claystack export`, except the disk.
struct Job {
  MemoryStore stl, drc;
  double stl_ms = 0.0, drc_ms = 0.0;
};

Result<Job> run_job(const Pot& pot) {
  Job job;
  ExportOptions options;
  options.tolerance_mm = kToleranceMm;
  return run_export(pot, {{MeshFormat::stl_binary, &job.stl}, {MeshFormat::drc, &job.drc}}, options)
      .map([&](const ExportReport& report) {
        job.stl_ms = stage_ms(report, "encode_stl_binary");
        job.drc_ms = stage_ms(report, "encode_drc") + stage_ms(report, "store_drc");
        return std::move(job);
      });
}

struct SpeedRow {
  std::string bytes;
  Times encode_ms{}, decode_ms{};
};

/// Round by round instead of speed by speed, so that other load affects all equally.
Result<std::array<SpeedRow, kSpeeds>> try_speeds(const TriangleMesh& mesh) {
  std::array<SpeedRow, kSpeeds> rows;
  for (std::size_t round = 0; round < kRounds; ++round)
    for (std::size_t speed = 0; speed < kSpeeds; ++speed) {
      SpeedRow& row = rows[speed];
      const DracoSettings settings{.max_error_mm = kToleranceMm, .speed = static_cast<int>(speed)};
      Result<void> done;
      row.encode_ms[round] = milliseconds([&] {
        done = encode_drc(mesh, settings).map([&](std::string bytes) {
          row.bytes = std::move(bytes);
        });
      });
      row.decode_ms[round] = milliseconds([&] {
        done = done.and_then([&] { return decode_drc(row.bytes, "speed"); })
                   .map([](const TriangleMesh&) {});
      });
      if (!done) return tl::make_unexpected(done.error());
    }
  return rows;
}

Result<void> measure(const std::string& sample) {
  return samples::thrown_pot(sample).and_then([&](const Pot& pot) -> Result<void> {
    Times stl_ms{}, drc_ms{};
    Job job;
    for (std::size_t round = 0; round < kRounds; ++round) {
      auto run = run_job(pot);
      if (!run) return tl::make_unexpected(run.error());
      job = std::move(*run);
      stl_ms[round] = job.stl_ms;
      drc_ms[round] = job.drc_ms;
    }
    const auto stl_bytes = static_cast<double>(job.stl.bytes().size());
    std::printf("%s: STL %.0f bytes in %.1f ms; exported DRC %zu bytes (%.2f %%) in %.1f ms\n",
                sample.c_str(), stl_bytes, median(stl_ms), job.drc.bytes().size(),
                100.0 * static_cast<double>(job.drc.bytes().size()) / stl_bytes, median(drc_ms));
    const auto rows = decode_stl(job.stl.bytes(), sample).and_then(try_speeds);
    if (!rows) return tl::make_unexpected(rows.error());
    std::puts("  speed    bytes  of STL  encode ms  decode ms");
    for (std::size_t speed = 0; speed < kSpeeds; ++speed) {
      const SpeedRow& row = (*rows)[speed];
      std::printf("  %5zu %8zu %5.2f %% %10.1f %10.1f\n", speed, row.bytes.size(),
                  100.0 * static_cast<double>(row.bytes.size()) / stl_bytes, median(row.encode_ms),
                  median(row.decode_ms));
    }
    return {};
  });
}

}  // namespace

int main() {
  std::printf("Tolerance %.2f mm, medians of %zu rounds\n", kToleranceMm, kRounds);
  for (const char* const sample : samples::kStandingPots) {
    if (const auto done = measure(sample); !done) {
      std::fprintf(stderr, "draco_bench: %s\n", done.error().message.c_str());
      return 2;
    }
  }
  return 0;
}
