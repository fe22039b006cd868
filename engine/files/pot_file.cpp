#include "claystack/engine/files.hpp"

#include "core/json/json_text.hpp"
#include "core/json/object_reader.hpp"
#include "core/json/object_writer.hpp"
#include "core/text.hpp"
#include "engine/clay/radius_grid.hpp"
#include "engine/files/pot_json.hpp"
#include "engine/files/ring_arrays.hpp"
#include "engine/files/scene_json.hpp"
#include "engine/files/scene_tables.hpp"
#include "engine/files/text_codes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace clay {

using namespace files;

// In this namespace, where the writer and the reader look up the tables of their types.
static void describe(auto& io, Is<Ledger> auto& ledger) {
  io.require({"initial", "added", "trimmed", "outside"});
  io.template coded<DecimalCode>("initial", ledger.initial);
  io.template coded<DecimalCode>("added", ledger.added);
  io.template coded<DecimalCode>("trimmed", ledger.trimmed);
  io.template coded<DecimalCode>("outside", ledger.outside);
}

static void describe(auto& io, Is<Rim> auto& rim) {
  io.require({"outside", "inside"});
  io.template coded<SignedDecimalCode>("outside", rim.outside);
  io.template coded<SignedDecimalCode>("inside", rim.inside);
}

static void describe(auto& io, Is<Motion> auto& motion) {
  io.require({"upward_mm_s", "outward_mm_s"});
  io.number("upward_mm_s", motion.upward_mm_s, from(-1e12).to(1e12));
  io.number("outward_mm_s", motion.outward_mm_s, from(-1e12).to(1e12));
}

constexpr double kFullTurn = 2.0 * std::numbers::pi;
// Above the stress of 5 m of clay on one quantum, and of its energy on the most rings.
const auto kStressKpa = from(0).to(1e30), kEnergyMj = from(0).to(1e30);

static void describe(auto& io, Is<Collapse> auto& collapse) {
  io.require({"failed_ring", "pivot_mm", "axis", "angle_rad", "stress_kpa"});
  io.integer("failed_ring", collapse.failed_ring, 0, kMaxRings - 1);
  const auto kPlaceMm = from(-Collapse::kMostMm).to(Collapse::kMostMm);
  io.vector("pivot_mm", collapse.pivot_mm, kPlaceMm);
  io.vector("axis", collapse.axis, from(-1).to(1));
  io.number("angle_rad", collapse.angle_rad, from(-kFullTurn).to(kFullTurn));
  io.number("stress_kpa", collapse.stress_kpa, kStressKpa);
  // Files from before settling was modelled have no shift: the collapse was a rotation only.
  io.vector("shift_mm", collapse.shift_mm, kPlaceMm);
  io.number("threshold_kpa", collapse.threshold_kpa, kStressKpa);
  io.number("energy_lost_mj", collapse.energy_lost_mj, kEnergyMj);
  io.number("plastic_work_mj", collapse.plastic_work_mj, kEnergyMj);
  io.check([&](ObjectReader& reader) {
    reader.expect(collapse.has_valid_axis(), "axis", "a horizontal axis of length 1");
  });
}

namespace {

/// A pot in the form of its file.
struct PotRecord {
  Model model = Model::conserving;
  double density_g_cm3 = 0.0;
  double ring_height_mm = 0.0;
  std::size_t max_rings = 0;
  std::optional<RingArrays> rings;  ///< either these or the rounded ones
  std::optional<RoundedRingArrays> rounded_rings;
  WideQuanta crown = 0;
  Ledger ledger;
  std::optional<Rim> rim;
  std::optional<Motion> motion;
  std::optional<ThrowSettings> thrown_with;
  std::optional<ToolSpec> shaped_with;
  std::optional<Collapse> collapse;

  [[nodiscard]] std::size_t size() const {
    return rings ? rings->outer2.size() : rounded_rings->outer_differences.size();
  }
};

void describe(auto& io, Is<PotRecord> auto& pot) {
  io.require({"schema", "written_by", "model", "density_g_cm3", "ring_height_mm", "max_rings",
              "quantum_mm2", "crown", "ledger", "collapse"});
  io.constant("schema", "claystack-pot-1");
  io.written_by();
  io.choice("model", pot.model, kModelNames);
  io.number("density_g_cm3", pot.density_g_cm3, ranges::kDensity);
  io.number("ring_height_mm", pot.ring_height_mm, ranges::kRingHeightMm);
  io.integer("max_rings", pot.max_rings, 1, kMaxRings);
  io.constant("quantum_mm2", "2^-36");
  io.part("rings", pot.rings);
  io.part("rounded_rings", pot.rounded_rings);
  io.template coded<DecimalCode>("crown", pot.crown);
  io.part("ledger", pot.ledger);
  io.part("rim", pot.rim);
  io.part("motion", pot.motion);
  io.part("thrown_with", pot.thrown_with);
  io.part("shaped_with", pot.shaped_with);
  io.part_or_null("collapse", pot.collapse);
  io.check([&](ObjectReader& reader) {
    if (!pot.rings && !pot.rounded_rings) return reader.require({"rings"});
    reader.expect(!pot.rings || !pot.rounded_rings, "rounded_rings", "either these or rings");
    const std::size_t count = pot.size();
    reader.expect(pot.max_rings >= count, "max_rings",
                  "at least the number of rings, " + std::to_string(count));
  });
}

/// The grid of the radii; empty if the pot is not rounded, or does not match its stated rounding.
std::optional<RadiusGrid> grid_of(const Pot& pot) {
  if (!pot.rounding) return std::nullopt;
  const auto grid = RadiusGrid::of(pot.rounding->to_mm);
  const bool on_grid = grid && std::ranges::all_of(pot.stack.rings(), [&](const Ring& ring) {
                         return grid->holds(ring.outer2) && grid->holds(ring.inner2);
                       });
  return on_grid ? grid : std::nullopt;
}

PotRecord record_of(const Pot& pot, bool for_people) {
  PotRecord record{.model = pot.model,
                   .density_g_cm3 = pot.density_g_cm3,
                   .ring_height_mm = pot.stack.ring_height_mm(),
                   .max_rings = pot.stack.max_rings(),
                   .rings = ring_arrays(pot.stack, for_people),
                   .rounded_rings = {},
                   .crown = pot.stack.crown(),
                   .ledger = pot.ledger,
                   .rim = pot.rim == Rim{} ? std::nullopt : std::optional(pot.rim),
                   .motion = pot.motion == Motion{} ? std::nullopt : std::optional(pot.motion),
                   .thrown_with = pot.thrown_with,
                   .shaped_with = pot.shaped_with,
                   .collapse = pot.collapse};
  if (const auto grid = grid_of(pot)) {
    record.rounded_rings = rounded_ring_arrays(*record.rings, *pot.rounding, *grid);
    record.rings.reset();
  }
  return record;
}

Result<Pot> pot_from(const LocatedJson& document, const PotRecord& record) {
  const auto& rounded = record.rounded_rings;
  RingArrays exact;
  if (rounded) exact = exact_rings(*rounded, *RadiusGrid::of(rounded->rounded_to_mm));
  const RingArrays& arrays = rounded ? exact : *record.rings;
  const std::size_t count = arrays.outer2.size();
  if (record.collapse && record.collapse->failed_ring >= count)
    return tl::make_unexpected(document.field_error(
        {"collapse", "failed_ring"}, "expected a ring below their number, " +
                                         std::to_string(count) + ", found " +
                                         std::to_string(record.collapse->failed_ring)));
  std::vector<Ring> rings(count);
  for (std::size_t i = 0; i < rings.size(); ++i) rings[i] = {arrays.outer2[i], arrays.inner2[i]};
  auto stack = ClayStack::from_rings(record.ring_height_mm, std::move(rings), record.crown,
                                     record.max_rings);
  if (!stack) return tl::make_unexpected(document.field_error({"rings"}, stack.error().message));
  if (const WideQuanta imbalance = record.ledger.imbalance(stack->recount()); imbalance != 0)
    return tl::make_unexpected(document.field_error(
        {"ledger"}, "expected every quantum accounted for, found " +
                        to_string(imbalance < 0 ? -imbalance : imbalance) +
                        (imbalance < 0 ? " too few" : " too many") +
                        " (in the stack, trimmed and outside, less initial and added)"));
  Pot pot{std::move(*stack),
          record.ledger,
          record.model,
          record.density_g_cm3,
          record.collapse,
          std::nullopt,
          record.rim.value_or(Rim{}),
          record.motion.value_or(Motion{}),
          record.thrown_with,
          record.shaped_with};
  if (rounded) pot.rounding = {rounded->rounded_to_mm, rounded->exact_volume};
  return pot;
}

/// A CBOR map, which no JSON text can start with.
bool is_cbor(std::string_view bytes) {
  return !bytes.empty() && static_cast<unsigned char>(bytes.front()) >> 5 == 5;
}

}  // namespace

Json files::pot_json(const Pot& pot, bool for_people) {
  return ObjectWriter::write(record_of(pot, for_people));
}

Result<Pot> files::pot_of(const LocatedJson& document) {
  return ObjectReader::read(document, PotRecord{}).and_then([&](const PotRecord& record) {
    return pot_from(document, record);
  });
}

Result<Pot> parse_pot(std::string_view bytes, std::string_view name) {
  const auto parse =
      is_cbor(bytes) ? LocatedJson::from_cbor
                     : [](std::string_view text, std::string_view file, std::size_t max_values) {
                         return LocatedJson::from_json(text, file, max_values);
                       };
  return parse(bytes, name, kMaxPotValues)
      .and_then([](const LocatedJson& document) { return files::pot_of(document); })
      .map_error([&](Error error) {
        return kind_error(std::move(error), bytes, name, "a pot (.pot.json, .pot.cbor)");
      });
}

std::string write_pot(const Pot& pot, PotEncoding encoding) {
  const Json file = pot_json(pot, encoding == PotEncoding::json);
  if (encoding == PotEncoding::json) return json_text(file);
  std::string bytes;
  Json::to_cbor(file, bytes);
  return bytes;
}

}  // namespace clay
