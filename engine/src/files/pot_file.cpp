#include "claystack/engine/pot_file.hpp"

#include "files/json_text.hpp"
#include "files/object_reader.hpp"
#include "files/object_writer.hpp"
#include "files/scene_json.hpp"
#include "files/text_codes.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace clay {

using namespace files;

// In this namespace, where the writer and the reader look for the tables of its types.
static void describe(auto& io, Is<Ledger> auto& ledger) {
  io.require({"initial", "added", "trimmed", "outside"});
  io.template coded<DecimalCode>("initial", ledger.initial);
  io.template coded<DecimalCode>("added", ledger.added);
  io.template coded<DecimalCode>("trimmed", ledger.trimmed);
  io.template coded<DecimalCode>("outside", ledger.outside);
}

static void describe(auto& io, Is<Collapse> auto& collapse) {
  io.require({"failed_ring", "pivot_mm", "axis", "angle_rad", "stress_kpa"});
  io.integer("failed_ring", collapse.failed_ring, 0, kMaxRings - 1);
  io.vector("pivot_mm", collapse.pivot_mm, from(-1e6).to(1e6));
  io.vector("axis", collapse.axis, from(-1).to(1));
  io.number("angle_rad", collapse.angle_rad, from(0).to(std::numbers::pi));
  io.number("stress_kpa", collapse.stress_kpa, from(0).to(std::numeric_limits<double>::max()));
  io.check([&](ObjectReader& reader) {
    const glm::dvec3& axis = collapse.axis;
    reader.expect(axis.y == 0.0 && std::abs(axis.x * axis.x + axis.z * axis.z - 1.0) < 1e-9, "axis",
                  "a horizontal axis of length 1");
  });
}

namespace {

/// Four numbers a ring, and the rest.
constexpr std::size_t kMaxValues = 4 * kMaxRings + 1000;
constexpr double kRadiusToleranceMm = 1e-5;

struct RingArrays {
  std::vector<Quanta> outer2, inner2;
  std::optional<std::vector<double>> outer_mm, inner_mm;  ///< for people: JSON only
};

/// A pot as its file holds it.
struct PotRecord {
  Model model = Model::conserving;
  double density_g_cm3 = 0.0;
  double ring_height_mm = 0.0;
  std::size_t max_rings = 0;
  RingArrays rings;
  WideQuanta crown = 0;
  Ledger ledger;
  std::optional<Collapse> collapse;
};

void expect_radii(ObjectReader& reader, std::string_view name, const std::vector<Quanta>& squares,
                  const std::optional<std::vector<double>>& radii_mm) {
  if (!radii_mm) return;
  reader.expect(radii_mm->size() == squares.size(), name,
                "one radius for each of " + std::to_string(squares.size()) + " rings");
  for (std::size_t i = 0; i < std::min(radii_mm->size(), squares.size()); ++i) {
    const double counted_mm = radius_from_quanta(squares[i]);
    if (std::abs((*radii_mm)[i] - counted_mm) > kRadiusToleranceMm)
      return reader.expect_element(false, name, i,
                                   "the radius that the count of ring " + std::to_string(i) +
                                       " gives, " + shortest(counted_mm) + " mm");
  }
}

void describe(auto& io, Is<RingArrays> auto& rings) {
  const Quanta smallest = quanta_from_radius(kMinRadiusMm);
  const Quanta largest = quanta_from_radius(kMaxRadiusMm);
  io.require({"outer2", "inner2"});
  io.integers("outer2", rings.outer2, smallest, largest);
  io.integers("inner2", rings.inner2, 0, largest);
  io.numbers("outer_mm", rings.outer_mm, from(0).to(kMaxRadiusMm));
  io.numbers("inner_mm", rings.inner_mm, from(0).to(kMaxRadiusMm));
  io.check([&](ObjectReader& reader) {
    const std::size_t count = rings.outer2.size();
    reader.expect(count >= 1 && count <= kMaxRings, "outer2",
                  "1 to " + std::to_string(kMaxRings) + " rings");
    reader.expect(rings.inner2.size() == count, "inner2",
                  "one count for each of " + std::to_string(count) + " rings");
    for (std::size_t i = 0; i < std::min(count, rings.inner2.size()); ++i)
      reader.expect_element(rings.inner2[i] < rings.outer2[i], "inner2", i,
                            "less than the outer count of the ring");
    expect_radii(reader, "outer_mm", rings.outer2, rings.outer_mm);
    expect_radii(reader, "inner_mm", rings.inner2, rings.inner_mm);
  });
}

void describe(auto& io, Is<PotRecord> auto& pot) {
  io.require({"schema", "written_by", "model", "density_g_cm3", "ring_height_mm", "max_rings",
              "quantum_mm2", "rings", "crown", "ledger", "collapse"});
  io.constant("schema", "claystack-pot-1");
  io.written_by();
  io.choice("model", pot.model, kModelNames);
  io.number("density_g_cm3", pot.density_g_cm3, kDensity);
  io.number("ring_height_mm", pot.ring_height_mm, kRingHeightMm);
  io.integer("max_rings", pot.max_rings, 1, kMaxRings);
  io.constant("quantum_mm2", "2^-36");
  io.part("rings", pot.rings);
  io.template coded<DecimalCode>("crown", pot.crown);
  io.part("ledger", pot.ledger);
  io.part_or_null("collapse", pot.collapse);
  io.check([&](ObjectReader& reader) {
    const std::size_t count = pot.rings.outer2.size();
    reader.expect(pot.max_rings >= count, "max_rings",
                  "at least the number of rings, " + std::to_string(count));
    reader.expect(!pot.collapse || pot.collapse->failed_ring < count, "collapse",
                  "a failed_ring below the number of rings, " + std::to_string(count));
  });
}

/// What people see: millionths of a mm.
std::vector<double> radii_mm(const std::vector<Quanta>& squares) {
  std::vector<double> radii;
  radii.reserve(squares.size());
  for (const Quanta square : squares)
    radii.push_back(std::round(radius_from_quanta(square) * 1e6) / 1e6);
  return radii;
}

PotRecord record_of(const Pot& pot) {
  PotRecord record{pot.model,
                   pot.density_g_cm3,
                   pot.stack.ring_height_mm(),
                   pot.stack.max_rings(),
                   {},
                   pot.stack.crown(),
                   pot.ledger,
                   pot.collapse};
  for (const Ring& ring : pot.stack.rings()) {
    record.rings.outer2.push_back(ring.outer2);
    record.rings.inner2.push_back(ring.inner2);
  }
  return record;
}

Result<Pot> pot_of(const LocatedJson& document, const PotRecord& record) {
  std::vector<Ring> rings(record.rings.outer2.size());
  for (std::size_t i = 0; i < rings.size(); ++i)
    rings[i] = {record.rings.outer2[i], record.rings.inner2[i]};
  auto stack = ClayStack::from_rings(record.ring_height_mm, std::move(rings), record.crown,
                                     record.max_rings);
  if (!stack) return tl::make_unexpected(document.field_error({"rings"}, stack.error().message));
  if (const WideQuanta imbalance = record.ledger.imbalance(stack->recount()); imbalance != 0)
    return tl::make_unexpected(document.field_error(
        {"ledger"}, "expected every quantum accounted for, found " + to_string(imbalance) +
                        " too many (in the stack, trimmed and outside, less initial and added)"));
  return Pot{std::move(*stack), record.ledger, record.model, record.density_g_cm3, record.collapse};
}

/// A CBOR map, which no JSON text can start with.
bool is_cbor(std::string_view bytes) {
  return !bytes.empty() && static_cast<unsigned char>(bytes.front()) >> 5 == 5;
}

}  // namespace

Result<Pot> parse_pot(std::string_view bytes, std::string_view name) {
  const auto parse =
      is_cbor(bytes) ? LocatedJson::from_cbor
                     : [](std::string_view text, std::string_view file, std::size_t max_values) {
                         return LocatedJson::from_json(text, file, max_values);
                       };
  return parse(bytes, name, kMaxValues).and_then([](const LocatedJson& document) {
    return ObjectReader::read(document, PotRecord{}).and_then([&](const PotRecord& record) {
      return pot_of(document, record);
    });
  });
}

std::string write_pot(const Pot& pot, PotEncoding encoding) {
  PotRecord record = record_of(pot);
  if (encoding == PotEncoding::cbor) {
    std::string bytes;
    Json::to_cbor(ObjectWriter::write(record), bytes);
    return bytes;
  }
  record.rings.outer_mm = radii_mm(record.rings.outer2);
  record.rings.inner_mm = radii_mm(record.rings.inner2);
  return json_text(ObjectWriter::write(record));
}

}  // namespace clay
