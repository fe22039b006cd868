#include "export/formats/stl_stream.hpp"

#include "core/cancel.hpp"
#include "core/threads.hpp"
#include "export/formats/stl_layout.hpp"

#include <algorithm>
#include <cstring>
#include <future>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid::inline formats {
namespace {

// Large enough to make system calls cheap, small enough for the cache.
constexpr std::size_t kBlockFacets = 20'000;
// Below this, a second thread costs more than it saves.
constexpr std::size_t kFacetsWorthAThread = 200'000;

/// The vertices of a shell in one meridian, as float32.
using Meridian = std::vector<glm::vec3>;

void fill_meridian(const RevolveLayout& rule, const Shell& shell, std::size_t sector,
                   Meridian& meridian) {
  meridian.resize(shell.points.size());
  for (std::size_t i = 0; i < meridian.size(); ++i)
    meridian[i] = file_point(rule.vertex(shell.points[i], sector));
}

/// Calls visit(corners) for each facet of sectors `first` to `last` in the order of the layout.
template <class Visit>
void for_each_facet(const RevolveLayout& rule, const Shell& shell, std::size_t first,
                    std::size_t last, Visit visit) {
  Meridian here, next;
  fill_meridian(rule, shell, first, next);
  for (std::size_t s = first; s < last; ++s) {
    std::swap(here, next);
    fill_meridian(rule, shell, s + 1 < rule.segments() ? s + 1 : 0, next);
    for (const auto& [from, to] : shell.bands) {
      step_of_loop();
      if (!shell.pole(from)) visit(stl::Corners{here[from], next[from], here[to]});
      if (!shell.pole(to)) visit(stl::Corners{next[from], next[to], here[to]});
    }
  }
}

/// Fills one block while the previous one is written to the store.
class BlockWriter {
 public:
  explicit BlockWriter(FileStore& store, std::size_t facets)
      : store_(store), launch_(launch_policy(facets >= kFacetsWorthAThread)) {
    for (std::vector<char>& block : blocks_)
      block.resize(stl::file_bytes(std::min(facets, kBlockFacets)));
    stl::store_prologue(blocks_[0].data(), facets);
    used_ = stl::kPrologueBytes;
  }

  void add(const stl::Corners& corners) {
    if (used_ + stl::kFacetBytes > blocks_[0].size()) flush();
    stl::store_facet(blocks_[0].data() + used_, corners);
    used_ += stl::kFacetBytes;
  }

  Result<StreamedFile> finish() {
    flush();
    wait();
    if (failed_) return tl::make_unexpected(*failed_);
    file_.hash = hasher_.digest();
    return std::move(file_);
  }

 private:
  void flush() {
    const auto bytes = std::as_bytes(std::span(blocks_[0])).first(std::exchange(used_, 0));
    file_.bytes += bytes.size();
    hasher_.add(bytes);
    wait();
    std::swap(blocks_[0], blocks_[1]);
    writing_ = std::async(launch_, [this, bytes] { return store_.write(bytes); });
  }

  void wait() {
    if (!writing_.valid()) return;
    if (auto written = writing_.get(); !written && !failed_) failed_ = written.error();
  }

  FileStore& store_;
  std::launch launch_;
  std::vector<char> blocks_[2];  ///< being filled, being written
  std::size_t used_ = 0;
  StreamedFile file_;
  ContentHasher hasher_;
  std::optional<Error> failed_;
  std::future<Result<void>>
      writing_;  // last: its destructor waits for work that uses the members above
};

/// Some sectors of one shell, and the position of their facets in the file.
struct Stretch {
  const Shell* shell = nullptr;
  std::size_t first_sector = 0, last_sector = 0;
  std::size_t first_facet = 0;
};

tl::unexpected<Error> differs(std::size_t facet) {
  return failure(ErrorKind::io, "stl_binary as written: facet " + std::to_string(facet + 1) +
                                    ": found corners that are not those of the solid");
}

Result<void> verify_stretch(const RevolveLayout& rule, const Stretch& stretch,
                            const FileStore& store) {
  const std::size_t end = stretch.first_facet + stretch.shell->triangles_per_sector() *
                                                    (stretch.last_sector - stretch.first_sector);
  std::vector<char> block;
  std::size_t facet = stretch.first_facet, used = 0;
  Result<void> verdict;
  for_each_facet(rule, *stretch.shell, stretch.first_sector, stretch.last_sector,
                 [&](const stl::Corners& corners) {
                   if (!verdict) return;
                   if (used == block.size()) {
                     block.resize(stl::kFacetBytes * std::min(kBlockFacets, end - facet));
                     used = 0;
                     verdict = store.read_at(stl::file_bytes(facet),
                                             std::as_writable_bytes(std::span(block)));
                     if (!verdict) return;
                   }
                   if (!stl::has_corners(&block[used], corners)) verdict = differs(facet);
                   used += stl::kFacetBytes;
                   ++facet;
                 });
  return verdict;
}

Result<void> verify_count(const RevolveLayout& rule, const FileStore& store) {
  std::string prologue(stl::kPrologueBytes, '\0');
  return store.read_at(0, std::as_writable_bytes(std::span(prologue)))
      .and_then([&]() -> Result<void> {
        const std::uint32_t count = load_u32(prologue.data() + stl::kHeaderBytes);
        if (count == rule.triangles()) return {};
        return failure(ErrorKind::io, "stl_binary as written: expected " +
                                          std::to_string(rule.triangles()) + " facets, found " +
                                          std::to_string(count));
      });
}

}  // namespace

Result<StreamedFile> stream_stl(const RevolveLayout& rule, FileStore& store) {
  BlockWriter writer(store, rule.triangles());
  for (const Shell& shell : rule.shells())
    for_each_facet(rule, shell, 0, rule.segments(),
                   [&](const stl::Corners& corners) { writer.add(corners); });
  return writer.finish();
}

Result<void> verify_stl(const RevolveLayout& rule, const FileStore& store) {
  if (auto count = verify_count(rule, store); !count) return count;
  const std::size_t half = rule.segments() / 2;
  std::size_t facet = 0;
  for (const Shell& shell : rule.shells()) {
    const std::size_t each = shell.triangles_per_sector();
    const Stretch lower{&shell, 0, half, facet};
    const Stretch upper{&shell, half, rule.segments(), facet + each * half};
    facet += each * rule.segments();
    const auto policy = launch_policy(each * rule.segments() >= kFacetsWorthAThread);
    auto second = std::async(policy, [&rule, &store, upper, question = CancelScope::current()] {
      const CancelScope scope(question);
      return verify_stretch(rule, upper, store);
    });
    const auto first = verify_stretch(rule, lower, store);
    const auto rest = second.get();
    if (!first) return first;
    if (!rest) return rest;
  }
  return {};
}

}  // namespace clay::solid::inline formats
