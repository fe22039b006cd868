#include "app/studio/samples.hpp"

#include "app/render/pot_view.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"

#include <algorithm>

// Generated from the files of samples/ by the build.
namespace clay::studio::embedded {
extern const std::string_view bowl_scene_json, bowl_session, bowl_strokes_json;
extern const std::string_view vase_scene_json, vase_session, vase_strokes_json;
extern const std::string_view bottle_scene_json, bottle_session, bottle_strokes_json;
extern const std::string_view cylinder_scene_json, cylinder_session, cylinder_strokes_json;
}  // namespace clay::studio::embedded

namespace clay::studio {

const std::array<Sample, 4>& samples() {
  static const std::array<Sample, 4> all = {
      Sample{"bowl", "Bowl", "Open wide, and keep the floor", embedded::bowl_scene_json,
             embedded::bowl_session, embedded::bowl_strokes_json},
      Sample{"vase", "Vase", "A belly, a shoulder and a narrow neck", embedded::vase_scene_json,
             embedded::vase_session, embedded::vase_strokes_json},
      Sample{"bottle", "Bottle", "Collar a neck over a full body", embedded::bottle_scene_json,
             embedded::bottle_session, embedded::bottle_strokes_json},
      Sample{"cylinder", "Cylinder", "Pull a wall between two hands", embedded::cylinder_scene_json,
             embedded::cylinder_session, embedded::cylinder_strokes_json}};
  return all;
}

Result<SceneSpec> scene_of(const Sample& sample) {
  return parse_scene(sample.scene_text, sample.name);
}

Result<Pot> finished_pot(const Sample& sample) {
  const auto scene = scene_of(sample);
  if (!scene) return tl::make_unexpected(scene.error());
  const auto session = parse_session(sample.session_text, sample.name);
  if (!session) return tl::make_unexpected(session.error());
  auto wheel = Wheel::build(*scene);
  if (!wheel) return tl::make_unexpected(wheel.error());
  for (const Pose& pose : session->poses) wheel->step(pose);
  return wheel->pot();
}

Result<render::PotView> finished(const Sample& sample) {
  return finished_pot(sample).map([](const Pot& pot) { return render::view_of(pot); });
}

}  // namespace clay::studio
