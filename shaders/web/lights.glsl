// Direct lights of the material page, in a texture, eight texels in a row for each:
//   0 position, kind          1 radiance (of delta lights: irradiance or intensity), on
//   2 half axis u, radius     3 half axis v, area
//   4 normal, cosine of a distant light's half angle
//   5 focus, outer and inner angle of the cone (0: none), length of a cylinder
//   6 focus tint, -           7 shares of diffuse and of specular light
uniform sampler2D lightData;
uniform int lightCount;

const int LIGHT_RECT = 0;
const int LIGHT_DISK = 1;
const int LIGHT_SPHERE = 2;
const int LIGHT_CYLINDER = 3;
const int LIGHT_POINT = 4;
const int LIGHT_DISTANT = 5;

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
    return l;
}

// UsdLuxShapingAPI: focus and cone about the light's axis. away: from the light.
vec3 shapingOf(PageLight l, vec3 away) {
    vec3 f = vec3(1.0);
    float c = dot(away, l.normal);
    if (l.shaping.x > 0.0) f = mix(l.tint, vec3(1.0), pow(max(abs(c), 1e-20), l.shaping.x));
    if (l.shaping.y > 0.0) {
        float angle = acos(clamp(c, -1.0, 1.0));
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
    vec3 p, n = l.normal;
    if (l.kind == LIGHT_RECT) {
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
    return l.radiance * shapingOf(l, -wi);
}

// The same light found along wi. Cylinders are found by their own samples only.
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
    return l.radiance * shapingOf(l, -wi);
}
