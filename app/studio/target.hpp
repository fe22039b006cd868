#pragma once
// The target profile: another pot, whose outline lies over the one on the wheel.

#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace clay::studio {

struct Target {
  std::string name;  ///< of the file or the sample
  render::PotView view;
};
using SharedTarget = std::shared_ptr<const Target>;

/// A pot (.pot.json, .pot.cbor, .3mf), the current pot of a work, or a drawing of a section.
Result<SharedTarget> read_target(const std::filesystem::path& path);
Result<SharedTarget> sample_target(std::size_t sample);

}  // namespace clay::studio
