#include "tests/app/import/raster.hpp"

#include "tests/support/run_program.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>

namespace clay::importing::raster {
namespace {

constexpr int kSubLines = 16;

/// Adds to a row of pixels the run from `from` to `to`.
void add_run(float* row, int width, double from, double to, float weight) {
  from = std::clamp(from, 0.0, static_cast<double>(width));
  to = std::clamp(to, 0.0, static_cast<double>(width));
  for (int x = static_cast<int>(from); x < width && x < to; ++x) {
    const double covered = std::min<double>(to, x + 1) - std::max<double>(from, x);
    row[x] += weight * static_cast<float>(covered);
  }
}

}  // namespace

double Image::area() const { return std::accumulate(ink.begin(), ink.end(), 0.0); }

Image drawn(const std::vector<Line>& lines, int width, int height, double pixels_per_mm) {
  Image image{width, height, std::vector<float>(static_cast<std::size_t>(width * height), 0.0f)};
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(height * kSubLines));
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.points_mm.size(); ++i) {
      glm::dvec2 a = line.points_mm[i] * pixels_per_mm;
      glm::dvec2 b = line.points_mm[(i + 1) % line.points_mm.size()] * pixels_per_mm;
      a.y *= -kSubLines, b.y *= -kSubLines;
      if (a.y > b.y) std::swap(a, b);
      // Sub-line k is at k + 1/2.
      const double first = std::max(0.0, std::ceil(a.y - 0.5));
      const double end = std::min(static_cast<double>(height * kSubLines), std::ceil(b.y - 0.5));
      for (double k = first; k < end; ++k)
        crossings[static_cast<std::size_t>(k)].push_back(a.x + (b.x - a.x) * (k + 0.5 - a.y) /
                                                                   (b.y - a.y));
    }
  }
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    std::vector<double>& row = crossings[k];
    std::sort(row.begin(), row.end());
    float* pixels = image.ink.data() + (k / kSubLines) * static_cast<std::size_t>(width);
    for (std::size_t i = 0; i + 1 < row.size(); i += 2)
      add_run(pixels, width, row[i], row[i + 1], 1.0f / kSubLines);
  }
  return image;
}

Image rendered(const std::string& svg_path, int width, int height, const std::string& scratch) {
  const std::string png = scratch + "/page.png";
  const auto size = std::to_string(width), tall = std::to_string(height);
  const auto run = test::shell("rsvg-convert --unlimited -w " + size + " -h " + tall + " -o " +
                               png + " " + svg_path);
  if (run.status != 0) return {};
  Image image;
  int channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load(png.c_str(), &image.width, &image.height, &channels, 4), &stbi_image_free);
  if (!pixels) return {};
  for (int i = 0; i < image.width * image.height; ++i)
    image.ink.push_back(static_cast<float>(pixels.get()[4 * i + 3]) / 255.0f);
  return image;
}

double largest_difference(const Image& a, const Image& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.ink.size(); ++i)
    largest = std::max<double>(largest, std::abs(a.ink[i] - b.ink[i]));
  return largest;
}

long differing_far_from_edges(const Image& a, const Image& b, int margin) {
  long count = 0;
  for (int y = margin; y < a.height - margin; ++y) {
    for (int x = margin; x < a.width - margin; ++x) {
      if (std::abs(a.at(x, y) - b.at(x, y)) < 0.5f) continue;
      bool even = true;
      for (int dy = -margin; even && dy <= margin; ++dy)
        for (int dx = -margin; even && dx <= margin; ++dx)
          even = std::abs(a.at(x + dx, y + dy) - a.at(x, y)) < 0.01f;
      count += even ? 1 : 0;
    }
  }
  return count;
}

}  // namespace clay::importing::raster
