#include "app/cli/render_job.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/pot_input.hpp"

#include "app/render/image_file.hpp"
#include "app/render/legend.hpp"
#include "app/render/offscreen.hpp"
#include "app/render/pot_view.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/tick.hpp"
#ifdef CLAYSTACK_EXPORT
#include "app/render/wall_rows.hpp"
#include "claystack/export/walls.hpp"
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>
#include <utility>

namespace clay::cli {
namespace {

constexpr double kMapTopMm = 10.0;
constexpr int kTurnMs = 3000;  // one turn of the turntable
constexpr std::size_t kTimedFrames = 15;

Result<void> check_usage(const RenderCommand& command, const Console& console) {
  if (command.out.empty() && command.turntable.empty() && !command.time)
    return failure(ErrorKind::bad_input,
                   "expected -o FILE.png, --turntable FILE.gif or --time, found none");
  const int streams = (command.out == "-") + (command.turntable == "-") + console.json;
  if (streams > 1)
    return failure(ErrorKind::bad_input, "-: expected at most one output on standard output");
  std::vector<std::string> inputs = {command.pot};
#ifdef CLAYSTACK_EXPORT
  inputs.push_back(command.walls.process());
#endif
  return check_outputs({{command.out, {".png"}}, {command.turntable, {".gif"}}}, inputs, console);
}

/// The pot, or the lump of a scene.
Result<Pot> clay_of(const std::string& path) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::make_unexpected(bytes.error());
  if (!path.ends_with(".scene.json")) return pot_from(*bytes, path);
  return parse_scene(*bytes, path).and_then([](const SceneSpec& scene) {
    const LumpSpec& lump = scene.lump;
    return ClayStack::cylinder(lump.rings, lump.ring_height_mm, lump.outer_radius_mm,
                               lump.inner_radius_mm, max_rings_of(lump))
        .map([&](ClayStack stack) {
          return Pot{std::move(stack), {}, scene.model, lump.density_g_cm3, {}, {}};
        });
  });
}

#ifdef CLAYSTACK_EXPORT
Result<void> map_walls(const RenderCommand& command, const Pot& pot, render::Picture& picture,
                       Rendered& done) {
  return render::map_walls(pot, command.walls.demand(), picture.pot.rows.size())
      .map([&](render::MappedWalls walls) {
        picture.pot.wall_mm = std::move(walls.rows);
        const double limit_mm = walls.limit ? walls.limit->min_wall_mm : 0.0;
        picture.wall_map = done.map = render::WallMap{limit_mm, kMapTopMm};
        done.thinnest_mm = walls.min_wall_mm;
      });
}
#endif

Result<render::Picture> picture_of(const RenderCommand& command, Rendered& done) {
  const auto pot = clay_of(command.pot);
  if (!pot) return tl::make_unexpected(pot.error());
  render::Picture picture;
  picture.pot = render::view_of(*pot);
  picture.theme = command.dark ? render::Theme::dark : render::Theme::light;
  picture.style = command.style;
  picture.cut = command.section ? render::Cut::half : render::Cut::none;
  picture.camera = render::framed(picture.pot, command.size.aspect());
  if (command.azimuth_deg) picture.camera.azimuth_rad = glm::radians(*command.azimuth_deg);
  if (command.elevation_deg) picture.camera.elevation_rad = glm::radians(*command.elevation_deg);
  picture.camera = render::framed(picture.pot, command.size.aspect(), picture.camera);
#ifdef CLAYSTACK_EXPORT
  if (command.wall_map)
    if (auto mapped = map_walls(command, *pot, picture, done); !mapped)
      return tl::make_unexpected(mapped.error());
#else
  (void)done;
#endif
  return picture;
}

Result<render::Image> drawn(render::Offscreen& screen, const render::Picture& picture,
                            render::Viewport size) {
  return screen.draw(picture, size).map([&](render::Image image) {
    if (picture.wall_map) render::draw_legend(*picture.wall_map, picture.theme, image);
    return image;
  });
}

/// Streams the frames into `file`, which the caller commits. Returns the number of bytes.
Result<std::uint64_t> turn(render::Offscreen& screen, render::Picture picture,
                           const RenderCommand& command, const Console& console, AtomicFile& file) {
  const auto frames = static_cast<std::size_t>(command.frames);
  Progress progress(console, "turning", 2 * frames);  // each frame is drawn twice
  std::size_t done = 0;
  picture.cut_azimuth_rad = picture.camera.azimuth_rad;  // rotates with the pot
  const double step = 2.0 * std::numbers::pi / command.frames;
  const double first = picture.camera.azimuth_rad;
  const auto frame_at = [&](std::size_t k) {
    progress.update(done++);
    picture.camera.azimuth_rad = first - step * static_cast<double>(k);
    return drawn(screen, picture, command.size);
  };
  return render::write_gif(frames, std::max(20, kTurnMs / command.frames), frame_at,
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
  return drawn(screen, picture, command.size).map(render::png_of);
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
  const auto plain = median_ms(screen, picture, command.size, 0);
  const auto smooth = median_ms(screen, picture, command.size, render::kSamples);
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
  const auto picture = picture_of(command, done);
  if (!picture) return tl::make_unexpected(picture.error());
  auto screen = expect_room_to_draw(static_cast<std::uint64_t>(command.size.width_px) *
                                    static_cast<std::uint64_t>(command.size.height_px))
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
