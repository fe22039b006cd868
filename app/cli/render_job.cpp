#include "app/cli/render_job.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/pot_input.hpp"
#include "app/cli/usage.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/files.hpp"
#include "core/text.hpp"
#ifdef CLAYSTACK_EXPORT
#include "app/render/wall_rows.hpp"
#include "claystack/export/walls.hpp"
#endif

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace clay::cli {
namespace {

constexpr std::size_t kTimedFrames = 15;

Result<void> check_usage(const RenderCommand& command, const Console& console) {
  if (command.out.empty() && command.turntable.empty() && !command.time)
    return failure(ErrorKind::bad_input,
                   "expected -o FILE.png, --turntable FILE.gif or --time, found none");
  if (command.frames_asked && command.turntable.empty())
    return tl::make_unexpected(no_effect_without("--frames", "--turntable"));
  if (command.choices.alone && !command.turntable.empty())
    return failure(ErrorKind::bad_input,
                   "--transparent: expected a picture (-o FILE.png), found --turntable: a GIF here "
                   "has a background");
  if (ends_ignoring_case(command.out, ".gif"))
    return failure(ErrorKind::bad_input, "-o: expected a picture (.png), found " + command.out +
                                             "; --turntable FILE.gif makes an animation");
  std::vector<std::string> inputs = {command.pot};
#ifdef CLAYSTACK_EXPORT
  inputs.push_back(command.walls.process());
#endif
  return check_outputs({{command.out, {".png"}}, {command.turntable, {".gif"}}}, inputs, console);
}

/// The pot, or the lump of a scene.
Result<Pot> clay_of(const std::string& path, const Console& console) {
  if (!ends_ignoring_case(path, ".scene.json")) return read_pot(path, console);
  const auto bytes = read_file(path);
  if (!bytes) return tl::make_unexpected(bytes.error());
  return parse_scene(*bytes, path).and_then([](const SceneSpec& scene) {
    const LumpSpec& lump = scene.lump;
    return ClayStack::cylinder(lump.rings, lump.ring_height_mm, lump.outer_radius_mm,
                               lump.inner_radius_mm, lump.rings)
        .map([&](ClayStack stack) {
          return Pot{std::move(stack), {}, scene.model, lump.density_g_cm3, {}, {}};
        });
  });
}

Result<render::Picture> picture_of(const RenderCommand& command, const Console& console,
                                   Rendered& done) {
  const auto pot = clay_of(command.pot, console);
  if (!pot) return tl::make_unexpected(pot.error());
  render::Picture picture = render::picture_of(*pot, command.choices);
#ifdef CLAYSTACK_EXPORT
  if (command.wall_map) {
    const auto walls = render::show_walls(*pot, command.walls.demand(), picture);
    if (!walls) return tl::make_unexpected(walls.error());
    done.map = picture.wall_map;
    done.thinnest_mm = walls->min_wall_mm;
  }
#else
  (void)done;
#endif
  return picture;
}

/// Streams the frames into `file`, which the caller commits. Returns the number of bytes.
Result<std::uint64_t> turn(render::Offscreen& screen, const render::Picture& picture,
                           const RenderCommand& command, const Console& console, AtomicFile& file) {
  Progress progress(console, "turning", render::drawings_of_turn(command.choices.frames));
  render::PictureChoices choices = command.choices;
  choices.size = command.turntable_size;
  return render::write_turntable(
      screen, picture, choices,
      [&](std::size_t done, std::size_t) -> Result<void> {
        progress.update(done);
        return {};
      },
      [&](std::string_view bytes) { return file.write(bytes); });
}

Result<double> median_ms(render::Offscreen& screen, const render::Picture& picture,
                         render::Viewport size, int samples) {
  std::array<double, kTimedFrames> times{};
  if (auto warm = screen.time_ms(picture, size, samples); !warm) return warm;
  for (double& time : times) {
    const auto took = screen.time_ms(picture, size, samples);
    if (!took) return took;
    time = *took;
  }
  std::nth_element(times.begin(), times.begin() + kTimedFrames / 2, times.end());
  return times[kTimedFrames / 2];
}

/// Empty if no picture is wanted.
Result<std::string> made_png(render::Offscreen& screen, const render::Picture& picture,
                             const RenderCommand& command) {
  if (command.out.empty()) return std::string();
  return render::drawn(screen, picture, command.choices.size).map(render::png_of);
}

/// Written and not yet published; empty if no turntable is wanted.
Result<std::optional<AtomicFile>> made_gif(render::Offscreen& screen,
                                           const render::Picture& picture,
                                           const RenderCommand& command, const Console& console,
                                           Rendered& done) {
  if (command.turntable.empty()) return std::nullopt;
  auto file = AtomicFile::create(command.turntable);
  if (!file) return tl::make_unexpected(file.error());
  const auto turned = turn(screen, picture, command, console, *file);
  if (!turned) return tl::make_unexpected(turned.error());
  done.gif_bytes = *turned;
  return std::move(*file);
}

Result<FrameTime> frame_time(render::Offscreen& screen, const render::Picture& picture,
                             const RenderCommand& command) {
  const auto plain = median_ms(screen, picture, command.choices.size, 0);
  const auto smooth = median_ms(screen, picture, command.choices.size, render::kSamples);
  if (!plain || !smooth) return tl::make_unexpected((plain ? smooth : plain).error());
  return FrameTime{*plain, *smooth};
}

/// Publishes both files, or none.
Result<void> publish_images(const std::string& path, const std::string& png,
                            std::optional<AtomicFile>& gif) {
  std::vector<AtomicFile*> files;
  std::optional<AtomicFile> out;
  if (!path.empty()) {
    auto created = AtomicFile::create(path);
    if (!created) return tl::make_unexpected(created.error());
    if (auto written = created->write(png); !written) return written;
    files.push_back(&out.emplace(std::move(*created)));
  }
  if (gif) files.push_back(&*gif);
  return commit_all(files);
}

}  // namespace

Result<Rendered> render(const RenderCommand& command, const Console& console) {
  if (auto usage = check_usage(command, console); !usage) return tl::make_unexpected(usage.error());
  Progress progress(console, "rendering", 0);
  progress.stage(command.wall_map ? "reading, measuring walls" : "reading");
  Rendered done;
  const auto picture = picture_of(command, console, done);
  if (!picture) return tl::make_unexpected(picture.error());
  auto screen = expect_room_to_draw(static_cast<std::uint64_t>(command.choices.size.width_px) *
                                    static_cast<std::uint64_t>(command.choices.size.height_px))
                    .and_then([] { return render::Offscreen::create(); });
  if (!screen) return tl::make_unexpected(screen.error());
  done.renderer = screen->renderer();
  progress.stage("drawing");
  // Picture and animation are both made before either is published.
  const auto png = made_png(*screen, *picture, command);
  if (!png) return tl::make_unexpected(png.error());
  done.png_bytes = png->size();
  auto gif = made_gif(*screen, *picture, command, console, done);
  if (!gif) return tl::make_unexpected(gif.error());
  if (command.time) {
    progress.stage("timing frames");
    const auto time = frame_time(*screen, *picture, command);
    if (!time) return tl::make_unexpected(time.error());
    done.frame = *time;
  }
  return publish_images(command.out, *png, *gif).map([&] { return done; });
}

}  // namespace clay::cli
