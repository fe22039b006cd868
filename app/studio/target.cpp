#include "app/studio/target.hpp"

#include "app/cli/pot_input.hpp"
#include "app/history/work.hpp"
#ifdef CLAYSTACK_DRAWINGS
#include "app/import/deviation.hpp"
#endif
#include "app/render/pot_view.hpp"
#include "app/studio/importing.hpp"
#include "app/studio/samples.hpp"
#include "claystack/core/atomic_file.hpp"

#include <algorithm>

namespace clay::studio {
namespace {

SharedTarget target_of(std::string name, const Pot& pot) {
  return std::make_shared<const Target>(Target{std::move(name), render::view_of(pot)});
}

Result<Pot> pot_in(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (is_drawing(path))
    return read_file(path)
        .and_then([&](const std::string& bytes) { return import_drawing(bytes, name, {}); })
        .map([](Imported&& made) { return std::move(made.pot); });
  if (!name.ends_with(".work")) return cli::read_pot(name);
  return history::load(name).and_then([](history::Loaded&& loaded) -> Result<Pot> {
    return loaded.work.pot().map([](const history::SharedPot& pot) { return *pot; });
  });
}

}  // namespace

Result<SharedTarget> read_target(const std::filesystem::path& path) {
  return pot_in(path).and_then([&](const Pot& pot) -> Result<SharedTarget> {
    if (pot.collapse)
      return failure(ErrorKind::bad_input,
                     path.string() + ": expected a standing pot as the target, found a fallen one");
    return target_of(path.filename().string(), pot);
  });
}

Result<SharedTarget> sample_target(std::size_t sample) {
  const Sample& chosen = samples().at(sample);
  return finished_pot(chosen).map([&](const Pot& pot) { return target_of(chosen.title, pot); });
}

#ifdef CLAYSTACK_DRAWINGS

namespace {

std::vector<importing::Slab> slabs_of(const render::PotView& pot) {
  std::vector<importing::Slab> slabs;
  slabs.reserve(pot.rows.size());
  const double row_mm = pot.height_mm / static_cast<double>(pot.rows.size());
  for (const render::Row& row : pot.rows) {
    const double from_mm = row_mm * static_cast<double>(slabs.size());
    const double outer = static_cast<double>(row.outer_mm),
                 inner = static_cast<double>(row.inner_mm);
    slabs.push_back({from_mm, from_mm + row_mm, outer, outer, inner, inner});
  }
  return slabs;
}

}  // namespace

std::optional<OffTarget> off_target(const render::PotView& pot, const render::PotView& target) {
  if (pot.rows.empty() || target.rows.empty()) return std::nullopt;
  const auto outline = importing::outline_of(slabs_of(target));
  const auto own = importing::outline_of(slabs_of(pot));
  const importing::Deviation worst = importing::deviation_between(own, outline);
  std::vector<glm::dvec2> points;
  points.reserve(2 * pot.rows.size());
  const double row_mm = pot.height_mm / static_cast<double>(pot.rows.size());
  for (std::size_t i = 0; i < pot.rows.size(); ++i) {
    const double y_mm = row_mm * (static_cast<double>(i) + 0.5);
    const double outer = static_cast<double>(pot.rows[i].outer_mm);
    const double inner = static_cast<double>(pot.rows[i].inner_mm);
    points.emplace_back(outer, y_mm);
    points.emplace_back(inner > 0.0 ? inner : outer, y_mm);  // solid: there is no inner wall
  }
  const std::vector<double> distances = importing::distances_from(outline, points);
  OffTarget off{worst.mm, worst.radius_mm, worst.height_mm, {}};
  off.rows_mm.reserve(pot.rows.size());
  for (std::size_t i = 0; i < pot.rows.size(); ++i)
    off.rows_mm.push_back(static_cast<float>(std::max(distances[2 * i], distances[2 * i + 1])));
  return off;
}

#else

std::optional<OffTarget> off_target(const render::PotView&, const render::PotView&) {
  return std::nullopt;
}

#endif

}  // namespace clay::studio
