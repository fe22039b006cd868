#pragma once
// Import of a drawing of a section: its settings and the pot that results.

#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace clay::studio {

/// True for a file that `claystack import` reads: .svg, .dxf, .csv. Always false in a build without
/// drawings.
[[nodiscard]] bool is_drawing(const std::filesystem::path& path);

enum class ImportAxis { by_itself, left, middle, right, at };

/// The options of `claystack import`; 0: not set.
struct ImportSettings {
  ImportAxis axis = ImportAxis::by_itself;
  double axis_mm = 0.0;    ///< axis position, used with `at`
  double height_mm = 0.0;  ///< the drawing is scaled to this height
  double wall_mm = 0.0;    ///< the pot is hollowed to this wall thickness
  friend bool operator==(const ImportSettings&, const ImportSettings&) = default;
};

struct Imported {
  Pot pot;
  double drawn_mm3 = 0.0, axis_mm = 0.0;
  std::vector<std::string> notes;  ///< parts of the drawing that were not used
};
/// Makes the same pot as `claystack import`. `name`: file name, for its extension and for errors.
Result<Imported> import_drawing(const std::string& bytes, const std::string& name,
                                const ImportSettings& settings);

/// State of the import dialog.
struct ImportCard {
  std::filesystem::path path;
  std::string bytes;
  ImportSettings settings;
  // Of these settings.
  std::optional<Imported> made;
  render::PotView view;
  std::string problem;  ///< reason why no pot was made
};
/// Repeats the import after a change of settings.
void reload(ImportCard& card);

}  // namespace clay::studio
