#pragma once
// Explicit contacts for tests, ring by ring.

#include "engine/tick/contact.hpp"

#include <vector>

namespace clay::samples {

/// The touched rings, ascending.
inline std::vector<RingContact> touched(const Contact& contact) {
  std::vector<RingContact> touches;
  for (std::size_t i = contact.rings.from(); i < contact.rings.to(); ++i)
    if (const RingContact touch = contact.rings.get(i); touch.depth_mm > 0.0)
      touches.push_back(touch);
  return touches;
}

/// Rings first..last, each touched at the same depth from that side.
inline Contact contact_on(std::size_t first, std::size_t last, Side side = Side::compressive,
                          double depth_mm = 1.0) {
  Contact contact;
  contact.side = side;
  contact.bottom = first;
  contact.top = last;
  contact.rings.lay_out(first, last + 1);
  for (std::size_t i = first; i <= last; ++i) contact.rings.put({.ring = i, .depth_mm = depth_mm});
  contact.rings.trim();
  return contact;
}

}  // namespace clay::samples
