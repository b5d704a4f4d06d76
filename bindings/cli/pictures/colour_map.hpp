// Colours of values. In both maps the lightness alone tells values apart, so that nobody has to tell red from green.
#pragma once

#include "image.hpp"

namespace cli {

// From dark violet over blue and green to yellow.
Colour field_colour(double share);
// From near white over orange to near black.
Colour error_colour(double share);
// Of what has no value, or no counterpart.
Colour no_colour();

}  // namespace cli
