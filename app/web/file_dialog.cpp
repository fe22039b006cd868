// Replaces app/studio/file_dialog.cpp in a page: the browser's picker copies the chosen file into
// the file system of the page. There are no folders to choose: saved files are downloads.

#include "app/studio/file_dialog.hpp"

#include <emscripten.h>

#include <utility>

namespace clay::studio {
namespace {

EM_JS(void, page_pick, (), { Module["page"].pick(); });

FileDialog* waiting = nullptr;
std::optional<std::string> picked;

}  // namespace

FileDialog::~FileDialog() {
  if (waiting == this) waiting = nullptr;
}

bool FileDialog::begin(Kind kind, const std::filesystem::path&) {
  if (open() || kind == Kind::save || kind == Kind::folder) return false;
  kind_ = kind;
  child_ = 1;
  waiting = this;
  picked.reset();
  page_pick();
  return true;
}

std::optional<std::string> FileDialog::take() {
  if (!open() || waiting != this || !picked) return std::nullopt;
  child_ = 0;
  waiting = nullptr;
  return std::exchange(picked, std::nullopt);
}

bool show_folder(const std::filesystem::path&) { return false; }

}  // namespace clay::studio

extern "C" {
/// The user has chosen this file; empty: none.
EMSCRIPTEN_KEEPALIVE void claystack_picked(const char* path);
}

void claystack_picked(const char* path) { clay::studio::picked = path; }
