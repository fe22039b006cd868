#pragma once
// Haptic devices and what keeps them safe: all public headers of the component.
// Devices on USB: claystack/falcon/usb.hpp, component `falcon_usb`.
#include "claystack/falcon/device.hpp"
#include "claystack/falcon/falcon_device.hpp"
#include "claystack/falcon/guard.hpp"
#include "claystack/falcon/passivity.hpp"
#include "claystack/falcon/sim.hpp"
