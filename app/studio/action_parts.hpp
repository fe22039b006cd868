#pragma once
// What the parts of the table of actions share.

#include "app/studio/actions.hpp"
#include "app/studio/app_state.hpp"

namespace clay::studio {

inline bool always(const AppState&) { return true; }
inline bool has_work(const AppState& shop) { return shop.potter.has_work(); }
inline bool at_rest(const AppState& shop) { return has_work(shop) && !shop.potter.throwing(); }
/// An arm throws all the time: there the stroke that lasts is ended first.
inline bool between(const AppState& shop) { return at_rest(shop) || shop.potter.has_device(); }

/// Of the menus File and Edit, and of cards.
[[nodiscard]] std::span<const Action> file_actions();
/// Of the menus View and Help.
[[nodiscard]] std::span<const Action> view_actions();

}  // namespace clay::studio
