#include "app/import/dxf_shapes.hpp"
#include "app/import/readers.hpp"
#include "core/lower_case.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

namespace clay::importing {
namespace {

constexpr long kFrozen = 1;                       // bit of a layer's flags
constexpr int kDeepest = 16;                      // blocks within blocks
constexpr std::size_t kMostEntities = 1'000'000;  // counted again at each insertion
constexpr std::size_t kMostGroups = 20'000'000;   // of all blocks, counted again at each insertion

/// Length in mm of a unit by its number in $INSUNITS; empty for units that are not used for pots.
std::optional<double> mm_of_unit(long unit) {
  switch (unit) {
    case 0:  // no unit given
    case 4:
      return 1.0;
    case 1:
      return 25.4;
    case 2:
      return 304.8;
    case 5:
      return 10.0;
    case 6:
      return 1000.0;
    default:
      return std::nullopt;
  }
}

/// Kinds that may be the outline of a pot and are not read, unlike texts and dimensions.
bool has_outline(std::string_view type) {
  constexpr std::array<std::string_view, 6> kKinds = {"3DFACE", "3DSOLID", "BODY",
                                                      "HELIX",  "MLINE",   "REGION"};
  return std::ranges::find(kKinds, type) != kKinds.end();
}

/// The name of a layer or block, in lower case: DXF names are equal in either case.
using Name = std::string;

Name name_of(std::string_view text) { return lower_case(dxf_text(text)); }

struct Block {
  DxfGroups content;
  glm::dvec2 base{0.0};
  std::size_t groups = 0;  ///< that each insertion reads again
};

/// One insertion: the placement of its content, and the layer of its entities that are on layer 0.
struct Insertion {
  DxfPlacement placement;
  std::string layer = "0";
  int depth = 0;
};

/// Reads a DXF file section by section.
class Reader {
 public:
  Reader(const std::string& name, const std::string& layer, double scale)
      : name_(name), asked_layer_(layer), layer_(name_of(layer)), scale_(scale) {}

  Result<Drawing> read(DxfGroups groups) {
    while (true) {
      const auto entity = take_dxf_entity(groups, name_);
      if (!entity) return tl::make_unexpected(entity.error());
      if (entity->type == "EOF") break;
      if (entity->type != "SECTION") continue;
      if (auto done = section(*entity, groups); !done) return tl::make_unexpected(done.error());
    }
    if (!layer_.empty() && !seen_layers_.contains(layer_))
      return failure(ErrorKind::bad_input, fmt::format("{}: expected a layer \"{}\", found {}",
                                                       name_, shown(asked_layer_), layer_names()));
    return drawing();
  }

 private:
  /// The names that --layer accepts, as the file writes them.
  [[nodiscard]] std::string layer_names() const {
    std::vector<std::string> names;
    for (const auto& [name, written] : seen_layers_) names.push_back(written);
    return names.empty() ? "no lines on any layer" : list_of(names);
  }

  Result<Drawing> drawing() {
    Drawing drawing{std::move(lines_), false};
    if (unread_.empty()) return drawing;
    const std::string problem =
        fmt::format("{}: expected lines, polylines, arcs, circles, ellipses and splines, found {}",
                    name_, fmt::join(unread_, ", "));
    if (drawing.lines.empty())
      return failure(ErrorKind::bad_input, problem + " alone; explode what is of other kinds");
    drawing.notes.push_back(problem + " too, which is not read");
    return drawing;
  }

  Result<void> section(const DxfEntity& start, DxfGroups& groups) {
    const std::string_view kind = start.text(2);
    if (kind == "HEADER") return header(start);
    if (kind == "ENTITIES") {
      Insertion page;
      page.placement.turn *= scale_ * unit_mm_;
      return entities(groups, page, "ENDSEC");
    }
    while (true) {
      const auto entity = take_dxf_entity(groups, name_);
      if (!entity) return tl::make_unexpected(entity.error());
      if (entity->type == "EOF")
        return failure(ErrorKind::bad_input,
                       fmt::format("{}:{}: expected the end of section {}, found the end of the "
                                   "drawing",
                                   name_, entity->line, shown(kind)));
      if (entity->type == "ENDSEC") return {};
      auto done = kind == "TABLES" && entity->type == "LAYER"   ? layer(*entity)
                  : kind == "BLOCKS" && entity->type == "BLOCK" ? block(*entity, groups)
                                                                : Result<void>();
      if (!done) return done;
    }
  }

  Result<void> header(const DxfEntity& start) {
    std::string_view variable;
    for (const DxfGroup& group : start.groups) {
      if (group.code == 9) variable = group.value;
      if (group.code != 70 || variable != "$INSUNITS") continue;
      const auto unit = dxf_integer(group, name_);
      if (!unit) return tl::make_unexpected(unit.error());
      const auto mm = mm_of_unit(*unit);
      if (!mm)
        return failure(ErrorKind::bad_input,
                       fmt::format("{}:{}: $INSUNITS: expected mm, cm, m, inches or feet, found "
                                   "unit {}",
                                   name_, group.line + 1, *unit));
      unit_mm_ = *mm;
    }
    return {};
  }

  /// Layers that are frozen, off, not plotted, or marked as construction draw nothing.
  Result<void> layer(const DxfEntity& entity) {
    const auto flags = dxf_count(entity, 70, 0, name_);
    const auto colour = dxf_count(entity, 62, 7, name_);
    const auto plotted = dxf_count(entity, 290, 1, name_);
    for (const auto* number : {&flags, &colour, &plotted})
      if (!*number) return tl::make_unexpected(number->error());
    bool construction = false;  // as LibreCAD marks it
    for (std::size_t i = 1; i < entity.groups.size(); ++i)
      construction =
          construction || (entity.groups[i - 1].value == "LibreCad" &&
                           entity.groups[i].code == 1070 && entity.groups[i].value == "1");
    if ((*flags & kFrozen) != 0 || *colour < 0 || *plotted == 0 || construction)
      ignored_.insert(name_of(entity.text(2)));
    return {};
  }

  Result<void> block(const DxfEntity& entity, DxfGroups& groups) {
    const auto x = dxf_value(entity, 10, 0.0, name_), y = dxf_value(entity, 20, 0.0, name_);
    if (!x) return tl::make_unexpected(x.error());
    if (!y) return tl::make_unexpected(y.error());
    Block block{groups, {*x, *y}};
    while (true) {
      const auto inside = take_dxf_entity(groups, name_);
      if (!inside) return tl::make_unexpected(inside.error());
      block.groups += 1 + inside->groups.size();
      if (inside->type == "ENDBLK") {
        blocks_.insert_or_assign(name_of(entity.text(2)), block);
        return {};
      }
      if (inside->type == "EOF" || inside->type == "ENDSEC")
        return failure(ErrorKind::bad_input,
                       fmt::format("{}:{}: expected the end of block {}, found {}", name_,
                                   inside->line, shown(entity.text(2)), shown(inside->type)));
    }
  }

  Result<void> entities(DxfGroups& groups, const Insertion& within, std::string_view end) {
    while (true) {
      const auto entity = take_dxf_entity(groups, name_);
      if (!entity) return tl::make_unexpected(entity.error());
      if (entity->type == end) return {};
      if (entity->type == "EOF")
        return failure(ErrorKind::bad_input,
                       fmt::format("{}:{}: expected {}, found the end of the drawing", name_,
                                   entity->line, end));
      if (auto counted = count_one(); !counted) return counted;
      if (auto done = draw(*entity, groups, within); !done) return done;
    }
  }

  /// Counts an entity or an insertion, which takes time even if its block is empty.
  Result<void> count_one() {
    if (++entities_ <= kMostEntities) return {};
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected at most {} entities and insertions, found more", name_,
                               kMostEntities));
  }

  Result<void> draw(const DxfEntity& entity, DxfGroups& groups, const Insertion& within) {
    const bool own = !entity.text(8).empty() && entity.text(8) != "0";
    const std::string written = own ? dxf_text(entity.text(8)) : within.layer;
    const Name layer = name_of(written);
    const bool visible = entity.text(60) != "1" && entity.text(67) != "1" && layer != "defpoints" &&
                         !ignored_.contains(layer);
    const bool drawn = visible && (!for_construction(layer) || layer == layer_);
    if (entity.type == "INSERT") return drawn ? insert(entity, within, written) : Result<void>();
    auto line = dxf_line(entity, groups, within.placement, limits_, name_);
    if (!line) return tl::make_unexpected(line.error());
    const bool asked = layer_.empty() || layer == layer_;
    if (drawn && asked && has_outline(entity.type)) unread_.insert(std::string(entity.type));
    if (!*line || (*line)->points_mm.size() < 2 || !visible) return {};
    seen_layers_.emplace(layer, written);
    if (drawn && asked) lines_.push_back(std::move(**line));
    return {};
  }

  /// Draws the content of a block at each place of an array of insertions.
  Result<void> insert(const DxfEntity& entity, const Insertion& within, const std::string& layer) {
    const auto found = blocks_.find(name_of(entity.text(2)));
    if (found == blocks_.end())
      return refusal(entity,
                     fmt::format("expected the name of a block of the drawing, found \"{}\"",
                                 shown(entity.text(2))));
    if (within.depth == kDeepest)
      return refusal(entity, fmt::format("expected blocks at most {} deep, found more", kDeepest));
    const auto grid = grid_of(entity);
    if (!grid) return tl::make_unexpected(grid.error());
    const auto plane = dxf_plane(entity, name_);
    if (!plane) return tl::make_unexpected(plane.error());
    const Block& block = found->second;
    groups_ += block.groups * static_cast<std::size_t>(grid->columns * grid->rows);
    if (groups_ > kMostGroups)
      return refusal(entity, fmt::format("expected blocks of at most {} groups with all "
                                         "insertions, found more",
                                         kMostGroups));
    for (long i = 0; i < grid->columns * grid->rows; ++i) {
      if (auto counted = count_one(); !counted) return counted;
      const glm::dvec2 beside{static_cast<double>(i % grid->columns) * grid->step.x,
                              static_cast<double>(i / grid->columns) * grid->step.y};
      const DxfPlacement own{grid->turn * glm::dmat2{grid->scale.x, 0.0, 0.0, grid->scale.y},
                             grid->at + grid->turn * beside};
      DxfPlacement placement = within.placement.after(*plane).after(own);
      placement.shift = placement.at(-block.base);
      DxfGroups content = block.content;
      auto done = entities(content, {placement, layer, within.depth + 1}, "ENDBLK");
      if (!done) return done;
    }
    return {};
  }

  struct Grid {
    glm::dvec2 at{0.0}, scale{1.0}, step{0.0};
    glm::dmat2 turn{1.0};
    long columns = 1, rows = 1;
  };

  Result<Grid> grid_of(const DxfEntity& entity) {
    Grid grid;
    double degrees = 0.0;
    for (const auto& [code, target] : {std::pair{10, &grid.at.x},
                                       {20, &grid.at.y},
                                       {41, &grid.scale.x},
                                       {42, &grid.scale.y},
                                       {44, &grid.step.x},
                                       {45, &grid.step.y},
                                       {50, &degrees}}) {
      const auto value = dxf_value(entity, code, *target, name_);
      if (!value) return tl::make_unexpected(value.error());
      *target = *value;
    }
    for (const auto& [code, target] : {std::pair{70, &grid.columns}, {71, &grid.rows}}) {
      const auto count = dxf_count(entity, code, 1, name_);
      if (!count) return tl::make_unexpected(count.error());
      *target = std::max(*count, 1L);
    }
    const auto most = static_cast<long>(kMostLines);
    if (grid.columns > most || grid.rows > most || grid.columns * grid.rows > most)
      return refusal(entity, fmt::format("expected at most {} insertions, found {} x {}", most,
                                         grid.columns, grid.rows));
    const double angle = degrees * std::numbers::pi / 180.0;
    grid.turn = {std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle)};
    return grid;
  }

  [[nodiscard]] tl::unexpected<Error> refusal(const DxfEntity& entity,
                                              const std::string& problem) const {
    return failure(ErrorKind::bad_input,
                   fmt::format("{}:{}: {}: {}", name_, entity.line, entity.type, problem));
  }

  const std::string& name_;
  const std::string& asked_layer_;
  const Name layer_;  ///< the only one to be drawn; empty: all
  const double scale_;
  double unit_mm_ = 1.0;
  std::set<Name> ignored_;
  std::map<Name, std::string> seen_layers_;  ///< as the file writes them
  std::set<std::string> unread_;             ///< kinds of entities
  std::map<Name, Block> blocks_;
  std::size_t entities_ = 0, groups_ = 0;  ///< as counted for their limits
  PointLimits limits_;
  std::vector<Line> lines_;
};

}  // namespace

Result<Drawing> read_dxf(std::string_view bytes, const std::string& name, const std::string& layer,
                         double scale) {
  auto groups = DxfGroups::open(bytes, name);
  if (!groups) return tl::make_unexpected(groups.error());
  return Reader(name, layer, scale).read(*groups);
}

}  // namespace clay::importing
