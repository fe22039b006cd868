#include "app/studio/picture_writer.hpp"

#ifdef CLAYSTACK_WINDOW
#include "app/cli/memory_room.hpp"
#include "app/render/wall_rows.hpp"
#include "claystack/core/atomic_file.hpp"
#endif

#include <filesystem>
#include <future>
#include <utility>

namespace clay::studio {
namespace {

#ifdef CLAYSTACK_WINDOW
Result<render::Picture> picture_of(const Pot& pot, const PictureFile& file) {
  render::Picture picture = render::picture_of(pot, file.look);
  if (!file.wall_map) return picture;
  solid::WallDemand demand;
  if (!file.process.empty()) {
    auto process = solid::read_process(file.process);
    if (!process) return tl::make_unexpected(process.error());
    demand.process = std::move(*process);
  }
  return render::show_walls(pot, demand, picture).map([&](const render::MappedWalls&) {
    return std::move(picture);
  });
}

Result<std::uint64_t> write_frames(render::Offscreen& screen, const render::Picture& picture,
                                   const PictureFile& file, const render::TurnProgress& progress,
                                   AtomicFile& out) {
  if (file.turntable)
    return render::write_turntable(screen, picture, file.look, progress,
                                   [&](std::string_view bytes) { return out.write(bytes); });
  return progress(0, 1)
      .and_then([&] { return render::drawn(screen, picture, file.look.size); })
      .map(render::png_of)
      .and_then([&](const std::string& png) {
        return out.write(png).map([&] { return std::uint64_t{png.size()}; });
      });
}

Result<std::uint64_t> draw_and_write(const Pot& pot, const PictureFile& file,
                                     const render::TurnProgress& progress) {
  const auto picture = picture_of(pot, file);
  if (!picture) return tl::make_unexpected(picture.error());
  const render::Viewport size = file.look.size;
  auto screen = cli::expect_room_to_draw(static_cast<std::uint64_t>(size.width_px) *
                                         static_cast<std::uint64_t>(size.height_px))
                    .and_then([] { return render::Offscreen::create(); });
  if (!screen) return tl::make_unexpected(screen.error());
  auto out = AtomicFile::create(path_of(file));
  if (!out) return tl::make_unexpected(out.error());
  return write_frames(*screen, *picture, file, progress, *out).and_then([&](std::uint64_t bytes) {
    return out->commit().map([&] { return bytes; });
  });
}

/// On another thread than the caller's, whose OpenGL context has to stay current: that of the
/// window.
Result<std::uint64_t> write_picture(const Pot& pot, const PictureFile& file,
                                    const render::TurnProgress& progress) {
  return std::async(std::launch::async, [&] { return draw_and_write(pot, file, progress); }).get();
}
#else
Result<std::uint64_t> write_picture(const Pot&, const PictureFile& file,
                                    const render::TurnProgress&) {
  return failure(ErrorKind::device, path_of(file) + ": this program cannot draw without a window");
}
#endif

}  // namespace

std::string path_of(const PictureFile& file) {
  return (std::filesystem::path(file.folder) / (file.name + (file.turntable ? ".gif" : ".png")))
      .string();
}

bool PictureWriter::available() noexcept {
#ifdef CLAYSTACK_WINDOW
  return true;
#else
  return false;
#endif
}

PictureWriter::PictureWriter(bool thread) : worker_(&PictureWriter::done, thread) {}

void PictureWriter::write(history::SharedPot pot, const PictureFile& file) {
  ticket_ = std::make_shared<Ticket>();
  worker_.ask({std::move(pot), file, ticket_});
}

void PictureWriter::cancel() {
  if (ticket_) ticket_->cancelled = true;
}

float PictureWriter::progress() const {
  if (!ticket_) return 0.0f;
  return static_cast<float>(ticket_->done) / static_cast<float>(ticket_->of);
}

PictureWriter::Outcome PictureWriter::done(const Job& job, const std::function<bool()>& given_up) {
  const auto progress = [&](std::size_t done, std::size_t of) -> Result<void> {
    if (job.ticket->cancelled || given_up()) return failure(ErrorKind::io, "cancelled");
    job.ticket->done = done;
    job.ticket->of = of;
    return {};
  };
  auto bytes = write_picture(*job.pot, job.file, progress);
  const bool cancelled = !bytes && job.ticket->cancelled;
  return {job.file, std::move(bytes), cancelled};
}

}  // namespace clay::studio
