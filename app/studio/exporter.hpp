#pragma once
// Exports the pot from the window: the same job as `claystack export`, on a separate thread or in
// the worker of a web page.

#include "app/history/work.hpp"
#include "app/studio/export_choices.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::studio {

class Exporter {
 public:
  using Kind = ExportKind;
  struct Outcome {
    Kind kind = Kind::preview;
    history::SharedPot pot;
    ExportChoices choices;
    Result<ExportFigures> done;
    bool cancelled = false;
    std::vector<std::string> paths;  ///< output files, in the order of the request

    static Outcome of_cancelled(Kind kind, history::SharedPot pot, const ExportChoices& choices) {
      return {kind, std::move(pot),   choices, failure(ErrorKind::io, "cancelled"),
              true, paths_of(choices)};
    }
  };

  Exporter();
  ~Exporter();
  Exporter(const Exporter&) = delete;
  Exporter& operator=(const Exporter&) = delete;

  /// Computes the figures without writing. A newer preview cancels an older one. Does nothing while
  /// files are `running`.
  void preview(history::SharedPot pot, const ExportChoices& choices);
  void write(history::SharedPot pot, const ExportChoices& choices);
  /// Cancels soon after the call; no output file remains.
  void cancel();

  [[nodiscard]] bool busy() const;
  /// Stage of the running job; empty: no job.
  [[nodiscard]] std::string stage() const;
  /// Of the job that runs or waits, or of files whose outcome has not been taken; files go first.
  [[nodiscard]] std::optional<Kind> running() const;
  /// The newest outcome; returned once.
  [[nodiscard]] std::optional<Outcome> take();
  void wait();  ///< blocks until no job runs

 private:
  /// Files that run, wait or were not taken; else a preview that runs or waits.
  static std::optional<Kind> at_work(std::optional<Kind> running, std::optional<Kind> waiting,
                                     std::optional<Kind> done) {
    if (running == Kind::files || waiting == Kind::files || done == Kind::files) return Kind::files;
    return running ? running : waiting;
  }

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace clay::studio
