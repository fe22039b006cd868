#pragma once
// All readers of Claystack's own files: those of engine, export and strokes, and those of devices
// and of the window where they are linked (CLAYSTACK_FALCON, CLAYSTACK_STUDIO).

#include "tests/fuzz/text_promise.hpp"

#ifdef CLAYSTACK_FALCON
#include "falcon/device/firmware.hpp"
#include "tests/falcon/device/dummy_firmware.hpp"
#endif
#ifdef CLAYSTACK_STUDIO
#include "app/studio/script.hpp"
#include "app/studio/settings.hpp"
#endif

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::samples {

#ifdef CLAYSTACK_FALCON
inline TextReader firmware_reader() {
  const auto firmware = falcon::dummy_firmware(20, 2);
  return {"firmware",
          {std::string(firmware.begin(), firmware.end())},
          read_only([](std::string_view bytes, std::string_view name) {
            return falcon::parse_firmware({bytes.begin(), bytes.end()}, std::string(name));
          })};
}
#endif

#ifdef CLAYSTACK_STUDIO
/// Those of the window; `folder` is samples/.
inline std::vector<TextReader> window_readers(const std::string& folder) {
  std::vector<std::string> scripts;
  for (const char* name : {"throw", "gallery", "pinch", "settings"})
    scripts.push_back(text_of(folder + "/window/" + name + ".script"));
  const auto settings = [](std::string_view bytes) {
    return round_trip(bytes, studio::parse_settings, studio::write_settings);
  };
  return {{"settings", {studio::write_settings({})}, settings},
          {"script", std::move(scripts), read_only(studio::parse_script)}};
}
#endif

/// `folder` is samples/.
inline std::vector<TextReader> program_readers(const std::string& folder) {
  std::vector<TextReader> readers = text_readers(folder);
#ifdef CLAYSTACK_FALCON
  readers.push_back(firmware_reader());
#endif
#ifdef CLAYSTACK_STUDIO
  std::ranges::move(window_readers(folder), std::back_inserter(readers));
#endif
  return readers;
}

}  // namespace clay::samples
