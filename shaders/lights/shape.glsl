// SPDX-License-Identifier: Apache-2.0
// Shapes of lights are unit shapes under an affine map. In the shape's coordinates, inverse * (p - origin), they are
//   rect      |x|, |y| <= 1/2, shining along z
//   disk      x^2 + y^2 <= 1, shining along z
//   sphere    a unit sphere, shining outwards
//   cylinder  |x| <= 1/2, y^2 + z^2 = 1, shining outwards, without caps
// where the z axis of flat shapes is their unit normal. Each has a file in shapes/ with its number,
// `const int SHAPE_X`, and functions of points q in the shape's coordinates:
//   xHit           first point of the emitting side that a ray meets
//   xPlace         a point for every receiver at once, of two random numbers
//   xPlaceDensity  its density by the world's area
//   xNormal        the world's unit normal of the emitting side
//   xExtent        half of the size of the box around it, along the world's axes
// and, where it is sampled for one receiver better than by xPlace, xSample and xPdf.

#ifndef PATINA_IN // C++ hands structs by reference
#define PATINA_IN(T) T
#endif

struct ShapeFrame {
    vec3 origin;
    mat3 axes;    // shape to world
    mat3 inverse; // world to shape
    float volume; // of the map, positive
};

// A point on a light, as seen from the point that is lit.
struct ShapePoint {
    vec3 position;
    vec3 normal; // of the side that emits
    float pdf;   // density by solid angle
};

PATINA_FN vec3 shapeLocal(PATINA_IN(ShapeFrame) s, vec3 position) {
    return s.inverse * (position - s.origin);
}

// The world's normal of one in the shape's coordinates; its length is that of the inverse transpose.
PATINA_FN vec3 shapeNormal(PATINA_IN(ShapeFrame) s, vec3 n) {
    return n * s.inverse;
}

// A density by area as one by solid angle; 0 where the surface faces away. v: from the surface to the point.
PATINA_FN float areaToSolidAngle(float byArea, vec3 v, vec3 normal) {
    float d2 = dot(v, v);
    float projected = dot(v, normal);
    return projected > 0.0f && d2 > 0.0f ? byArea * d2 * sqrt(d2) / projected : 0.0f;
}

// Where a ray comes down on the plane z = 0. o, d: in the shape's coordinates
PATINA_FN bool planeHit(vec3 o, vec3 d, PATINA_OUT(float) t, PATINA_OUT(vec3) q) {
    t = -o.z / d.z;
    q = vec3(o.x + t * d.x, o.y + t * d.y, 0.0f);
    return o.z > 0.0f && d.z < 0.0f;
}
