#pragma once
// Strokes that are planned on the current pot.

#include "app/strokes/hand.hpp"
#include "app/strokes/strokes.hpp"

namespace clay::strokes {

/// Moves to the first place of a stroke, over the script's start.
void approach(Hand& hand, glm::dvec2 first_mm);

/// Pass `pass` of a stroke of kind shape, with the way to it and away from it.
void shape(Hand& hand, const Stroke& stroke, int pass);
void pull(Hand& hand, const Stroke& stroke);
void round_lip(Hand& hand, const Stroke& stroke);

}  // namespace clay::strokes
