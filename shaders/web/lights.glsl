// Direct lights of the material page, in a texture, eleven texels in a row for each:
//   0 position, kind          1 radiance (of delta lights: irradiance or intensity), on
//   2 half axis u, radius     3 half axis v, area
//   4 normal, cosine of a distant light's half angle
//   5 focus, outer and inner angle of the cone (0: none), length of a cylinder
//   6 focus tint, -           7 shares of diffuse and of specular light
//   8 in lightTable: first value of a rect's image (-1 none), its width and height; of triangles:
//     first value, how many; w: first value of an IES profile (-1 none)
//   9 x across the axis, thetas of the profile     10 y across the axis, phis of the profile
uniform sampler2D lightData;
uniform sampler2D lightTable; // 256 values in a row
uniform int lightCount;

const int LIGHT_RECT = 0;
const int LIGHT_DISK = 1;
const int LIGHT_SPHERE = 2;
const int LIGHT_CYLINDER = 3;
const int LIGHT_POINT = 4;
const int LIGHT_DISTANT = 5;
const int LIGHT_TRIANGLES = 6;
const int TRIANGLES_MET = 64; // samples of the BSDF look for no more

struct PageLight {
    int kind;
    vec3 position;
    vec3 radiance;
    vec3 axisU;
    float radius;
    vec3 axisV;
    float area;
    vec3 normal;
    float cosAngle;
    vec4 shaping;
    vec3 tint;
    vec2 shares;
    vec4 table;
    vec4 shapingX;
    vec4 shapingY;
};

vec4 lightTexel(int light, int i) {
    return texelFetch(lightData, ivec2(i, light), 0);
}

PageLight lightAt(int i) {
    PageLight l;
    vec4 a = lightTexel(i, 0), b = lightTexel(i, 1), u = lightTexel(i, 2), v = lightTexel(i, 3);
    vec4 n = lightTexel(i, 4);
    l.kind = int(a.w);
    l.position = a.xyz;
    l.radiance = b.xyz * b.w;
    l.axisU = u.xyz;
    l.radius = u.w;
    l.axisV = v.xyz;
    l.area = v.w;
    l.normal = n.xyz;
    l.cosAngle = n.w;
    l.shaping = lightTexel(i, 5);
    l.tint = lightTexel(i, 6).xyz;
    l.shares = lightTexel(i, 7).xy;
    l.table = lightTexel(i, 8);
    l.shapingX = lightTexel(i, 9);
    l.shapingY = lightTexel(i, 10);
    return l;
}

vec4 tableValue(int i) {
    return texelFetch(lightTable, ivec2(i & 255, i >> 8), 0);
}

// Candela in a direction away from the light, theta off its axis.
float profileOf(PageLight l, vec3 away, float theta) {
    float phi = atan(-dot(away, l.shapingY.xyz), -dot(away, l.shapingX.xyz)) / TWO_PI;
    float x = theta / PI * (l.shapingX.w - 1.0), y = fract(phi) * (l.shapingY.w - 1.0);
    int i = int(min(x, l.shapingX.w - 2.0)), k = int(min(y, l.shapingY.w - 2.0));
    int at = int(l.table.w) + k * int(l.shapingX.w) + i, next = at + int(l.shapingX.w);
    float low = mix(tableValue(at).x, tableValue(at + 1).x, x - float(i));
    return mix(low, mix(tableValue(next).x, tableValue(next + 1).x, x - float(i)), y - float(k));
}

// A rect's image; q from -1 to 1 along its half axes.
vec3 imageOf(PageLight l, vec2 q) {
    if (l.kind != LIGHT_RECT || l.table.x < 0.0) return vec3(1.0);
    vec2 size = l.table.yz, at = clamp((0.5 - 0.5 * q) * size - 0.5, vec2(0.0), size - 1.0);
    ivec2 low = ivec2(at), high = min(low + 1, ivec2(size) - 1);
    int first = int(l.table.x), w = int(size.x);
    vec2 t = at - vec2(low);
    return mix(mix(tableValue(first + low.y * w + low.x), tableValue(first + low.y * w + high.x), t.x),
               mix(tableValue(first + high.y * w + low.x), tableValue(first + high.y * w + high.x), t.x),
               t.y).rgb;
}

// A point on triangles by their area.
vec3 onTriangles(PageLight l, vec2 u, out vec3 normal) {
    int first = int(l.table.x), low = 0, high = int(l.table.y) - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (tableValue(first + 3 * middle).w > u.x) high = middle; else low = middle + 1;
    }
    float before = low > 0 ? tableValue(first + 3 * low - 3).w : 0.0;
    vec4 corner = tableValue(first + 3 * low);
    float root = sqrt(clamp((u.x - before) / max(corner.w - before, 1e-20), 0.0, 1.0));
    vec3 e1 = tableValue(first + 3 * low + 1).xyz, e2 = tableValue(first + 3 * low + 2).xyz;
    normal = unitOr(cross(e1, e2), vec3(0.0));
    return corner.xyz + e1 * (1.0 - root) + e2 * (u.y * root);
}

// The nearest triangle along wi. @returns its distance, 0 for none
float hitTriangles(PageLight l, vec3 from, vec3 wi, out vec3 normal) {
    float nearest = 0.0;
    normal = vec3(0.0);
    for (int i = 0; i < int(l.table.y); ++i) {
        int at = int(l.table.x) + 3 * i;
        vec3 e1 = tableValue(at + 1).xyz, e2 = tableValue(at + 2).xyz, o = from - tableValue(at).xyz;
        vec3 p = cross(wi, e2), q = cross(o, e1);
        float det = dot(e1, p), a = dot(o, p) / det, b = dot(wi, q) / det, t = dot(e2, q) / det;
        if (det == 0.0 || a < 0.0 || b < 0.0 || a + b > 1.0 || t <= 0.0) continue;
        if (nearest > 0.0 && t >= nearest) continue;
        nearest = t;
        normal = unitOr(cross(e1, e2), vec3(0.0));
    }
    return nearest;
}

bool isMet(PageLight l) {
    return l.kind != LIGHT_TRIANGLES || int(l.table.y) <= TRIANGLES_MET;
}

// UsdLuxShapingAPI: focus, cone and profile about the light's axis. away: from the light.
vec3 shapingOf(PageLight l, vec3 away) {
    vec3 f = vec3(1.0);
    float c = dot(away, l.normal);
    if (l.shaping.x > 0.0) f = mix(l.tint, vec3(1.0), pow(max(abs(c), 1e-20), l.shaping.x));
    float angle = acos(clamp(c, -1.0, 1.0));
    if (l.table.w >= 0.0) f *= profileOf(l, away, angle);
    if (l.shaping.y > 0.0) {
        f *= l.shaping.y > l.shaping.z ? 1.0 - smoothstep(l.shaping.z, l.shaping.y, angle)
                                       : (angle > l.shaping.y ? 0.0 : 1.0);
    }
    return f;
}

// Cosine of the cone that a sphere fills, seen from a distance; 1 from inside it.
float sphereCosine(PageLight l, vec3 from) {
    vec3 d = l.position - from;
    float s = l.radius * l.radius / max(dot(d, d), 1e-20);
    return s < 1.0 ? sqrt(1.0 - s) : 1.0;
}

vec3 inCone(vec3 axis, float cosine, vec2 u) {
    float c = mix(1.0, cosine, u.x);
    float s = sqrt(max(1.0 - c * c, 0.0));
    vec3 t = anyTangent(axis);
    return axis * c + (t * cos(TWO_PI * u.y) + cross(axis, t) * sin(TWO_PI * u.y)) * s;
}

// One direction to a light. density: by solid angle, 0 for delta lights.
// @returns radiance from there, for delta lights what arrives across it
vec3 sampleLight(PageLight l, vec3 from, vec2 u, out vec3 wi, out float density) {
    density = 0.0;
    if (l.kind == LIGHT_DISTANT) {
        wi = -l.normal;
        if (l.cosAngle >= 1.0) return l.radiance;
        wi = inCone(-l.normal, l.cosAngle, u);
        density = 1.0 / (TWO_PI * (1.0 - l.cosAngle));
        return l.radiance;
    }
    vec3 toCentre = l.position - from;
    if (l.kind == LIGHT_POINT) {
        float d2 = max(dot(toCentre, toCentre), 1e-20);
        wi = toCentre * inversesqrt(d2);
        return l.radiance / d2 * shapingOf(l, -wi);
    }
    if (l.kind == LIGHT_SPHERE) {
        float cosine = sphereCosine(l, from);
        vec3 axis = unitOr(toCentre, vec3(0.0, 1.0, 0.0));
        wi = inCone(axis, cosine, u);
        if (cosine >= 1.0) return vec3(0.0);
        density = 1.0 / (TWO_PI * (1.0 - cosine));
        return l.radiance * shapingOf(l, -wi);
    }
    vec3 p, n = l.normal, image = vec3(1.0);
    if (l.kind == LIGHT_TRIANGLES) {
        p = onTriangles(l, u, n);
    } else if (l.kind == LIGHT_RECT) {
        image = imageOf(l, 2.0 * u - 1.0);
        p = l.axisU * (2.0 * u.x - 1.0) + l.axisV * (2.0 * u.y - 1.0);
    } else if (l.kind == LIGHT_DISK) {
        float r = sqrt(u.x);
        p = (l.axisU * cos(TWO_PI * u.y) + l.axisV * sin(TWO_PI * u.y)) * r;
    } else {
        vec3 along = unitOr(l.axisU, vec3(1.0, 0.0, 0.0));
        vec3 t = anyTangent(along);
        n = t * cos(TWO_PI * u.y) + cross(along, t) * sin(TWO_PI * u.y);
        p = l.axisU * (2.0 * u.x - 1.0) + n * l.radius;
    }
    vec3 d = toCentre + p;
    float d2 = max(dot(d, d), 1e-20);
    wi = d * inversesqrt(d2);
    float c = -dot(n, wi);
    if (c <= 0.0) return vec3(0.0);
    density = d2 / (c * l.area);
    return l.radiance * image * shapingOf(l, -wi);
}

// The same light found along wi.
// @returns radiance; density: as sampleLight() would have it
vec3 lightAlong(PageLight l, vec3 from, vec3 wi, out float density) {
    density = 0.0;
    if (l.kind == LIGHT_DISTANT) {
        if (l.cosAngle >= 1.0 || dot(wi, -l.normal) < l.cosAngle) return vec3(0.0);
        density = 1.0 / (TWO_PI * (1.0 - l.cosAngle));
        return l.radiance;
    }
    vec3 toCentre = l.position - from;
    if (l.kind == LIGHT_SPHERE) {
        float cosine = sphereCosine(l, from);
        if (cosine >= 1.0 || dot(wi, unitOr(toCentre, vec3(0.0))) < cosine) return vec3(0.0);
        density = 1.0 / (TWO_PI * (1.0 - cosine));
        return l.radiance * shapingOf(l, -wi);
    }
    if (l.kind == LIGHT_TRIANGLES) {
        vec3 n;
        float t = isMet(l) ? hitTriangles(l, from, wi, n) : 0.0, c = -dot(n, wi);
        if (t <= 0.0 || c <= 0.0) return vec3(0.0);
        density = t * t / (c * l.area);
        return l.radiance * shapingOf(l, -wi);
    }
    if (l.kind == LIGHT_CYLINDER) {
        vec3 along = unitOr(l.axisU, vec3(1.0, 0.0, 0.0));
        vec3 o = -toCentre + along * dot(toCentre, along), d = wi - along * dot(wi, along);
        float a = dot(d, d), b = dot(o, d), off = dot(o, o) - l.radius * l.radius, root = b * b - a * off;
        if (a <= 0.0 || off <= 0.0 || root <= 0.0) return vec3(0.0);
        float t = (-b - sqrt(root)) / a;
        vec3 p = wi * t - toCentre, n = (p - along * dot(p, along)) / l.radius;
        float c = -dot(n, wi);
        if (t <= 0.0 || c <= 0.0 || abs(dot(p, along)) > length(l.axisU)) return vec3(0.0);
        density = t * t / (c * l.area);
        return l.radiance * shapingOf(l, -wi);
    }
    if (l.kind != LIGHT_RECT && l.kind != LIGHT_DISK) return vec3(0.0);
    float c = -dot(l.normal, wi);
    if (c <= 0.0) return vec3(0.0);
    float t = -dot(l.normal, toCentre) / c;
    if (t <= 0.0) return vec3(0.0);
    vec3 q = wi * t - toCentre;
    float a = dot(q, l.axisU) / max(dot(l.axisU, l.axisU), 1e-30);
    float b = dot(q, l.axisV) / max(dot(l.axisV, l.axisV), 1e-30);
    bool inside = l.kind == LIGHT_RECT ? max(abs(a), abs(b)) <= 1.0 : a * a + b * b <= 1.0;
    if (!inside) return vec3(0.0);
    density = t * t / (c * l.area);
    return l.radiance * imageOf(l, vec2(a, b)) * shapingOf(l, -wi);
}
