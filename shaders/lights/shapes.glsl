// The shapes that lights have, by number. A shape is named here and nowhere else in shaders; see shape.glsl.
#include "shaders/lights/shape.glsl"
#include "shaders/lights/rect.glsl"
#include "shaders/lights/disk.glsl"
#include "shaders/lights/sphere.glsl"
#include "shaders/lights/cylinder.glsl"

const int SHAPE_RECT = 0;
const int SHAPE_DISK = 1;
const int SHAPE_SPHERE = 2;
const int SHAPE_CYLINDER = 3;

// The first point of the emitting side that a ray meets. o, d: in the shape's coordinates
PATINA_FN bool shapeHit(int kind, vec3 o, vec3 d, PATINA_OUT(float) t, PATINA_OUT(vec3) q) {
    if (kind == SHAPE_RECT) return rectHit(o, d, t, q);
    if (kind == SHAPE_DISK) return diskHit(o, d, t, q);
    if (kind == SHAPE_SPHERE) return sphereHit(o, d, t, q);
    return cylinderHit(o, d, t, q);
}

// The world's unit normal at a point in the shape's coordinates.
PATINA_FN vec3 shapeNormalAt(int kind, PATINA_IN(ShapeFrame) s, vec3 q) {
    if (kind == SHAPE_RECT || kind == SHAPE_DISK) return s.axes[2];
    return normalize(shapeNormal(s, kind == SHAPE_CYLINDER ? vec3(0.0f, q.y, q.z) : q));
}

// A point for every receiver at once. Spheres have sphereInside.glsl for that.
PATINA_FN vec3 shapePlace(int kind, vec2 u) {
    if (kind == SHAPE_RECT) return rectPlace(u);
    if (kind == SHAPE_DISK) return diskPlace(u);
    return cylinderPlace(u);
}

// Its density by area.
PATINA_FN float shapePlaceDensity(int kind, PATINA_IN(ShapeFrame) s, vec3 q) {
    if (kind == SHAPE_RECT) return 1.0f / s.volume; // the third axis is a unit normal
    if (kind == SHAPE_DISK) return INV_PI / s.volume;
    return cylinderPlaceDensity(s.volume, shapeNormal(s, vec3(0.0f, q.y, q.z)));
}
