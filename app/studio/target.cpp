#include "app/studio/target.hpp"

#include "app/cli/pot_input.hpp"
#include "app/history/work.hpp"
#include "app/render/pot_view.hpp"
#include "app/studio/importing.hpp"
#include "app/studio/samples.hpp"
#include "claystack/core/atomic_file.hpp"
#include "core/text.hpp"

#include <utility>

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
  if (!ends_ignoring_case(name, ".work")) return cli::read_pot(name);
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

}  // namespace clay::studio
