#include "app/web/page_worker.hpp"

#include <emscripten.h>

#include <utility>

namespace clay::web {
namespace {

EM_JS(void, page_post, (int slot, const char* bytes, int size),
      { Module["page"].post(slot, HEAPU8.slice(bytes, bytes + size)); });
EM_JS(void, page_stop, (int slot), { Module["page"].stop(slot); });

}  // namespace

std::array<PageWorker*, 3> PageWorker::all_{};

PageWorker::PageWorker(Slot slot) : slot_(slot) { all_[static_cast<std::size_t>(slot)] = this; }
PageWorker::~PageWorker() { all_[static_cast<std::size_t>(slot_)] = nullptr; }

void PageWorker::post(std::string_view message) {
  busy_ = true;
  stage_.clear();
  page_post(static_cast<int>(slot_), message.data(), static_cast<int>(message.size()));
}

std::optional<std::string> PageWorker::take() {
  if (!answer_) return std::nullopt;
  busy_ = false;
  stage_.clear();
  return std::exchange(answer_, std::nullopt);
}

void PageWorker::stop() {
  if (busy_ && !answer_) page_stop(static_cast<int>(slot_));
  busy_ = false;
  answer_.reset();
  stage_.clear();
}

void PageWorker::receive(int slot, std::string_view message) {
  PageWorker* const worker = all_.at(static_cast<std::size_t>(slot));
  if (worker != nullptr && worker->busy_) worker->answer_ = std::string(message);
}

void PageWorker::show_stage(int slot, std::string_view stage) {
  PageWorker* const worker = all_.at(static_cast<std::size_t>(slot));
  if (worker != nullptr && worker->busy_) worker->stage_ = std::string(stage);
}

}  // namespace clay::web
