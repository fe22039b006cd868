// A work as a file.

#include "app/history/work.hpp"
#include "claystack/core/atomic_file.hpp"

#include <cassert>
#include <utility>

namespace clay::history {

Result<void> Work::save(const std::string& path) {
  assert(!running_);
  if (auto published = publish(path, write_work(record_)); !published) return published;
  record_.saved_at = at();
  record_.saved_nodes = size();
  if (journal_) journal_->append(work_saved_line(at(), size()));
  return {};
}

bool Work::unsaved() const noexcept {
  return record_.saved_at != at() || record_.saved_nodes != size();
}

void Work::keep(std::unique_ptr<Journal> journal) {
  assert(!running_);
  journal_ = std::move(journal);
}

Result<Loaded> load(const std::string& path) {
  auto reading =
      read_file(path).and_then([&](const std::string& text) { return parse_work(text, path); });
  if (!reading) return tl::make_unexpected(reading.error());
  const bool torn = reading->torn || reading->running;
  if (!torn) {
    reading->work.saved_at = reading->work.at;
    reading->work.saved_nodes = reading->work.nodes.size();
  }
  auto work = Work::open(std::move(reading->work));
  if (!work) return failure(work.error().kind, path + ": " + work.error().message);
  return Loaded{std::move(*work), torn};
}

}  // namespace clay::history
