#pragma once
#include "claystack/engine/clay.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>

namespace clay::history {

/// Pots by node, within a memory budget: the least recently used one is evicted first. At least one
/// stays.
class PotCache {
 public:
  explicit PotCache(std::size_t budget_bytes) : budget_(budget_bytes) {}

  [[nodiscard]] std::shared_ptr<const Pot> find(std::size_t node);  ///< null if not cached
  void put(std::size_t node, std::shared_ptr<const Pot> pot);
  [[nodiscard]] std::size_t size() const noexcept { return kept_.size(); }

 private:
  struct Kept {
    std::shared_ptr<const Pot> pot;
    std::uint64_t used = 0;
  };
  void shrink();

  std::size_t budget_, bytes_ = 0;
  std::uint64_t clock_ = 0;
  std::unordered_map<std::size_t, Kept> kept_;
};

}  // namespace clay::history
