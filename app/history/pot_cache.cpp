#include "app/history/pot_cache.hpp"

#include <algorithm>
#include <utility>

namespace clay::history {
namespace {

std::size_t bytes_of(const Pot& pot) { return sizeof(Pot) + pot.stack.size() * sizeof(Ring); }

}  // namespace

std::shared_ptr<const Pot> PotCache::find(std::size_t node) {
  const auto found = kept_.find(node);
  if (found == kept_.end()) return nullptr;
  found->second.used = ++clock_;
  return found->second.pot;
}

void PotCache::put(std::size_t node, std::shared_ptr<const Pot> pot) {
  Kept& kept = kept_[node];
  if (kept.pot) bytes_ -= bytes_of(*kept.pot);
  bytes_ += bytes_of(*pot);
  kept = {std::move(pot), ++clock_};
  shrink();
}

void PotCache::shrink() {
  while (bytes_ > budget_ && kept_.size() > 1) {
    const auto oldest =
        std::ranges::min_element(kept_, {}, [](const auto& entry) { return entry.second.used; });
    bytes_ -= bytes_of(*oldest->second.pot);
    kept_.erase(oldest);
  }
}

}  // namespace clay::history
