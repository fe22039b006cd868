#include "draw/image_file.hpp"

#include <fmt/format.h>
#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>

namespace clay::draw {
namespace {

constexpr int kColours = 256;
constexpr std::size_t kSampled = std::size_t{1} << 20;  // pixels that the palette is chosen from
constexpr std::size_t kCell = 6;                        // bits of a channel in the look-up table

using Palette = std::array<GifColorType, kColours>;

Result<Palette> palette_of(const std::vector<Image>& frames) {
  std::vector<GifByteType> red, green, blue;
  const std::size_t all = frames.size() * frames.front().rgba.size() / 4;
  const std::size_t stride = all / kSampled + 1;
  std::size_t at = 0;
  for (const Image& frame : frames)
    for (std::size_t pixel = 0; pixel < frame.rgba.size() / 4; ++pixel)
      if (at++ % stride == 0) {
        red.push_back(frame.rgba[4 * pixel]);
        green.push_back(frame.rgba[4 * pixel + 1]);
        blue.push_back(frame.rgba[4 * pixel + 2]);
      }
  Palette palette{};
  int size = kColours;
  std::vector<GifByteType> indices(red.size());
  if (GifQuantizeBuffer(static_cast<unsigned>(red.size()), 1, &size, red.data(), green.data(),
                        blue.data(), indices.data(), palette.data()) != GIF_OK)
    return failure(ErrorKind::io, "giflib could not choose colours for the animation");
  for (int i = size; i < kColours; ++i) palette[static_cast<std::size_t>(i)] = palette[0];
  return palette;
}

/// The nearest colour of a palette for each cell of the colour cube.
class Nearest {
 public:
  explicit Nearest(const Palette& palette) : index_(std::size_t{1} << (3 * kCell)) {
    for (std::size_t cell = 0; cell < index_.size(); ++cell)
      index_[cell] =
          nearest(palette, middle(cell >> (2 * kCell)), middle(cell >> kCell), middle(cell));
  }
  [[nodiscard]] GifByteType operator()(int red, int green, int blue) const {
    return index_[part(red) << (2 * kCell) | part(green) << kCell | part(blue)];
  }

 private:
  static constexpr std::size_t kMask = (std::size_t{1} << kCell) - 1;
  static int middle(std::size_t cell) {
    return static_cast<int>((cell & kMask) << (8 - kCell) | 2u);
  }
  static std::size_t part(int value) {
    return static_cast<std::size_t>(std::clamp(value, 0, 255)) >> (8 - kCell);
  }
  static GifByteType nearest(const Palette& palette, int red, int green, int blue) {
    const auto far = [&](const GifColorType& c) {
      const int r = c.Red - red, g = c.Green - green, b = c.Blue - blue;
      return 3 * r * r + 6 * g * g + b * b;  // about as the eye weighs them
    };
    const auto least = std::ranges::min_element(
        palette, [&](const auto& a, const auto& b) { return far(a) < far(b); });
    return static_cast<GifByteType>(least - palette.begin());
  }
  std::vector<GifByteType> index_;
};

/// Ordered dither: steps of the palette become a fine pattern that stays still between frames.
int dither(int x, int y) {
  constexpr std::array<int, 16> kBayer{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  return kBayer[static_cast<std::size_t>((y & 3) << 2 | (x & 3))] - 8;
}

struct Closer {
  void operator()(GifFileType* gif) const {
    int ignored = 0;
    EGifCloseFile(gif, &ignored);
  }
};
using Writer = std::unique_ptr<GifFileType, Closer>;

int append(GifFileType* gif, const GifByteType* data, int size) {
  static_cast<std::string*>(gif->UserData)
      ->append(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
  return size;
}

bool put_loop(GifFileType* gif) {
  constexpr std::array<GifByteType, 3> kForEver{1, 0, 0};
  return EGifPutExtensionLeader(gif, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
         EGifPutExtensionBlock(gif, 11, "NETSCAPE2.0") == GIF_OK &&
         EGifPutExtensionBlock(gif, 3, kForEver.data()) == GIF_OK &&
         EGifPutExtensionTrailer(gif) == GIF_OK;
}

bool put_frame(GifFileType* gif, const Image& image, const Nearest& nearest, int delay_ms) {
  const GraphicsControlBlock control{DISPOSE_DO_NOT, false, (delay_ms + 5) / 10,
                                     NO_TRANSPARENT_COLOR};
  std::array<GifByteType, 4> bytes{};
  EGifGCBToExtension(&control, bytes.data());
  if (EGifPutExtension(gif, GRAPHICS_EXT_FUNC_CODE, 4, bytes.data()) != GIF_OK ||
      EGifPutImageDesc(gif, 0, 0, image.width_px, image.height_px, false, nullptr) != GIF_OK)
    return false;
  std::vector<GifByteType> line(static_cast<std::size_t>(image.width_px));
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      const std::uint8_t* p = image.at(x, y);
      const int noise = dither(x, y) * 3 / 4;
      line[static_cast<std::size_t>(x)] = nearest(p[0] + noise, p[1] + noise, p[2] + noise);
    }
    if (EGifPutLine(gif, line.data(), image.width_px) != GIF_OK) return false;
  }
  return true;
}

}  // namespace

Result<std::string> gif_of(const std::vector<Image>& frames, int delay_ms) {
  assert(!frames.empty());
  const auto palette = palette_of(frames);
  if (!palette) return tl::make_unexpected(palette.error());
  const std::unique_ptr<ColorMapObject, decltype(&GifFreeMapObject)> colours(
      GifMakeMapObject(kColours, palette->data()), &GifFreeMapObject);
  std::string bytes;
  int why = 0;
  Writer gif(EGifOpen(&bytes, append, &why));
  const auto failed = [&] {
    return failure(ErrorKind::io, fmt::format("giflib could not write the animation (error {})",
                                              gif ? gif->Error : why));
  };
  if (!gif || !colours) return failed();
  EGifSetGifVersion(gif.get(), true);
  const Nearest nearest(*palette);
  const Image& first = frames.front();
  if (EGifPutScreenDesc(gif.get(), first.width_px, first.height_px, 8, 0, colours.get()) !=
          GIF_OK ||
      !put_loop(gif.get()))
    return failed();
  for (const Image& frame : frames)
    if (!put_frame(gif.get(), frame, nearest, delay_ms)) return failed();
  gif.reset();  // writes the last bytes
  return bytes;
}

}  // namespace clay::draw
