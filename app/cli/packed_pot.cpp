#include "app/cli/packed_pot.hpp"

#include "app/cli/memory_room.hpp"
#include "claystack/engine/files.hpp"
#ifdef CLAYSTACK_WINDOW
#include "app/render/image_file.hpp"
#include "app/render/offscreen.hpp"
#include "app/render/pot_view.hpp"
#endif

#include <algorithm>

namespace clay::cli {
namespace {

/// PNG; empty without a renderer, or memory for it.
std::string thumbnail_of([[maybe_unused]] const Pot& pot) {
#ifdef CLAYSTACK_WINDOW
  constexpr int kSide = 256;
  constexpr render::Viewport kSize{kSide, kSide};
  render::Picture picture;
  picture.pot = render::view_of(pot);
  picture.camera = render::framed(picture.pot, kSize.aspect());
  return expect_room_to_draw(kSide * kSide)
      .and_then([] { return render::Offscreen::create(); })
      .and_then([&](render::Offscreen screen) { return screen.draw(picture, kSize); })
      .map(render::png_of)
      .value_or(std::string());
#else
  return {};
#endif
}

}  // namespace

void pack_pot(const Pot& pot, solid::ExportRequest& request,
              std::optional<std::string>& thumbnail) {
  const bool wanted = std::ranges::any_of(request.files, [](const solid::FileRequest& file) {
    return file.kind == solid::FileKind::mesh && file.format == solid::MeshFormat::three_mf;
  });
  if (!wanted) return;
  request.options.pot_file = write_pot(pot, PotEncoding::cbor);
  if (!thumbnail) thumbnail = thumbnail_of(pot);
  request.options.thumbnail_png = *thumbnail;
}

}  // namespace clay::cli
