#pragma once
// The view model: the state of the window in one frame, all of it const. Panels, the scene view and
// commands read it.

#include "app/history/recovery.hpp"
#include "app/studio/document.hpp"
#include "app/studio/guide/guide.hpp"
#include "app/studio/readings/readings.hpp"
#include "app/studio/settings.hpp"
#include "app/studio/stroke_controller.hpp"
#include "app/studio/ui_state.hpp"

#include <optional>
#include <string>
#include <vector>

namespace clay::studio {

class SceneView;

struct ViewModel {
  const Settings& settings;
  const Document& document;
  const StrokeController& stroke;
  const Readings& readings;
  const Guide& guide;
  const SceneView& scene;
  const UiState& ui;
  const std::vector<history::Recoverable>&
      recoverable;  ///< works of crashed programs, newest first
  std::optional<Exporter::Kind> export_running;
  std::string export_stage;  ///< of the running export
  bool picture_running = false;
  float picture_progress = 0.0f;  ///< the part of it that is done
  double now_s = 0.0;             ///< on the host's clock
  bool real_time = false;         ///< false in scripts: no figure may depend on the machine
  bool fingers = false;           ///< as Host::fingers

  [[nodiscard]] const Palette& colours() const { return palette(settings.theme); }
  [[nodiscard]] bool at_rest() const { return document.has_work() && !stroke.throwing(); }
  /// True if there is no stroke, or a stroke of a device, which may be ended at any time.
  [[nodiscard]] bool between_strokes() const { return at_rest() || stroke.has_device(); }
  /// The mouse or the gamepad leads the tool through the view, which must stand still meanwhile:
  /// from another viewpoint, the pointer would be at another place of the section plane, and pull
  /// the tool there.
  [[nodiscard]] bool view_is_held() const {
    return stroke.by_hand() && guide.demonstration() == Demonstration::none;
  }
  /// The tool of the stroke in progress; otherwise the one of the settings, which the next stroke
  /// takes.
  [[nodiscard]] ToolSpec tool_in_use() const {
    return stroke.throwing() ? document.scene().tool : tool_of(settings.tool);
  }
  /// The pot stands on its rim while its foot is trimmed; a fallen one stays where it lies.
  [[nodiscard]] bool upside_down() const {
    return tool_in_use().mode == ToolMode::trim_foot && !stroke.view().fallen;
  }
  [[nodiscard]] bool writing() const { return export_running == Exporter::Kind::files; }
  /// Problems of the last export or preview, if they belong to the pot on screen.
  [[nodiscard]] bool has_marks() const;
  /// The device that moves the tool.
  [[nodiscard]] std::string device_name() const {
    return fingers && !stroke.has_device() ? "Touch screen" : stroke.device_name();
  }
  /// State and requests of an arm in use; empty without motors.
  [[nodiscard]] std::string arm_text() const;
  /// The guard holds the force at zero until it is re-armed.
  [[nodiscard]] bool waits_for_rearm() const;
};

}  // namespace clay::studio
