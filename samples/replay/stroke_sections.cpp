// stroke_sections WORK: a table of the result of each stroke of a work with the clay rules, and of
// its dependence on the ring height. stroke_sections WORK OUT.svg NODE...: sections of the pots
// after these strokes, above as thrown without the clay rules, below by the same strokes with them.

#include "app/bench/hands/pot_measures.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "samples/replay/recorded_strokes.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace clay;

constexpr double kApartMm = 20.0, kTextMm = 8.0, kBarMm = 50.0;
constexpr double kPixelsPerMm = 1.2;

/// A number with one decimal place, without the locale.
std::string number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 1).ptr;
  return {text, end};
}

std::string text_at(double x, double y, const std::string& text) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\">" + text + "</text>\n";
}

/// Both halves of a section, in one path so that no seam shows on the axis.
std::string section(const ClayStack& stack, double axis, double ground) {
  const auto rings = stack.rings();
  const double h = stack.ring_height_mm();
  std::string path = "<path d=\"";
  for (const double side : {-1.0, 1.0}) {
    const auto point = [&](double radius, std::size_t level) {
      path += number(axis + side * radius) + ',' + number(ground - static_cast<double>(level) * h) +
              ' ';
    };
    path += 'M';
    for (std::size_t i = 0; i < rings.size(); ++i)
      for (const std::size_t end : {i, i + 1}) point(rings[i].outer_mm(), end);
    for (std::size_t i = rings.size(); i-- > 0;)
      for (const std::size_t end : {i + 1, i}) point(rings[i].inner_mm(), end);
    path += "z ";
  }
  return path + "\"/>\n";
}

struct Row {
  std::string title;
  std::vector<const ClayStack*> stacks;
};

double width_mm(const ClayStack& stack) { return 2.0 * largest_radius_mm(stack); }

/// The rows at one scale; each column is as wide as its widest pot.
std::string drawing(const std::vector<Row>& rows, const std::vector<std::size_t>& nodes) {
  std::vector<double> axes;
  double width = kApartMm;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    double column = 0.0;
    for (const Row& row : rows) column = std::max(column, width_mm(*row.stacks[k]));
    axes.push_back(width + 0.5 * column);
    width += column + kApartMm;
  }
  std::string body;
  double ground = 0.0;
  for (const Row& row : rows) {
    body += "<g class=\"row\">" + text_at(kApartMm, ground + 2.0 * kTextMm, row.title) + "</g>\n";
    double tallest = 0.0;
    for (const ClayStack* stack : row.stacks) tallest = std::max(tallest, stack->height_mm());
    ground += 5.0 * kTextMm + tallest;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const ClayStack& stack = *row.stacks[k];
      const double top = ground - stack.height_mm();
      body += section(stack, axes[k], ground) +
              text_at(axes[k], top - 1.5 * kTextMm, "stroke " + std::to_string(nodes[k])) +
              text_at(axes[k], top - 0.4 * kTextMm,
                      number(width_mm(stack)) + " x " + number(stack.height_mm()) + " mm");
    }
    ground += kTextMm;
  }
  const double bar = ground + kTextMm, height = bar + 2.0 * kTextMm;
  body += "<path class=\"bar\" d=\"M" + number(kApartMm) + ',' + number(bar) + " h" +
          number(kBarMm) + "\"/>\n" +
          text_at(kApartMm + 0.5 * kBarMm, bar + 1.2 * kTextMm, number(kBarMm) + " mm");
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(kPixelsPerMm * width) +
         "\" height=\"" + number(kPixelsPerMm * height) + "\" viewBox=\"0 0 " + number(width) +
         ' ' + number(height) +
         "\">\n<style>path{fill:#c48a63;stroke:none}.bar{stroke:#333;stroke-width:1.5}"
         "text{font:8px sans-serif;text-anchor:middle;fill:#333}"
         ".row text{font-weight:bold;text-anchor:start}</style>\n"
         "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
         body + "</svg>\n";
}

Result<WorkRecord> read_work(const char* path) {
  return read_file(path)
      .and_then([&](const std::string& text) { return parse_work(text, path); })
      .map([](auto&& read) { return std::move(read.work); });
}

/// To the standard output.
Result<void> print_table(const char* work_path) {
  const auto work = read_work(work_path);
  if (!work) return tl::make_unexpected(work.error());
  std::vector<std::vector<Pot>> pots;
  for (const int finer : {1, 2, 4}) {
    auto thrown = samples::thrown_again(*work, ClaySpec{}, finer);
    if (!thrown) return tl::make_unexpected(thrown.error());
    pots.push_back(std::move(*thrown));
  }
  const auto plain = samples::thrown_again(*work, std::nullopt);
  if (!plain) return tl::make_unexpected(plain.error());
  std::puts(
      "Each stroke with the clay rules; in brackets without them. Lengths in mm. Ledge: the "
      "largest\n"
      "step steeper than 3. h: mean difference of the surfaces from those with rings of half the\n"
      "height; h/2: from half the height to a quarter.\n");
  std::puts("stroke  kind   height         width          ledge        cavities   h      h/2");
  for (std::size_t node = 1; node < work->nodes.size(); ++node) {
    const ClayStack &stack = pots[0][node].stack, &fine = pots[1][node].stack;
    const bench::PotMeasures pot = bench::measure(stack),
                             old = bench::measure((*plain)[node].stack);
    std::printf(
        "%6zu  %-5s  %5.1f (%5.1f)  %5.1f (%5.1f)  %4.1f (%5.1f)  %d (%d)     %5.2f  %5.2f\n", node,
        samples::cuts(*work, node) ? "cut" : "press", pot.height_mm, old.height_mm, pot.width_mm,
        old.width_mm, pot.ledge_mm, old.ledge_mm, pot.cavities, old.cavities,
        samples::mean_difference_mm(stack, fine),
        samples::mean_difference_mm(fine, pots[2][node].stack));
  }
  return {};
}

Result<void> draw(const char* work_path, const char* out_path,
                  const std::vector<std::size_t>& nodes) {
  const auto work = read_work(work_path);
  if (!work) return tl::make_unexpected(work.error());
  for (const std::size_t node : nodes)
    if (node >= work->nodes.size())
      return failure(ErrorKind::bad_input, std::string(work_path) + ": expected a node from 0 to " +
                                               std::to_string(work->nodes.size() - 1) + ", found " +
                                               std::to_string(node));
  const auto plain = samples::thrown_again(*work, std::nullopt);
  if (!plain) return tl::make_unexpected(plain.error());
  const auto ruled = samples::thrown_again(*work, ClaySpec{});
  if (!ruled) return tl::make_unexpected(ruled.error());
  Row above{"Without the clay rules", {}}, below{"With the clay rules", {}};
  for (const std::size_t node : nodes) {
    above.stacks.push_back(&(*plain)[node].stack);
    below.stacks.push_back(&(*ruled)[node].stack);
  }
  return publish(out_path, drawing({above, below}, nodes));
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::size_t> nodes;
  for (int k = 3; k < argc; ++k) {
    const char* end = argv[k] + std::strlen(argv[k]);
    std::size_t node = 0;
    if (const auto [stop, problem] = std::from_chars(argv[k], end, node);
        problem != std::errc() || stop != end) {
      nodes.clear();
      break;
    }
    nodes.push_back(node);
  }
  if (argc != 2 && nodes.empty()) {
    std::fputs("usage: stroke_sections NAME.work [OUT.svg NODE...]\n", stderr);
    return 2;
  }
  if (const auto done = argc == 2 ? print_table(argv[1]) : draw(argv[1], argv[2], nodes); !done) {
    std::fprintf(stderr, "stroke_sections: %s\n", done.error().message.c_str());
    return done.error().kind == ErrorKind::io ? 3 : 2;
  }
  return 0;
}
