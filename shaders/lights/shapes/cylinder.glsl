// SPDX-License-Identifier: Apache-2.0
// Cylinder lights, see ../shape.glsl. For one receiver samples are even in the angle along, and across in the width that
// the point sees.
const int SHAPE_CYLINDER = 3;

PATINA_FN_RARE bool cylinderHit(vec3 o, vec3 d, PATINA_OUT(float) t, PATINA_OUT(vec3) q) {
    t = 0.0f;
    q = o;
    vec2 f = vec2(o.y, o.z);
    vec2 l = vec2(d.y, d.z);
    float ll = dot(l, l);
    if (!(ll > 0.0f) || dot(f, f) <= 1.0f) return false; // from within there is nothing that emits
    float b = -dot(f, l) / ll;
    vec2 nearest = f + b * l; // safer than the textbook's discriminant
    float discriminant = 1.0f - dot(nearest, nearest);
    if (discriminant < 0.0f) return false;
    t = b - sqrt(discriminant / ll);
    q = o + t * d;
    return t > 0.0f && abs(q.x) <= 0.5f;
}

PATINA_FN vec3 cylinderPlace(vec2 u) {
    float a = TWO_PI * u.y;
    return vec3(u.x - 0.5f, cos(a), sin(a));
}

// Of the curved side, as long as the area is small.
PATINA_FN vec3 cylinderAcross(PATINA_IN(ShapeFrame) s, vec3 q) {
    return shapeNormal(s, vec3(0.0f, q.y, q.z));
}

PATINA_FN float cylinderPlaceDensity(PATINA_IN(ShapeFrame) s, vec3 q) {
    return 1.0f / (TWO_PI * s.volume * length(cylinderAcross(s, q)));
}

PATINA_FN vec3 cylinderNormal(PATINA_IN(ShapeFrame) s, vec3 q) {
    return normalize(cylinderAcross(s, q));
}

PATINA_FN vec3 cylinderExtent(PATINA_IN(ShapeFrame) s) {
    vec3 a = abs(s.axes[0]);
    vec3 b = abs(s.axes[1]);
    vec3 c = abs(s.axes[2]);
    return 0.5f * a + sqrt(b * b + c * c);
}

// Where on the line of the cylinder that is nearest to the point the samples centre.
struct CylinderView {
    float phi; // the point in the cross-section, polar; rho > 1
    float rho;
    float arc;   // half the angle under which the cross-section is seen
    float middle; // x = (t - middle) * scale, and t has density ~ 1 / (1 + x^2)
    float scale;
    float a; // x at t = -1/2, and the angle over which atan x goes
    float angle;
};

PATINA_FN bool cylinderView(PATINA_IN(ShapeFrame) s, vec3 point, PATINA_OUT(CylinderView) v) {
    vec3 q = shapeLocal(s, point);
    float rho2 = q.y * q.y + q.z * q.z;
    if (!(rho2 > 1.0f)) return false;
    v.phi = atan(q.z, q.y);
    v.rho = sqrt(rho2);
    v.arc = asin(min(1.0f, 1.0f / v.rho));
    vec3 along = s.axes[0];
    vec3 start = s.origin + cos(v.phi) * s.axes[1] + sin(v.phi) * s.axes[2];
    float length2 = dot(along, along);
    float l = sqrt(length2);
    v.middle = dot(point - start, along) / length2;
    float away = length(point - (start + v.middle * along));
    v.scale = l / max(away, 1e-3f * l);
    v.a = (-0.5f - v.middle) * v.scale;
    float b = (0.5f - v.middle) * v.scale;
    // atan b - atan a without the cancellation far beyond an end
    v.angle = atan(b - v.a, 1.0f + v.a * b);
    return v.angle > 0.0f;
}

PATINA_FN_RARE float cylinderAreaDensity(PATINA_IN(ShapeFrame) s, PATINA_IN(CylinderView) v, float t, float phi) {
    float x = (t - v.middle) * v.scale;
    float along = v.scale / ((1.0f + x * x) * v.angle);
    // Across, the angle psi at the point is uniform: d(phi) = (rho cos psi / cos i - 1) d(psi),
    // where i = delta + psi is the angle at the surface.
    float delta = phi - v.phi;
    float psi = atan(sin(delta), v.rho - cos(delta));
    float cosI = cos(delta + psi);
    float distance = v.rho * cos(psi) - cosI;
    if (!(cosI > 0.0f && distance > 0.0f)) return 0.0f;
    float around = cosI / (2.0f * v.arc * distance);
    vec3 tangent = -sin(phi) * s.axes[1] + cos(phi) * s.axes[2];
    return along * around / length(cross(s.axes[0], tangent));
}

// False where no part that emits faces the point.
PATINA_FN bool cylinderSample(PATINA_IN(ShapeFrame) s, vec3 point, vec2 u, PATINA_OUT(ShapePoint) p) {
    CylinderView v;
    if (!cylinderView(s, point, v)) return false;
    float psi = (2.0f * u.y - 1.0f) * v.arc;
    float sine = clamp(v.rho * sin(psi), -1.0f, 1.0f);
    float phi = v.phi + asin(sine) - psi;
    float turn = tan(u.x * v.angle);
    float x = (v.a + turn) / (1.0f - v.a * turn);
    float t = clamp(v.middle + x / v.scale, -0.5f, 0.5f);
    vec3 on = vec3(0.0f, cos(phi), sin(phi));
    p.position = s.origin + s.axes * vec3(t, on.y, on.z);
    p.normal = normalize(shapeNormal(s, on));
    float byArea = cylinderAreaDensity(s, v, t, phi);
    p.pdf = areaToSolidAngle(byArea, point - p.position, p.normal);
    return p.pdf > 0.0f;
}

PATINA_FN float cylinderPdf(PATINA_IN(ShapeFrame) s, vec3 point, vec3 position, vec3 normal) {
    CylinderView v;
    if (!cylinderView(s, point, v)) return 0.0f;
    vec3 q = shapeLocal(s, position);
    float byArea = cylinderAreaDensity(s, v, q.x, atan(q.z, q.y));
    return areaToSolidAngle(byArea, point - position, normal);
}
