#include "export/repair/sheet_count.hpp"

#include "core/cancel.hpp"
#include "export/proof/pair_test.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace clay::solid::inline repair {
namespace {

struct Item {
  Triangle sorted;
  std::uint32_t triangle;
};

bool same_direction(const Triangle& a, const Triangle& b) {
  const auto at = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  return b.at((at + 1) % 3) == a[1];
}

std::vector<Item> sorted_items(const TriangleMesh& mesh) {
  const PairTest test(mesh);
  std::vector<Item> items;
  items.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    step_of_loop();
    Triangle sorted = mesh.triangles[t];
    std::sort(sorted.begin(), sorted.end());
    if (!test.degenerate(sorted)) items.push_back({sorted, t});
  }
  std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    return std::tie(a.sorted, a.triangle) < std::tie(b.sorted, b.triangle);
  });
  return items;
}

}  // namespace

SheetCount count_sheets(const TriangleMesh& mesh) {
  const std::vector<Item> items = sorted_items(mesh);
  std::vector<std::pair<std::uint32_t, int>> kept;
  for (std::size_t i = 0; i < items.size();) {
    const Triangle& first = mesh.triangles[items[i].triangle];
    int sheets = 0;
    std::size_t next = i;
    for (; next < items.size() && items[next].sorted == items[i].sorted; ++next)
      sheets += same_direction(first, mesh.triangles[items[next].triangle]) ? 1 : -1;
    if (sheets != 0) kept.emplace_back(items[i].triangle, sheets);
    i = next;
  }
  std::sort(kept.begin(), kept.end());
  SheetCount result;
  for (const auto& [t, sheets] : kept) {
    Triangle triangle = mesh.triangles[t];
    if (sheets < 0) std::swap(triangle[1], triangle[2]);
    result.triangles.push_back(triangle);
    result.sheets.push_back(std::abs(sheets));
  }
  return result;
}

}  // namespace clay::solid::inline repair
