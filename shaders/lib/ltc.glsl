// SPDX-License-Identifier: Apache-2.0
// Light of polygons by linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt 2016). A polygon's
// share of a cosine lobe is a sum over its edges (Lambert 1760); a linear map of its corners gives its
// share of lobes that are the cosine's image. Frames have the normal as z. ltcFit.glsl has the maps.
const int LTC_CORNERS = 24; // the most of a polygon

PATINA_FN vec3 ltcMap(vec3 v, vec4 m) {
    return vec3(m.x * v.x + m.y * v.z, m.z * v.y, m.w * v.x + v.z);
}

// The contribution of the edge between two unit vectors: z of their cross product, times angle over sine.
PATINA_FN float ltcEdge(vec3 a, vec3 b) {
    vec3 c = cross(a, b);
    float cosine = dot(a, b);
    float s2 = dot(c, c);
    if (cosine > 0.99f) return c.z * (1.0f + s2 * (1.0f / 6.0f + 0.075f * s2));
    if (s2 < 1e-12f) return 0.0f;
    return c.z * acos(max(cosine, -1.0f)) / sqrt(s2);
}

// How much of the mapped cosine lobe falls on a polygon, in [0, 1]. corners: from the point that is
// lit, in order; what lies below the horizon of the cosine is cut off.
PATINA_FN float ltcShare(vec3 corners[LTC_CORNERS], int count, vec4 m) {
    float sum = 0.0f;
    bool left = false;    // the outline is below, since `leave`
    bool entered = false; // it began below, and came up at `enter`
    vec3 leave = vec3(0.0f);
    vec3 enter = vec3(0.0f);
    vec3 before = ltcMap(corners[count - 1], m);
    for (int i = 0; i < count; ++i) {
        vec3 a = before;
        vec3 b = ltcMap(corners[i], m);
        before = b;
        bool down = a.z <= 0.0f;
        bool ends = b.z <= 0.0f;
        if (down && ends) continue;
        if (down || ends) {
            vec3 cut = a + (b - a) * (a.z / (a.z - b.z));
            cut.z = 0.0f;
            float l = dot(cut, cut);
            if (!(l > 0.0f)) continue;
            cut = cut / sqrt(l);
            if (ends) {
                leave = cut;
                left = true;
                b = cut;
            } else {
                if (left)
                    sum += ltcEdge(leave, cut);
                else {
                    enter = cut;
                    entered = true;
                }
                left = false;
                a = cut;
            }
        }
        float la = dot(a, a);
        float lb = dot(b, b);
        if (la > 0.0f && lb > 0.0f) sum += ltcEdge(a / sqrt(la), b / sqrt(lb));
    }
    if (left && entered) sum += ltcEdge(leave, enter);
    return min(abs(sum) * (0.5f * INV_PI), 1.0f);
}

// The map of isotropic GGX facets. wo: in the frame, above it.
PATINA_FN vec4 ltcMicrofacets(vec3 wo, float alpha) {
    return ltcFit(min(max(wo.z, 0.0f), 1.0f), min(max(alpha, ALPHA_MIRROR), 1.0f));
}

// Turned about the normal so that the view lies above x, as the maps want it.
PATINA_FN vec3 ltcTurned(vec3 v, vec3 wo) {
    float l = sqrt(wo.x * wo.x + wo.y * wo.y);
    if (l < 1e-6f) return v;
    float c = wo.x / l;
    float s = wo.y / l;
    return vec3(c * v.x + s * v.y, c * v.y - s * v.x, v.z);
}

const int LTC_RECT = 0; // sides of 1 across x and y
const int LTC_DISK = 1; // radius 1, across x and y
const int LTC_SPHERE = 2; // radius 1
const int LTC_CYLINDER = 3; // radius 1, length 1 along x
const int LTC_SHAPES = 4; // those above have the numbers of shaders/lights/shapes; others no outline

struct LtcOutline {
    vec3 corners[LTC_CORNERS];
    int count; // 0: none, as from the inside
};

// The outline of a shape as a point sees it.
PATINA_FN LtcOutline ltcOutline(int kind, vec3 from) {
    LtcOutline o;
    o.count = 16;
    const float wider = 1.0129f; // a polygon of 16 sides as large as its circle
    if (kind == LTC_RECT) {
        o.count = 4;
        o.corners[0] = vec3(-0.5f, -0.5f, 0.0f);
        o.corners[1] = vec3(0.5f, -0.5f, 0.0f);
        o.corners[2] = vec3(0.5f, 0.5f, 0.0f);
        o.corners[3] = vec3(-0.5f, 0.5f, 0.0f);
    } else if (kind == LTC_CYLINDER) {
        // Two lines that touch it, and the arcs of its ends that face the point.
        float far2 = from.y * from.y + from.z * from.z;
        if (far2 <= 1.0002f) o.count = 0;
        float far = sqrt(max(far2, 1.0f));
        float open = acos(1.0f / far);
        for (int i = 0; i < o.count; ++i) {
            int k = i;
            if (i >= 8) k = 15 - i;
            float a = open * (2.0f * float(k) / 7.0f - 1.0f);
            float c = cos(a) / far;
            float s = sin(a) / far;
            float x = -0.5f;
            if (i >= 8) x = 0.5f;
            o.corners[i] = vec3(x, c * from.y - s * from.z, c * from.z + s * from.y);
        }
    } else {
        // Of a sphere the circle in which the point's cone touches it.
        vec3 axis = vec3(0.0f, 0.0f, 1.0f);
        float height = 0.0f;
        float r = wider;
        if (kind == LTC_SPHERE) {
            float far2 = dot(from, from);
            if (far2 <= 1.0002f) o.count = 0;
            height = 1.0f / sqrt(max(far2, 1.0f));
            axis = from * height;
            r = wider * sqrt(max(1.0f - height * height, 0.0f));
        }
        vec3 x = vec3(1.0f, 0.0f, 0.0f);
        if (abs(axis.x) > 0.7f) x = vec3(0.0f, 1.0f, 0.0f);
        x = normalize(cross(x, axis));
        vec3 y = cross(axis, x);
        for (int i = 0; i < o.count; ++i) {
            float a = TWO_PI * float(i) / 16.0f;
            o.corners[i] = axis * height + (x * cos(a) + y * sin(a)) * r;
        }
    }
    return o;
}
