#pragma once
// Writes a picture or a turntable of the pot on a separate thread: the drawing of `claystack
// render`, so that the same choices give the same bytes.

#include "app/history/work.hpp"
#include "app/render/pot_picture.hpp"
#include "core/worker.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace clay::studio {

/// The settings of the dialog for pictures.
struct PictureFile {
  render::PictureChoices look;
  bool turntable = false;
  bool wall_map = false;
  std::string process;  ///< of the wall map, as for --process; empty: none
  std::string folder, name;
  friend bool operator==(const PictureFile&, const PictureFile&) = default;
};
/// NAME.png, or NAME.gif for a turntable, in the folder.
[[nodiscard]] std::string path_of(const PictureFile& file);

class PictureWriter {
 public:
  struct Outcome {
    PictureFile file;
    Result<std::uint64_t> bytes;  ///< the size of the file
    bool cancelled = false;
  };

  /// False where this program has no renderer without a window: in a web page.
  [[nodiscard]] static bool available() noexcept;

  /// Without `thread`, a picture is written during the call of `write`.
  explicit PictureWriter(bool thread);
  /// Only when it is not busy. Replaces the file.
  void write(history::SharedPot pot, const PictureFile& file);
  /// Before the next frame of a turntable; no file remains.
  void cancel();
  /// True until the outcome has been taken.
  [[nodiscard]] bool busy() const { return worker_.busy(); }
  /// The part that is done, 0 to 1.
  [[nodiscard]] float progress() const;
  [[nodiscard]] std::optional<Outcome> take() { return worker_.take(); }

 private:
  /// Shared by the window and the thread.
  struct Ticket {
    std::atomic<bool> cancelled = false;
    std::atomic<std::size_t> done = 0, of = 1;
  };
  struct Job {
    history::SharedPot pot;
    PictureFile file;
    std::shared_ptr<Ticket> ticket;
  };
  static Outcome done(const Job& job, const std::function<bool()>& given_up);

  std::shared_ptr<Ticket> ticket_;
  NewestWorker<Job, Outcome> worker_;
};

}  // namespace clay::studio
