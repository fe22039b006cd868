#pragma once
// The clay on the wheel: all public headers of the component. Scene, session, pot and work files:
// claystack/engine/files.hpp, component `files`.
#include "claystack/engine/clay.hpp"
#include "claystack/engine/collapse.hpp"
#include "claystack/engine/plan.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"
#include "claystack/engine/wheel.hpp"
