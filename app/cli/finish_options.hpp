#pragma once
// Steps of `export` after throwing: foot, fillets, room for the glaze.

#include "claystack/export/job.hpp"

namespace CLI {
class App;
}

namespace clay::cli {

/// Adds --foot, --floor-fillet, --lip-fillet and --glaze-allowance. `glaze_mm`: thickness of the
/// glaze on the fired pot. Both must outlive the parsing.
void add_finish_options(CLI::App& command, solid::ExportOptions& options, double& glaze_mm);

}  // namespace clay::cli
