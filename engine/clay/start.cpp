#include "engine/clay/start.hpp"

#include "core/text.hpp"

#include <string>

namespace clay {

Result<void> check_start(const SceneSpec& scene, const Pot& start) {
  const auto refused = [](const std::string& setting, const std::string& expected,
                          const std::string& found) {
    return failure(ErrorKind::bad_input, setting + ": expected " + expected + ", found " + found);
  };
  const auto name = [](Model model) { return model == Model::paper ? "paper" : "conserving"; };
  if (start.collapse) return refused("pot", "a standing pot", "a collapsed one");
  if (start.rounding)
    return refused("pot", "an exact one",
                   "one rounded to " + number_text(start.rounding->to_mm) +
                       " mm: its clay is not the clay that was counted");
  if (start.model != scene.model)
    return refused("model", std::string("the pot's, ") + name(start.model), name(scene.model));
  if (start.density_g_cm3 != scene.lump.density_g_cm3)
    return refused("lump.density_g_cm3", "the pot's, " + number_text(start.density_g_cm3),
                   number_text(scene.lump.density_g_cm3));
  const std::size_t most = scene.lump.max_rings, rings = start.stack.size();
  if (most != 0 && most < rings)
    return refused("lump.max_rings", "0 or at least the pot's rings, " + std::to_string(rings),
                   std::to_string(most));
  return {};
}

}  // namespace clay
