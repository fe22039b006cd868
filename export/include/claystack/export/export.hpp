#pragma once
// From a pot to proved files, and checks of any mesh: all public headers of the component.
#include "claystack/export/check.hpp"
#include "claystack/export/fallen.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"
#include "claystack/export/maker.hpp"
#include "claystack/export/option_ranges.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/repair.hpp"
#include "claystack/export/section.hpp"
#include "claystack/export/smoothing.hpp"
#include "claystack/export/solid.hpp"
#include "claystack/export/walls.hpp"
