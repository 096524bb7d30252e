// SPDX-License-Identifier: Apache-2.0
// Filters as rows of a table: the numbers are those of LightFilterType.
const int FILTER_BARN = 0;
const int FILTER_COOKIE = 1;
const int FILTER_GOBO = 2;
const int FILTER_MULTIPLIER = 3;
const int FILTER_RAMP = 4;
const int FILTER_ROD = 5;

const int FILTER_INVERT = 1;
const int FILTER_ANALYTIC = 2;
const int FILTER_DIRECTIONAL = 4;
const int FILTER_MORE = 8; // another filter of the light follows

// rows of four numbers: type, flags, density, intensity; three of the map to the filter's space; four by type:
//   barn, rod       low, radius | high, apex | edgeLow, shearX | edgeHigh, shearY
//   cookie, gobo    size, center | fill, apex | wrap, width, height, shearX | first texel, -, -, shearY
//   ramp            type, start, end | of the factors and | of the colours: first knot, knots, kind of curve
const int FILTER_ROWS = 8;
