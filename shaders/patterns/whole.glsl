// SPDX-License-Identifier: Apache-2.0
// Values as they are, and integers among the floats of a network.

// Of constants and conversions.
PATINA_FN vec4 patternSame(vec4 x) {
    return x;
}

// 0 for what is no number, and limited far beyond what any node knows.
PATINA_FN int patternWhole(float x) {
    if (x > -1e9f) return int(min(x, 1e9f));
    return x <= -1e9f ? -1000000000 : 0;
}
