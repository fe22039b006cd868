#pragma once
// The pot to files from the window: the job of `claystack export`, on a thread of its own.

#include "app/history/work.hpp"
#include "claystack/export/job.hpp"

#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace clay::studio {

inline constexpr double kFinestMm = 0.001, kCoarsestMm = 1.0;  // tolerance
inline constexpr double kThickestDemandMm = 20.0;

/// What is chosen in the card.
struct ExportWish {
  bool stl = true, obj = false, drc = false, section = false, pot = false;
  std::string folder, name;
  double tolerance_mm = 0.02;
  solid::Smoothing smoothing = solid::Smoothing::fair;
  std::string process;       ///< as --process; empty: none
  double min_wall_mm = 0.0;  ///< 0: none but the process's
  double shrinkage_percent = 0.0;
  friend bool operator==(const ExportWish&, const ExportWish&) = default;
};

/// For this pot. Errors: a process that is not known or cannot be read.
[[nodiscard]] Result<solid::ExportRequest> request_of(const ExportWish& wish, const Pot& pot);
/// In the order of the request.
[[nodiscard]] std::vector<std::string> paths_of(const ExportWish& wish);
/// Those of them that are there already.
[[nodiscard]] std::vector<std::string> standing_files(const ExportWish& wish);

class Exporter {
 public:
  enum class Kind { rehearsal, files };
  struct Outcome {
    Kind kind = Kind::rehearsal;
    history::SharedPot pot;
    ExportWish wish;
    Result<solid::ExportReport> done;
    bool cancelled = false;
    std::vector<std::string> paths;  ///< of the files, in the order of the request
  };

  Exporter();
  ~Exporter();
  Exporter(const Exporter&) = delete;
  Exporter& operator=(const Exporter&) = delete;

  /// The newest wins: a rehearsal that runs or waits is given up for it.
  void rehearse(history::SharedPot pot, const ExportWish& wish);
  void write(history::SharedPot pot, const ExportWish& wish);
  /// In a moment; no file is left.
  void cancel();

  [[nodiscard]] bool busy() const;
  /// That runs now; empty: none.
  [[nodiscard]] std::string stage() const;
  [[nodiscard]] std::optional<Kind> running() const;
  /// The newest outcome, once.
  [[nodiscard]] std::optional<Outcome> take();
  void wait();  ///< until nothing runs

 private:
  struct Job {
    Kind kind;
    history::SharedPot pot;
    ExportWish wish;
    std::stop_source stop;
  };
  void put(Job job);
  void run();
  Outcome done(const Job& job);

  mutable std::mutex mutex_;  // of what follows
  std::condition_variable wake_, idle_;
  std::optional<Job> next_;
  std::optional<Kind> running_;
  std::stop_source stop_{std::nostopstate};  // of what runs
  std::string stage_;
  std::optional<Outcome> outcome_;
  bool closing_ = false;
  std::thread thread_;
};

}  // namespace clay::studio
