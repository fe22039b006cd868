#pragma once
#include "app/studio/host.hpp"

namespace clay::studio {

/// Keys and clipboard of the present ImGui context, whose layout is fixed. The host outlives it.
void connect_imgui(Host& host);

}  // namespace clay::studio
