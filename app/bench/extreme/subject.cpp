#include "app/bench/extreme/subject.hpp"

#include "app/bench/literal/literal_paper.hpp"
#include "claystack/engine/wheel.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <utility>

namespace clay::extreme {
namespace {

template <class T>
void append_bytes(std::string& bytes, const T& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

class EngineSubject final : public Subject {
 public:
  explicit EngineSubject(Wheel wheel) : wheel_(std::move(wheel)) {}

  Tick step(const Pose& pose) override {
    const StepReport report = wheel_.step(pose);
    const auto flag = [&](StepFlag f) { return (report.flags & f) != 0; };
    return {report.force_n(), flag(kContact),   flag(kRefused), flag(kCollapsed),
            flag(kLongStep),  flag(kRingLimit), false,          false};
  }
  std::size_t rings() const override { return wheel_.stack().size(); }
  Radii ring(std::size_t i) const override {
    const Ring& ring = wheel_.stack().rings()[i];
    return {ring.outer_mm(), ring.inner_mm()};
  }
  double centre_mm(std::size_t i) const override {
    return (static_cast<double>(i) + 0.5) * wheel_.stack().ring_height_mm();
  }
  std::optional<Exact> clay() const override { return mm2_of(count_clay(wheel_)); }
  Exact allowance() const override { return 0; }

  std::string fault() const override {
    const ClayStack& stack = wheel_.stack();
    const auto rings = stack.rings();
    for (std::size_t i = 0; i < rings.size(); ++i)
      if (!(rings[i].inner2 >= 0 && rings[i].inner2 < rings[i].outer2))
        return fmt::format("ring {}: {} and {} quanta", i, rings[i].outer2, rings[i].inner2);
    if (stack.crown() < 0) return "a negative crown";
    if (stack.volume() != stack.recount()) return "the running sum differs from the sum";
    return {};
  }
  std::string bytes() const override {
    std::string bytes;
    for (const Ring& ring : wheel_.stack().rings()) {
      append_bytes(bytes, ring.outer2);
      append_bytes(bytes, ring.inner2);
    }
    append_bytes(bytes, wheel_.stack().crown());
    const Ledger& ledger = wheel_.ledger();
    for (const WideQuanta q : {ledger.initial, ledger.added, ledger.trimmed, ledger.outside})
      append_bytes(bytes, q);
    return bytes;
  }
  std::span<const std::byte> ring_bytes() const override {
    return std::as_bytes(wheel_.stack().rings());
  }
  const Wheel* wheel() const override { return &wheel_; }

 private:
  Wheel wheel_;
};

class PaperSubject final : public Subject {
 public:
  explicit PaperSubject(const bench::LiteralScene& scene) : paper_(scene) {}

  Tick step(const Pose& pose) override {
    const bench::LiteralReport report = paper_.step(pose.position_mm);
    allowance_ += 8.0 * 0x1p-53 * squares();
    Tick tick;
    tick.force_n = report.force_n;
    tick.contact = report.rings_touched > 0;
    tick.collapsed = report.collapsed;
    tick.undefined = report.undefined;
    tick.endless = report.endless;
    return tick;
  }
  std::size_t rings() const override { return paper_.rings().size(); }
  Radii ring(std::size_t i) const override {
    return {paper_.rings()[i].outer_mm, paper_.rings()[i].inner_mm};
  }
  double centre_mm(std::size_t i) const override { return paper_.rings()[i].y_mm; }

  std::optional<Exact> clay() const override {
    Exact sum = 0;
    const auto& rings = paper_.rings();
    // Runs of equal rings are summed once, because rationals are slow.
    for (std::size_t i = 0, end = 0; i < rings.size(); i = end) {
      const double outer = rings[i].outer_mm, inner = rings[i].inner_mm;
      if (!std::isfinite(outer) || !std::isfinite(inner)) return std::nullopt;
      while (end < rings.size() && rings[end].outer_mm == outer && rings[end].inner_mm == inner)
        ++end;
      sum += (square_of(outer) - square_of(inner)) * static_cast<std::uint64_t>(end - i);
    }
    return sum;
  }
  Exact allowance() const override {
    return std::isfinite(allowance_) ? Exact(allowance_) : Exact(0);
  }
  std::string fault() const override {
    const auto& rings = paper_.rings();
    for (std::size_t i = 0; i < rings.size(); ++i)
      if (!(rings[i].inner_mm >= 0.0 && rings[i].inner_mm < rings[i].outer_mm &&
            std::isfinite(rings[i].outer_mm * rings[i].outer_mm)))
        return fmt::format("ring {}: R = {:.3g}, r = {:.3g}", i, rings[i].outer_mm,
                           rings[i].inner_mm);
    return {};
  }
  std::string bytes() const override {
    std::string bytes;
    for (const bench::LiteralRing& ring : paper_.rings()) append_bytes(bytes, ring);
    return bytes;
  }
  std::span<const std::byte> ring_bytes() const override {
    return std::as_bytes(std::span(paper_.rings()));
  }
  const bench::LiteralPaper* literal() const override { return &paper_; }

 private:
  double squares() const {
    double sum = 0.0;
    for (const bench::LiteralRing& ring : paper_.rings())
      sum += ring.outer_mm * ring.outer_mm + ring.inner_mm * ring.inner_mm;
    return sum;
  }
  bench::LiteralPaper paper_;
  double allowance_ = 0.0;
};

bench::LiteralTool literal_tool(const ToolShapeSpec& shape) {
  if (const auto* ellipse = std::get_if<EllipseSpec>(&shape))
    return bench::LiteralEllipse{ellipse->half_height_mm, ellipse->half_width_mm};
  if (const auto* rib = std::get_if<RibSpec>(&shape))
    return bench::LiteralRib{rib->height_mm, rib->radius_mm};
  const double radius = std::get<SphereSpec>(shape).radius_mm;
  return bench::LiteralEllipse{radius, radius};
}

bench::LiteralScene literal_scene(const SceneSpec& scene) {
  bench::LiteralScene s;
  s.rings = scene.lump.rings;
  s.ring_height_mm = scene.lump.ring_height_mm;
  s.outer_radius_mm = scene.lump.outer_radius_mm;
  s.inner_radius_mm = scene.lump.inner_radius_mm;
  s.tool = literal_tool(scene.tool.shape);
  s.removal_fraction = scene.removal.paper_fraction.value_or(scene.removal.rate_per_s / 1000.0);
  s.inside_share = scene.flow.inside_share;
  s.sigma_mm = scene.flow.sigma_mm;
  s.kernel_rings = static_cast<std::size_t>(scene.flow.reach_mm / scene.lump.ring_height_mm + 0.5);
  s.density_g_cm3 = scene.lump.density_g_cm3;
  s.growth_limit = 20'000 + 4 * scene.lump.rings;
  if (scene.force) {
    s.stiffness_n_per_mm = scene.force->paper_stiffness_n_per_mm.value_or(0.05);
    s.friction = scene.force->friction;
  }
  // kPa = 1e-3 N/mm^2; without g a mass per area.
  if (scene.stability)
    s.max_stress_kg_per_mm2 = scene.stability->max_stress_kpa * 1e-3 / kStandardGravity;
  return s;
}

}  // namespace

Result<std::unique_ptr<Subject>> make_subject(Model model, const SceneSpec& scene) {
  if (model == Model::literal) return std::make_unique<PaperSubject>(literal_scene(scene));
  auto wheel = Wheel::build(scene);
  if (!wheel) return tl::make_unexpected(wheel.error());
  return std::make_unique<EngineSubject>(std::move(*wheel));
}

Count count_clay(const Wheel& wheel) {
  Count sum = count_of(wheel.stack().crown()) + count_of(wheel.ledger().trimmed) +
              count_of(wheel.ledger().outside) - count_of(wheel.ledger().added);
  const auto rings = wheel.stack().rings();
  for (std::size_t i = 0, end = 0; i < rings.size(); i = end) {
    while (end < rings.size() && rings[end] == rings[i]) ++end;
    sum += (Count(rings[i].outer2) - rings[i].inner2) * static_cast<std::uint64_t>(end - i);
  }
  return sum;
}

}  // namespace clay::extreme
