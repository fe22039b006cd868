#pragma once
// Exports the pot from the window: the same job as `claystack export`, on a separate thread.

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

inline constexpr double kFinestMm = 0.001, kCoarsestMm = 1.0;  // tolerance [mm]
inline constexpr double kThickestDemandMm = 20.0;

/// The settings of the export dialog.
struct ExportChoices {
  std::vector<solid::MeshFormat> meshes = {solid::MeshFormat::three_mf};
  bool section = false, pot = false;
  std::string folder, name;
  double tolerance_mm = 0.02;
  solid::Smoothing smoothing = solid::Smoothing::fair;
  std::string process;       ///< as for --process; empty: none
  double min_wall_mm = 0.0;  ///< 0: the limit of the process, if there is one
  double shrinkage_percent = 0.0;
  friend bool operator==(const ExportChoices&, const ExportChoices&) = default;
};

/// The request for this pot. Errors: an unknown or unreadable process.
[[nodiscard]] Result<solid::ExportRequest> request_of(const ExportChoices& choices, const Pot& pot);
/// Paths of the output files, in the order of the request.
[[nodiscard]] std::vector<std::string> paths_of(const ExportChoices& choices);
/// Those of the output files that exist already.
[[nodiscard]] std::vector<std::string> standing_files(const ExportChoices& choices);

class Exporter {
 public:
  enum class Kind { preview, files };
  struct Outcome {
    Kind kind = Kind::preview;
    history::SharedPot pot;
    ExportChoices choices;
    Result<solid::ExportReport> done;
    bool cancelled = false;
    std::vector<std::string> paths;  ///< output files, in the order of the request
  };

  Exporter();
  ~Exporter();
  Exporter(const Exporter&) = delete;
  Exporter& operator=(const Exporter&) = delete;

  /// Computes the figures without writing. A newer preview cancels an older one.
  void preview(history::SharedPot pot, const ExportChoices& choices);
  void write(history::SharedPot pot, const ExportChoices& choices);
  /// Cancels soon after the call; no output file remains.
  void cancel();

  [[nodiscard]] bool busy() const;
  /// Stage of the running job; empty: no job.
  [[nodiscard]] std::string stage() const;
  [[nodiscard]] std::optional<Kind> running() const;
  /// The newest outcome; returned once.
  [[nodiscard]] std::optional<Outcome> take();
  void wait();  ///< blocks until no job runs

 private:
  struct Job {
    Kind kind;
    history::SharedPot pot;
    ExportChoices choices;
    std::stop_source stop;
  };
  void put(Job job);
  void run();
  Outcome done(const Job& job);

  mutable std::mutex mutex_;  // protects the members below
  std::condition_variable wake_, idle_;
  std::optional<Job> next_;
  std::optional<Kind> running_;
  std::stop_source stop_{std::nostopstate};  // stops the running job
  std::string stage_;
  std::optional<Outcome> outcome_;
  bool closing_ = false;
  // Used by the thread alone: the picture of a pot serves all its previews.
  history::SharedPot pictured_;
  std::optional<std::string> thumbnail_;
  std::thread thread_;
};

}  // namespace clay::studio
