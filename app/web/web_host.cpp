#include "app/web/web_host.hpp"

#include <emscripten.h>
#include <emscripten/html5.h>

#include <algorithm>

namespace clay::web {
namespace {

EM_JS(void, page_copy, (const char* text), { Module["page"].copy(UTF8ToString(text)); });
EM_JS(void, page_download, (const char* path), { Module["page"].download(UTF8ToString(path)); });

}  // namespace

void WebHost::begin_frame(double page_ms) noexcept {
  if (last_ms_ >= 0.0)
    frame_ns_ +=
        static_cast<std::int64_t>(1e6 * std::clamp(page_ms - last_ms_, 0.0, kLongestFrameMs));
  last_ms_ = page_ms;
}

void WebHost::set_title(const std::string& title) { emscripten_set_window_title(title.c_str()); }

void WebHost::set_clipboard(const std::string& text) {
  clipboard_ = text;
  page_copy(text.c_str());
}

void WebHost::file_written(const std::string& path) { page_download(path.c_str()); }

}  // namespace clay::web
