#ifdef AROUND_LIGHT
#include "shaders/raster/lightShape.glsl"
in vec3 vPosition;

void main() {
    if (isOfLight(vPosition)) discard;
}
#else
void main() {}
#endif
