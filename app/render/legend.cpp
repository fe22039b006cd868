#include "app/render/legend.hpp"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace clay::render {
namespace {

constexpr int kLeastSide = 240;  // px: no legend in smaller pictures
constexpr int kSteps = 5;        // of the scale
constexpr double kPanelAlpha = 0.85;

struct Inks {
  Swatch text, panel;
};
constexpr Inks kLight{{0x2B, 0x2B, 0x30}, {0xFB, 0xFA, 0xF8}};
constexpr Inks kDark{{0xE6, 0xE6, 0xEA}, {0x1B, 0x1E, 0x23}};

/// A transparent drawing that is laid over a part of an image. Empty if there is no memory for it.
class Overlay {
 public:
  Overlay(int width, int height)
      : surface_(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height)),
        pen_(cairo_create(surface_.get())) {}

  [[nodiscard]] cairo_t* pen() const { return pen_.get(); }

  void lay_over(Image& image, int left, int top) const {
    cairo_surface_flush(surface_.get());
    const unsigned char* data = cairo_image_surface_get_data(surface_.get());
    if (data == nullptr) return;
    const int width =
        std::min(cairo_image_surface_get_width(surface_.get()), image.width_px - left);
    const int height =
        std::min(cairo_image_surface_get_height(surface_.get()), image.height_px - top);
    for (int y = 0; y < height; ++y, data += cairo_image_surface_get_stride(surface_.get()))
      for (int x = 0; x < width; ++x) {
        std::uint32_t argb = 0;
        std::memcpy(&argb, data + 4 * x, sizeof argb);
        blend(argb, image.at(left + x, top + y));
      }
  }

 private:
  struct Release {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* pen) const { cairo_destroy(pen); }
  };

  /// `argb`: weighted by its alpha, as cairo stores it; the colours of `rgba` are not.
  static void blend(std::uint32_t argb, std::uint8_t* rgba) {
    const std::uint32_t alpha = argb >> 24;
    if (alpha == 0) return;
    const std::uint32_t under = (rgba[3] * (255 - alpha) + 127) / 255, all = alpha + under;
    for (int channel = 0; channel < 3; ++channel) {
      const std::uint32_t over = argb >> (16 - 8 * channel) & 255;
      rgba[channel] = static_cast<std::uint8_t>(
          std::min(255U, (255 * over + rgba[channel] * under + all / 2) / all));
    }
    rgba[3] = static_cast<std::uint8_t>(all);
  }

  std::unique_ptr<cairo_surface_t, Release> surface_;
  std::unique_ptr<cairo_t, Release> pen_;
};

/// The legend on its panel. Lengths in px; `em` is the size of the font.
class Legend {
 public:
  Legend(const WallMap& map, Theme theme, int side_px)
      : map_(map),
        inks_(theme == Theme::light ? kLight : kDark),
        em_(std::max(11.0, std::round(side_px / 48.0))),
        bar_height_(std::round(0.45 * side_px)),
        overlay_(whole(10.0 * em_), whole(bar_height_ + 8.0 * em_)) {
    cairo_t* const pen = overlay_.pen();
    const std::unique_ptr<cairo_font_options_t, decltype(&cairo_font_options_destroy)> options(
        cairo_font_options_create(), &cairo_font_options_destroy);
    cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
    cairo_set_font_options(pen, options.get());
    cairo_select_font_face(pen, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(pen, em_);
    add_texts();
    draw_panel();
    draw_bar();
    ink(inks_.text);
    for (const Text& text : texts_) {
      cairo_move_to(pen, text.left, text.middle + 0.36 * em_);  // half of a capital's height
      cairo_show_text(pen, text.words.c_str());
    }
  }

  void lay_over(Image& image) const {
    const int top = (image.height_px - whole(panel_height_)) / 2;
    overlay_.lay_over(image, whole(0.6 * em_), std::max(0, top));
  }

 private:
  struct Text {
    double left, middle;
    std::string words;
  };

  static int whole(double px) { return static_cast<int>(std::lround(px)); }
  [[nodiscard]] double pad() const { return 0.8 * em_; }
  [[nodiscard]] double bar_top() const { return pad() + 2.2 * em_; }
  [[nodiscard]] double level(double mm) const {
    return bar_top() + (1.0 - mm / map_.top_mm) * bar_height_;
  }
  void ink(Swatch colour, double alpha = 1.0) const {
    cairo_set_source_rgba(overlay_.pen(), colour.red / 255.0, colour.green / 255.0,
                          colour.blue / 255.0, alpha);
  }

  /// Their extent is that of the panel.
  void add_texts() {
    texts_.push_back({pad(), pad() + 0.5 * em_, "Wall [mm]"});
    for (int k = 0; k <= kSteps; ++k) {
      const double mm = map_.top_mm * k / kSteps;
      texts_.push_back(
          {pad() + 2.0 * em_, level(mm), fmt::format("{}{:g}", k == kSteps ? "≥ " : "", mm)});
    }
    if (map_.limit_mm > 0.0) {
      texts_.push_back({pad(), level(0.0) + 1.6 * em_, "Too thin:"});
      texts_.push_back(
          {pad(), level(0.0) + 2.9 * em_, fmt::format("below {:.4g}", map_.stated_mm)});
    }
    for (const Text& text : texts_) {
      cairo_text_extents_t size{};
      cairo_text_extents(overlay_.pen(), text.words.c_str(), &size);
      panel_width_ = std::max(panel_width_, text.left + size.x_advance + pad());
      panel_height_ = std::max(panel_height_, text.middle + 0.5 * em_ + pad());
    }
  }

  void draw_panel() const {
    constexpr double kQuarter = 0.5 * std::numbers::pi;
    cairo_t* const pen = overlay_.pen();
    const double corner = 0.4 * em_, right = panel_width_ - corner, low = panel_height_ - corner;
    cairo_arc(pen, right, corner, corner, -kQuarter, 0.0);
    cairo_arc(pen, right, low, corner, 0.0, kQuarter);
    cairo_arc(pen, corner, low, corner, kQuarter, 2.0 * kQuarter);
    cairo_arc(pen, corner, corner, corner, 2.0 * kQuarter, 3.0 * kQuarter);
    cairo_close_path(pen);
    ink(inks_.panel, kPanelAlpha);
    cairo_fill(pen);
  }

  void draw_bar() const {
    cairo_t* const pen = overlay_.pen();
    const double left = std::round(pad()), width = std::round(1.1 * em_);
    const double top = std::round(bar_top());
    for (double y = 0.0; y < bar_height_; ++y) {
      ink(wall_swatch(map_, map_.top_mm * (1.0 - (y + 0.5) / bar_height_)));
      cairo_rectangle(pen, left, top + y, width, 1.0);
      cairo_fill(pen);
    }
    ink(inks_.text);
    for (int k = 0; k <= kSteps; ++k)
      cairo_rectangle(pen, left + width, level(map_.top_mm * k / kSteps) - 0.04 * em_, 0.4 * em_,
                      0.08 * em_);
    cairo_fill(pen);
    if (map_.limit_mm > 0.0) draw_stripes(left, width);
  }

  /// As on walls below the limit.
  void draw_stripes(double left, double width) const {
    cairo_t* const pen = overlay_.pen();
    const double top = std::ceil(level(std::min(map_.limit_mm, map_.top_mm))), low = level(0.0);
    cairo_save(pen);
    cairo_rectangle(pen, left, top, width, std::max(0.0, low - top));
    cairo_clip(pen);
    for (double y = top - width; y < low; y += 0.7 * em_) {
      cairo_move_to(pen, left, y);
      cairo_line_to(pen, left + width, y + width);
    }
    ink(swatch_of(kThinWallStripe));
    cairo_set_line_width(pen, 0.14 * em_);
    cairo_stroke(pen);
    cairo_restore(pen);
  }

  WallMap map_;
  Inks inks_;
  double em_, bar_height_, panel_width_ = 0.0, panel_height_ = 0.0;
  Overlay overlay_;
  std::vector<Text> texts_;
};

}  // namespace

void draw_legend(const WallMap& map, Theme theme, Image& image) {
  const int side_px = std::min(image.width_px, image.height_px);
  if (side_px >= kLeastSide) Legend(map, theme, side_px).lay_over(image);
}

}  // namespace clay::render
