#pragma once
#include "claystack/export/profile.hpp"
namespace clay::solid {
double clearance_mm(const Profile& profile);
}
