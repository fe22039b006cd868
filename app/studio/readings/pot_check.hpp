#pragma once
// The export's verdict on a pot: proved or not, with places and reasons, and its wall thickness.
// Plain values that any thread can compute; all figures are those of solid::run_export.

#include "app/history/work.hpp"
#include "app/render/picture.hpp"
#include "app/studio/readings/off_target.hpp"
#include "app/studio/readings/pot_form.hpp"
#include "app/studio/settings.hpp"
#include "app/studio/target.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/job.hpp"
#include "claystack/export/walls.hpp"

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace clay::studio {

/// The clay that the panels describe: the exact pot at rest, or its outline during a stroke.
struct Subject {
  history::SharedPot pot;   ///< at rest; null during a stroke
  render::PotView outline;  ///< outline as shown on screen
  double density_g_cm3 = 1.9;
  double crown_mm = 0.0;  ///< height of the crown above the rows of the outline
  [[nodiscard]] bool live() const noexcept { return pot == nullptr; }
};

struct PotQuestion {
  Subject subject;
  std::string process;  ///< name or file, as for solid::read_process; empty: none
  double tolerance_mm = 0.02;
  SharedTarget target = nullptr;  ///< null: none
  double shrinkage = 0.0;         ///< fraction of each length, for `PotCheck::maker`
};

struct Stretch {
  double from_mm = 0.0, to_mm = 0.0;
  friend bool operator==(const Stretch&, const Stretch&) = default;
};

/// A remark about the pot between two heights [mm].
struct PotRemark {
  double from_mm = 0.0, to_mm = 0.0;
  std::string text;
};

enum class Verdict {
  ready,
  doubtful,  ///< one closed solid, with problems that the export only warns about, or no vessel
  lump,      ///< solid clay without a problem: no pot yet
  not_ready,
};

struct PotCheck {
  bool live = false;     ///< made from the outline during a stroke
  bool stopped = false;  ///< the check could not be finished: nothing is known
  bool proved = false;
  std::string why_not;
  std::optional<double> fault_mm;  ///< height of the fault, where it has one
  std::vector<PotRemark> remarks;  ///< steps that smoothing kept, closed cavities
  bool fallen = false;             ///< proved by the exact test of its triangles; walls are unknown
  std::size_t triangles = 0;
  double tolerance_mm = 0.0;
  double counted_mm3 = 0.0, proved_mm3 = 0.0, volume_error_relative = 0.0;
  double least_wall_mm = 0.0;  ///< proved lower bound of the wall
  PotForm form;                ///< of a standing pot
  double thinnest_mm = 0.0;    ///< thinnest place of the section, between two points (rho, y) [mm]
  glm::dvec2 thinnest_from{0.0}, thinnest_to{0.0};  ///< rho is negative beyond the axis
  bool thinnest_in_floor = false;
  std::optional<solid::WallLimit> limit;
  std::vector<solid::Problem> problems;  ///< as for `claystack export` with the same process
  std::vector<render::RowWall> walls;    ///< one for each equal part of `height_mm`; empty: unknown
  double height_mm = 0.0;
  std::optional<solid::MakerNumbers> maker;  ///< of a standing pot that is proved
  std::optional<OffTarget> off;              ///< from the target of the question
  double seconds = 0.0;                      ///< run time of the check

  /// One solid without a problem that fails.
  [[nodiscard]] bool ready() const;
  [[nodiscard]] Verdict verdict() const;
  [[nodiscard]] bool thin() const {
    return limit && proved && !fallen && !limit->met_by(thinnest_mm);
  }
};

[[nodiscard]] std::vector<std::string> process_names();
using solid::process_title;

/// `cancelled` as in ExportOptions::cancelled. The result of a cancelled check is meaningless.
[[nodiscard]] PotCheck check_pot(const PotQuestion& question,
                                 const std::function<bool()>& cancelled = {});

/// The wall across the clay at this height [mm]; empty: unknown.
[[nodiscard]] std::optional<double> wall_mm_at(const PotCheck& check, double y_mm);

/// Walls resampled by height for an outline of `rows` rows and a height of `height_mm`.
[[nodiscard]] std::vector<render::RowWall> walls_for(const PotCheck& check, std::size_t rows,
                                                     double height_mm);

/// Colours cover 0 to 5, 10, 20, 50 or 100 mm, fitted to the pot; walls below the limit of the
/// process are hatched.
[[nodiscard]] render::WallMap wall_map_of(const PotCheck& check);

/// Heights at which walls are thinner than the process requires [mm], bottom to top.
[[nodiscard]] std::vector<Stretch> thin_stretches(const PotCheck& check);

/// "Thinnest wall 2.1 mm, at a height of 34.0 mm; porcelain requires 3.0 mm: too thin".
[[nodiscard]] std::string wall_text(const PotCheck& check, LengthUnit unit);

/// "in two parts at a height of 40.0 mm"; requires `parting_mm`.
[[nodiscard]] std::string parts_text(const PotForm& form, LengthUnit unit);

/// "Ready to print", "Solid clay", or the reason why it is not ready, in a few words.
[[nodiscard]] std::string ready_text(const PotCheck& check, LengthUnit unit);

/// A stack whose rings are the rows of an outline, with radii at float precision, and the crown.
/// Empty if the rows hold no clay.
[[nodiscard]] std::optional<ClayStack> stack_of(const render::PotView& outline, double crown_mm);

}  // namespace clay::studio
