#include "core/text.hpp"
#include "export/formats/sheet.hpp"

#include <cairo-pdf.h>

#include <array>
#include <exception>
#include <memory>
#include <numbers>
#include <string>

namespace clay::solid::inline formats {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;

/// No exception may pass through the frames of the library, which is C.
cairo_status_t append(void* text, const unsigned char* bytes, unsigned int count) noexcept try {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
} catch (const std::exception&) {  // out of memory
  return CAIRO_STATUS_NO_MEMORY;
}

class PdfSheet {
 public:
  PdfSheet(const Sheet& sheet, cairo_t* page) : sheet_(sheet), page_(page) {
    cairo_scale(page_, kPointsPerMm, kPointsPerMm);
    cairo_set_line_join(page_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_fill_rule(page_, CAIRO_FILL_RULE_EVEN_ODD);
    cairo_select_font_face(page_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    for (const SheetLines& lines : sheet.lines) draw(lines);
    for (const SheetText& text : sheet.texts) draw(text);
    cairo_show_page(page_);
  }

 private:
  [[nodiscard]] glm::dvec2 on_page(const glm::dvec2& p) const {
    return {p.x - sheet_.low.x, sheet_.high.y - p.y};
  }

  void draw(const SheetLines& lines) {
    const LayerStyle& style = style_of(lines.layer);
    for (const auto& line : lines.lines) {
      cairo_new_sub_path(page_);
      for (const glm::dvec2& p : line) cairo_line_to(page_, on_page(p).x, on_page(p).y);
      if (lines.closed) cairo_close_path(page_);
    }
    if (lines.closed && style.filled) {
      cairo_set_source_rgba(page_, style.red, style.green, style.blue, 0.25);
      cairo_fill_preserve(page_);
    }
    constexpr std::array kDashDot{8.0, 1.5, 1.0, 1.5};
    cairo_set_dash(page_, kDashDot.data(), style.dash_dot ? int{kDashDot.size()} : 0, 0.0);
    cairo_set_source_rgb(page_, style.red, style.green, style.blue);
    cairo_set_line_width(page_, style.width_mm);
    cairo_stroke(page_);
  }

  void draw(const SheetText& text) {
    const LayerStyle& style = style_of(text.layer);
    cairo_set_font_size(page_, text.height_mm * 1.37);
    cairo_set_source_rgb(page_, style.red, style.green, style.blue);
    cairo_text_extents_t extents;
    const std::string words = valid_text(text.words);
    cairo_text_extents(page_, words.c_str(), &extents);
    const double part = 0.5 * static_cast<double>(text.anchor);
    const glm::dvec2 at = on_page(text.at);
    cairo_save(page_);
    cairo_translate(page_, at.x, at.y);
    if (text.upright) cairo_rotate(page_, -0.5 * std::numbers::pi);
    cairo_move_to(page_, -part * extents.x_advance, 0.0);
    cairo_show_text(page_, words.c_str());
    cairo_restore(page_);
  }

  const Sheet& sheet_;
  cairo_t* page_;
};

}  // namespace

Result<std::string> pdf_of(const Sheet& sheet) {
  const glm::dvec2 size = (sheet.high - sheet.low) * kPointsPerMm;
  std::string pdf;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_pdf_surface_create_for_stream(append, &pdf, size.x, size.y), cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE,
                                 valid_text(sheet.title).c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "1980-01-01T00:00:00Z");
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> page(cairo_create(surface.get()),
                                                                cairo_destroy);
  PdfSheet(sheet, page.get());
  cairo_surface_finish(surface.get());
  const cairo_status_t status = cairo_surface_status(surface.get());
  if (status == CAIRO_STATUS_SUCCESS) return pdf;
  return failure(ErrorKind::io, std::string("PDF: ") + cairo_status_to_string(status));
}

}  // namespace clay::solid::inline formats
