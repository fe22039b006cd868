#pragma once
// The words of the options of an export and their values: for the command line and for Python.

#include "claystack/export/formats.hpp"
#include "claystack/export/smoothing.hpp"
#include "claystack/export/solid.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::cli {

template <class T, std::size_t N>
using Words = std::array<std::pair<std::string_view, T>, N>;

inline constexpr Words<solid::Smoothing, 3> kSmoothings{{{"fair", solid::Smoothing::fair},
                                                         {"exact", solid::Smoothing::exact},
                                                         {"none", solid::Smoothing::none}}};
inline constexpr Words<solid::StepWalls, 2> kStepWalls{
    {{"spline", solid::StepWalls::spline}, {"lines", solid::StepWalls::lines}}};
inline constexpr Words<solid::GlbMesh, 3> kGlbMeshes{{{"draco", solid::GlbMesh::draco},
                                                      {"meshopt", solid::GlbMesh::meshopt},
                                                      {"core", solid::GlbMesh::core}}};

/// Empty: none of the words.
template <class T, std::size_t N>
[[nodiscard]] std::optional<T> value_of(std::string_view word, const Words<T, N>& words) {
  for (const auto& [name, value] : words)
    if (name == word) return value;
  return std::nullopt;
}

template <class T, std::size_t N>
[[nodiscard]] std::vector<std::string> names_in(const Words<T, N>& words) {
  std::vector<std::string> names;
  for (const auto& word : words) names.emplace_back(word.first);
  return names;
}

}  // namespace clay::cli
