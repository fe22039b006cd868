#pragma once
// Haptic devices and their safety: all public headers of the component. USB devices:
// claystack/falcon/usb.hpp, component `falcon_usb`.
#include "claystack/falcon/device.hpp"
#include "claystack/falcon/falcon_device.hpp"
#include "claystack/falcon/guard.hpp"
#include "claystack/falcon/passivity.hpp"
#include "claystack/falcon/sim.hpp"
