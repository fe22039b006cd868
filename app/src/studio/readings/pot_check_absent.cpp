// Built without the export: nothing is asked, and no panel shows what is not there.

#include "studio/readings/pot_check.hpp"

namespace clay::studio {

std::vector<std::string> process_names() { return {}; }

PotCheck check_pot(const PotQuestion&, const std::function<bool()>&) {
  PotCheck check;
  check.why_not = "built without the export";
  return check;
}

}  // namespace clay::studio
