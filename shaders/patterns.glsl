// Mathematics of pattern nodes, beyond plain arithmetic. Needs shaders/lib/degenerate.glsl.
#include "shaders/patterns/color.glsl"
#include "shaders/patterns/normalMap.glsl"
#include "shaders/patterns/place2d.glsl"
#include "shaders/patterns/reflectance.glsl"
