#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace clay::solid::inline proof {

/// Counting stops here: such a mesh cannot be used anyway.
inline constexpr std::size_t kMaxSelfIntersections = 100'000;

using TrianglePair = std::pair<std::uint32_t, std::uint32_t>;  ///< lower number first

/// Gets the intersecting pairs of a search. A call returns false when the search may end.
class PairSink {
 public:
  virtual ~PairSink() = default;
  virtual bool add(std::uint32_t a, std::uint32_t b) = 0;
  /// Triangles of which any two in different groups intersect. Each group is sorted and not empty.
  virtual bool add_between(const std::vector<std::vector<std::uint32_t>>& groups) = 0;
};

/// The number of intersecting pairs of triangles, and the pair of lowest numbers.
struct Crossings {
  std::size_t count = 0;
  TrianglePair first{UINT32_MAX, UINT32_MAX};

  /// Returns false when the limit is reached.
  bool add(const Crossings& more) {
    count = std::min(count + more.count, kMaxSelfIntersections);
    first = std::min(first, more.first);
    return count < kMaxSelfIntersections;
  }
};

class CrossingCount final : public PairSink {
 public:
  bool add(std::uint32_t a, std::uint32_t b) override { return found.add({1, std::minmax(a, b)}); }
  bool add_between(const std::vector<std::vector<std::uint32_t>>& groups) override {
    std::size_t before = 0;
    Crossings all;
    std::vector<std::uint32_t> lowest;
    for (const auto& group : groups) {
      all.count += before * group.size();
      before += group.size();
      lowest.push_back(group.front());
    }
    if (lowest.size() < 2) return true;
    std::partial_sort(lowest.begin(), lowest.begin() + 2, lowest.end());
    all.first = {lowest[0], lowest[1]};
    return found.add(all);
  }

  Crossings found;
};

/// Lists pairs. Several lists, on several threads, share the count and its limit.
class CrossingList final : public PairSink {
 public:
  CrossingList(std::atomic<std::size_t>& count, std::size_t most) : count_(count), most_(most) {}

  bool add(std::uint32_t a, std::uint32_t b) override {
    found.emplace_back(std::min(a, b), std::max(a, b));
    return ++count_ < most_;
  }
  bool add_between(const std::vector<std::vector<std::uint32_t>>& groups) override {
    for (std::size_t i = 0; i < groups.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (const std::uint32_t a : groups[i])
          for (const std::uint32_t b : groups[j])
            if (!add(a, b)) return false;
    return true;
  }
  [[nodiscard]] bool full() const { return count_ >= most_; }

  std::vector<TrianglePair> found;

 private:
  std::atomic<std::size_t>& count_;
  std::size_t most_;
};

}  // namespace clay::solid::inline proof
