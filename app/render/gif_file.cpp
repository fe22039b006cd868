#include "app/render/image_file.hpp"

#include <fmt/format.h>
#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace clay::render {
namespace {

constexpr int kColours = 256;
constexpr std::size_t kSampled = std::size_t{1} << 20;  // pixels from which the palette is chosen
constexpr std::size_t kCell = 6;                        // bits of a channel in the look-up table

using Palette = std::array<GifColorType, kColours>;

Result<Palette> palette_of(std::size_t frames, const FrameSource& frame_at) {
  std::vector<GifByteType> red, green, blue;
  const std::size_t chosen = palette_frames(frames);
  std::size_t stride = 1, at = 0;
  for (std::size_t k = 0; k < chosen; ++k) {
    const auto image = frame_at(k * frames / chosen);
    if (!image) return tl::make_unexpected(image.error());
    const std::size_t pixels = image->rgba.size() / 4;
    if (k == 0) stride = chosen * pixels / kSampled + 1;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
      if (at++ % stride == 0) {
        red.push_back(image->rgba[4 * pixel]);
        green.push_back(image->rgba[4 * pixel + 1]);
        blue.push_back(image->rgba[4 * pixel + 2]);
      }
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

/// The nearest colour of a palette for each cell of the colour cube, found at the cell's first use:
/// pictures of pots use few cells.
class Nearest {
 public:
  explicit Nearest(const Palette& palette)
      : palette_(palette), index_(std::size_t{1} << (3 * kCell), kUnknown) {}
  [[nodiscard]] GifByteType operator()(int red, int green, int blue) {
    const std::size_t cell = part(red) << (2 * kCell) | part(green) << kCell | part(blue);
    if (index_[cell] == kUnknown)
      index_[cell] = nearest(middle(cell >> (2 * kCell)), middle(cell >> kCell), middle(cell));
    return static_cast<GifByteType>(index_[cell]);
  }

 private:
  static constexpr std::int16_t kUnknown = -1;
  static constexpr std::size_t kMask = (std::size_t{1} << kCell) - 1;
  static int middle(std::size_t cell) {
    return static_cast<int>((cell & kMask) << (8 - kCell) | 2u);
  }
  static std::size_t part(int value) {
    return static_cast<std::size_t>(std::clamp(value, 0, 255)) >> (8 - kCell);
  }
  [[nodiscard]] std::int16_t nearest(int red, int green, int blue) const {
    const auto far = [&](const GifColorType& c) {
      const int r = c.Red - red, g = c.Green - green, b = c.Blue - blue;
      return 3 * r * r + 6 * g * g + b * b;  // approximate sensitivity of the eye
    };
    const auto least = std::ranges::min_element(
        palette_, [&](const auto& a, const auto& b) { return far(a) < far(b); });
    return static_cast<std::int16_t>(least - palette_.begin());
  }
  const Palette& palette_;
  std::vector<std::int16_t> index_;
};

/// Ordered dither: a fine pattern that does not move between frames.
int dither(int x, int y) {
  constexpr std::array<int, 16> kBayer{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  return kBayer[static_cast<std::size_t>((y & 3) << 2 | (x & 3))] - 8;
}

/// Collects the small writes of giflib, and keeps the sink's first error.
class Output {
 public:
  explicit Output(const ByteSink& sink) : sink_(sink) { buffer_.reserve(kBuffered); }
  Result<void> flush() {
    if (state_ && !buffer_.empty()) state_ = sink_(buffer_);
    written_ += buffer_.size();
    buffer_.clear();
    return state_;
  }
  /// For giflib: a result below `size` reports a failed write.
  static int append(GifFileType* gif, const GifByteType* data, int size) {
    auto& self = *static_cast<Output*>(gif->UserData);
    self.buffer_.append(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
    return self.buffer_.size() < kBuffered || self.flush() ? size : 0;
  }
  [[nodiscard]] const Result<void>& state() const noexcept { return state_; }
  [[nodiscard]] std::uint64_t written() const noexcept { return written_; }

 private:
  static constexpr std::size_t kBuffered = std::size_t{1} << 16;
  const ByteSink& sink_;
  std::string buffer_;
  Result<void> state_;
  std::uint64_t written_ = 0;
};

struct Closer {
  void operator()(GifFileType* gif) const {
    int ignored = 0;
    EGifCloseFile(gif, &ignored);
  }
};
using Writer = std::unique_ptr<GifFileType, Closer>;

bool put_loop(GifFileType* gif) {
  constexpr std::array<GifByteType, 3> kForEver{1, 0, 0};
  return EGifPutExtensionLeader(gif, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
         EGifPutExtensionBlock(gif, 11, "NETSCAPE2.0") == GIF_OK &&
         EGifPutExtensionBlock(gif, 3, kForEver.data()) == GIF_OK &&
         EGifPutExtensionTrailer(gif) == GIF_OK;
}

bool put_frame(GifFileType* gif, const Image& image, Nearest& nearest, int delay_ms) {
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

std::size_t palette_frames(std::size_t frames) noexcept {
  constexpr std::size_t kMost = 8;  // a pot looks much the same from all sides
  return std::min(frames, kMost);
}

Result<std::uint64_t> write_gif(std::size_t frames, int delay_ms, const FrameSource& frame_at,
                                const ByteSink& sink) {
  assert(frames > 0);
  const auto palette = palette_of(frames, frame_at);
  if (!palette) return tl::make_unexpected(palette.error());
  const std::unique_ptr<ColorMapObject, decltype(&GifFreeMapObject)> colours(
      GifMakeMapObject(kColours, palette->data()), &GifFreeMapObject);
  Output output(sink);
  int why = 0;
  Writer gif(EGifOpen(&output, Output::append, &why));
  const auto failed = [&]() -> tl::unexpected<Error> {
    if (!output.state()) return tl::make_unexpected(output.state().error());
    return failure(ErrorKind::io, fmt::format("giflib could not write the animation (error {})",
                                              gif ? gif->Error : why));
  };
  if (!gif || !colours) return failed();
  EGifSetGifVersion(gif.get(), true);
  Nearest nearest(*palette);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const auto image = frame_at(frame);
    if (!image) return tl::make_unexpected(image.error());
    const bool begun = frame > 0 || (EGifPutScreenDesc(gif.get(), image->width_px, image->height_px,
                                                       8, 0, colours.get()) == GIF_OK &&
                                     put_loop(gif.get()));
    if (!begun || !put_frame(gif.get(), *image, nearest, delay_ms)) return failed();
  }
  gif.reset();  // writes the last bytes
  return output.flush().map([&] { return output.written(); });
}

}  // namespace clay::render
