#pragma once
// 3Dconnexion controllers that the page has opened by WebHID.

#include "app/servo/clock.hpp"
#include "app/studio/device_watch.hpp"

namespace clay::web {

/// Finds the controller of the page. `clock`: of the servo; it must outlive the devices.
[[nodiscard]] studio::LookForDevice look_for_hid(servo::Clock& clock);

}  // namespace clay::web
