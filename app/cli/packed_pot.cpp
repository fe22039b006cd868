#include "app/cli/packed_pot.hpp"

#include "app/cli/memory_room.hpp"
#include "claystack/engine/files.hpp"
#include "core/threads.hpp"
#ifdef CLAYSTACK_THUMBNAIL
#include "app/render/image_file.hpp"
#include "app/render/pot_view.hpp"
#include "app/render/thumbnail.hpp"
#endif
#ifdef CLAYSTACK_WINDOW
#include "app/render/offscreen.hpp"
#endif

#include <algorithm>

namespace clay::cli {
namespace {

/// PNG; empty without a renderer, or memory for it.
std::string png_of([[maybe_unused]] const Pot& pot, [[maybe_unused]] int pixels) {
#ifdef CLAYSTACK_WINDOW
  const render::Viewport size{pixels, pixels};
  render::Picture picture;
  picture.pot = render::view_of(pot);
  picture.style = render::Style::geometry;
  picture.camera = render::framed(picture.pot, size.aspect());
  return expect_room_to_draw(static_cast<std::uint64_t>(pixels) *
                             static_cast<std::uint64_t>(pixels))
      .and_then([] { return render::Offscreen::create(); })
      .and_then([&](render::Offscreen screen) { return screen.draw(picture, size); })
      .map(render::png_of)
      .value_or(std::string());
#else
  return {};
#endif
}

}  // namespace

std::string picture_of(const Pot& pot) { return png_of(pot, 480); }

void pack_pot(const Pot& pot, solid::ExportRequest& request,
              [[maybe_unused]] Thumbnail& thumbnail) {
  const bool wanted = std::ranges::any_of(request.files, [](const solid::FileRequest& file) {
    return file.kind == solid::FileKind::mesh && file.format == solid::MeshFormat::three_mf;
  });
  if (!wanted) return;
  request.options.pot_file = write_pot(pot, PotEncoding::cbor);
#ifdef CLAYSTACK_THUMBNAIL
  constexpr int kPixels = 256;
  const auto draw = [&pot] {
    return render::png_of(render::thumbnail(render::view_of(pot), kPixels));
  };
  if (!thumbnail.valid()) thumbnail = std::async(launch_policy(true), draw).share();
  request.options.draw_thumbnail = [&thumbnail] { return thumbnail.get(); };
#endif
}

}  // namespace clay::cli
