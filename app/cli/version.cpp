#include "claystack/version.hpp"
#include "app/cli/commands.hpp"

namespace clay::cli {

std::string version_text() {
  std::string parts = "engine files";
#ifdef CLAYSTACK_EXPORT
  parts += " export";
#endif
#ifdef CLAYSTACK_OPENMESH
  parts += " openmesh";
#endif
#ifdef CLAYSTACK_DRACO
  parts += " draco";
#endif
#ifdef CLAYSTACK_MESHOPT
  parts += " meshopt";
#endif
#ifdef CLAYSTACK_DRAWINGS
  parts += " drawings";
#endif
#ifdef CLAYSTACK_WINDOW
  parts += " window";
#endif
#ifdef CLAYSTACK_USB
  parts += " devices";
#endif
#ifdef CLAYSTACK_BENCH
  parts += " bench";
#endif
#ifdef __clang__
  const std::string compiler = "Clang " __clang_version__;
#else
  const std::string compiler = "GCC " __VERSION__;
#endif
  return "claystack " CLAYSTACK_VERSION "\nbuilt with " + compiler + "\nbuilt in: " + parts;
}

}  // namespace clay::cli
