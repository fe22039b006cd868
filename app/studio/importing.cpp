#include "app/studio/importing.hpp"

#include "app/render/pot_view.hpp"
#include "core/text.hpp"

#ifdef CLAYSTACK_DRAWINGS
#include "app/import/drawn_pot.hpp"
#endif

#include <algorithm>
#include <array>
#include <utility>

namespace clay::studio {

#ifdef CLAYSTACK_DRAWINGS

bool is_drawing(const std::filesystem::path& path) {
  constexpr std::array kEndings = {".svg", ".dxf", ".csv"};
  return std::ranges::any_of(kEndings, [name = path.filename().string()](const char* ending) {
    return ends_ignoring_case(name, ending);
  });
}

Result<Imported> import_drawing(const std::string& bytes, const std::string& name,
                                const ImportSettings& settings) {
  constexpr std::array kRules = {importing::AxisRule::by_itself, importing::AxisRule::left,
                                 importing::AxisRule::middle, importing::AxisRule::right,
                                 importing::AxisRule::at};
  const auto asked = [](double mm) { return mm > 0.0 ? std::optional(mm) : std::nullopt; };
  const importing::HalfSectionSettings how{kRules[static_cast<std::size_t>(settings.axis)],
                                           settings.axis_mm, asked(settings.height_mm)};
  importing::DrawnPotSettings pot_settings;
  pot_settings.wall_mm = asked(settings.wall_mm);
  const auto section = importing::read_half_section(bytes, name, {}, how);
  if (!section) return tl::make_unexpected(section.error());
  return importing::drawn_pot(*section, pot_settings, name).map([&](importing::DrawnPot&& drawn) {
    return Imported{std::move(drawn.pot), section->volume_mm3(), section->axis_mm, section->notes};
  });
}

#else

bool is_drawing(const std::filesystem::path&) { return false; }

Result<Imported> import_drawing(const std::string&, const std::string& name,
                                const ImportSettings&) {
  return failure(ErrorKind::bad_input, name + ": this build reads no drawings");
}

#endif

void reload(ImportCard& card) {
  auto made = import_drawing(card.bytes, card.path.string(), card.settings);
  card.made.reset();
  card.view = {};
  card.problem.clear();
  if (!made) {
    card.problem = made.error().message;
    return;
  }
  card.view = render::view_of(made->pot);
  card.made.emplace(std::move(*made));
}

}  // namespace clay::studio
