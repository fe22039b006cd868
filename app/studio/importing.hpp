#pragma once
// A drawing of a section on its way to the wheel: how it is read, and what comes of that.

#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace clay::studio {

/// Whether `claystack import` would read it: .svg, .dxf, .csv. False for all of them in a build
/// without drawings.
[[nodiscard]] bool is_drawing(const std::filesystem::path& path);

enum class ImportAxis { by_itself, left, middle, at };

/// What `claystack import` has as options; 0: not asked for.
struct ImportSettings {
  ImportAxis axis = ImportAxis::by_itself;
  double axis_mm = 0.0;    ///< with `at`
  double height_mm = 0.0;  ///< scaled to it
  double wall_mm = 0.0;    ///< hollowed
  friend bool operator==(const ImportSettings&, const ImportSettings&) = default;
};

struct Imported {
  Pot pot;
  double drawn_mm3 = 0.0, axis_mm = 0.0;
};
/// The pot that `claystack import` writes. `name` is of the file, for its ending and for errors.
Result<Imported> import_drawing(const std::string& bytes, const std::string& name,
                                const ImportSettings& settings);

/// The card.
struct ImportCard {
  std::filesystem::path path;
  std::string bytes;
  ImportSettings settings;
  // Of these settings.
  std::optional<Imported> made;
  render::PotView view;
  std::string problem;  ///< why nothing was made
};
/// Anew, after a change of settings.
void read_again(ImportCard& card);

}  // namespace clay::studio
