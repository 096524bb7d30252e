// SPDX-License-Identifier: Apache-2.0
// Pattern nodes that few materials have, and that cost a driver time to read: noise of many kinds,
// flakes, hexagonal tiles, matrices, placed images, differences, hair. The text of a material
// includes this where it needs it. As materialNetwork/nodes, in GLSL.

int nodeWhole(float x) {
    return x > -1e9 ? int(min(x, 1e9)) : x <= -1e9 ? -1000000000 : 0;
}

// Colours.
vec4 nodeRange(vec4 x, vec4 low, vec4 high, vec4 gamma, vec4 outLow, vec4 outHigh, float limits) {
    vec4 v;
    for (int i = 0; i < 4; ++i)
        v[i] = patternRange(x[i], low[i], high[i], gamma[i], outLow[i], outHigh[i]);
    return limits != 0.0 ? min(max(v, outLow), outHigh) : v;
}
vec4 nodeSafePower(vec4 x, vec4 e) {
    return vec4(patternSafePower(x.x, e.x), patternSafePower(x.y, e.y), patternSafePower(x.z, e.z),
                patternSafePower(x.w, e.w));
}
vec4 nodeColorCorrect(vec4 c, float hue, float saturation, float gamma, float lift, float gain,
                      float contrast, float pivot, float exposure) {
    vec3 v = patternHsvAdjust(c.xyz, vec3(hue, 1.0, 1.0));
    v = patternSaturate(v, saturation, vec3(0.2722287, 0.6740818, 0.0536895));
    for (int i = 0; i < 3; ++i)
        v[i] = patternRange(v[i], 0.0, 1.0, gamma, 0.0, 1.0);
    v = v * (1.0 - lift) + lift;
    v = (v * gain - pivot) * contrast + pivot;
    return vec4(v * exp2(clamp(exposure, -60.0, 60.0)), c.w);
}
vec4 nodeOverlay(vec4 f, vec4 b) {
    return mix(2.0 * f * b, 1.0 - 2.0 * (1.0 - f) * (1.0 - b), greaterThanEqual(b, vec4(0.5)));
}
vec4 nodeBurn(vec4 f, vec4 b, float amount) {
    vec4 v = b + (1.0 - (1.0 - b) / f - b) * amount;
    return mix(v, vec4(0.0), lessThan(abs(f), vec4(1e-6)));
}
vec4 nodeDodge(vec4 f, vec4 b, float amount) {
    vec4 v = b + (b / (1.0 - f) - b) * amount;
    return mix(v, vec4(0.0), lessThan(abs(1.0 - f), vec4(1e-6)));
}
vec4 nodeMatte(vec4 f, vec4 b) {
    return vec4(f.xyz * f.w + b.xyz * (1.0 - f.w), f.w + b.w * (1.0 - f.w));
}
vec4 nodeDisjointOver(vec4 f, vec4 b) {
    float sum = f.w + b.w;
    if (sum <= 1.0) return vec4(f.xyz + b.xyz, sum);
    if (abs(b.w) < 1e-6) return vec4(0.0, 0.0, 0.0, 1.0);
    return vec4(f.xyz + b.xyz * ((1.0 - f.w) / b.w), 1.0);
}

// Noise.
// A fourth channel, and the second of a pair, is the same noise elsewhere.
vec4 nodeNoise2Quad(vec2 p) {
    vec4 v;
    for (int i = 0; i < 4; ++i)
        v[i] = noisePerlin2(i < 3 ? p : p + vec2(19.0, 73.0), i < 3 ? 8 * i : 0);
    return v;
}
vec4 nodeNoise3Quad(vec3 p) {
    vec4 v;
    for (int i = 0; i < 4; ++i)
        v[i] = noisePerlin3(i < 3 ? p : p + vec3(19.0, 73.0, 29.0), i < 3 ? 8 * i : 0);
    return v;
}
vec4 nodeFractal2Pair(vec2 p, int octaves, float lacunarity, float diminish) {
    vec4 v = vec4(0.0);
    for (int i = 0; i < 2; ++i)
        v[i] = noiseFractal2(p + float(i) * vec2(19.0, 193.0), octaves, lacunarity, diminish, 0);
    return v;
}
vec4 nodeFractal2Quad(vec2 p, int octaves, float lacunarity, float diminish) {
    vec4 v;
    for (int i = 0; i < 4; ++i)
        v[i] = noiseFractal2(i < 3 ? p : p + vec2(19.0, 193.0), octaves, lacunarity, diminish,
                             i < 3 ? 8 * i : 0);
    return v;
}
vec4 nodeFractal3Pair(vec3 p, int octaves, float lacunarity, float diminish) {
    vec4 v = vec4(0.0);
    for (int i = 0; i < 2; ++i)
        v[i] = noiseFractal3(p + float(i) * vec3(19.0, 193.0, 17.0), octaves, lacunarity, diminish, 0);
    return v;
}
vec4 nodeFractal3Quad(vec3 p, int octaves, float lacunarity, float diminish) {
    vec4 v;
    for (int i = 0; i < 4; ++i)
        v[i] = noiseFractal3(i < 3 ? p : p + vec3(19.0, 193.0, 17.0), octaves, lacunarity, diminish,
                             i < 3 ? 8 * i : 0);
    return v;
}
vec4 nodeToRange(float x, float low, float high, float limits) {
    float v = low + x * (high - low);
    return vec4(limits != 0.0 ? min(max(v, low), high) : v);
}
float nodeUnified2(vec2 p, float jitter, int octaves, float lacunarity, float diminish, int type,
                   int style) {
    float angle = (jitter - 1.0) * 90000.0;
    if (type == 2) return worleyScalar2(p, jitter, style);
    if (type == 3) return noiseFractal3(vec3(p, angle), octaves, lacunarity, diminish, 0);
    vec2 turned = patternRotate2d(p, angle);
    return type == 0 ? 0.5 * noisePerlin2(turned, 0) + 0.5 : type == 1 ? noiseCell2(turned) : 0.0;
}
float nodeUnified3(vec3 p, float jitter, int octaves, float lacunarity, float diminish, int type,
                   int style) {
    if (type == 2) return worleyScalar3(p, jitter, style);
    vec3 turned = patternRotate3d(p, (jitter - 1.0) * 90000.0, vec3(0.1, 1.0, 0.0));
    if (type == 3) return noiseFractal3(turned, octaves, lacunarity, diminish, 0);
    return type == 0 ? 0.5 * noisePerlin3(turned, 0) + 0.5 : type == 1 ? noiseCell3(turned) : 0.0;
}
float nodeRandom(float x, float seed, float low, float high) {
    float v = low + noiseCell2(vec2(x, seed)) * (high - low);
    return min(max(v, low), high);
}
float nodeRandomBetween(float x, float salt, float low, float high) {
    return low + nodeRandom(x * 4096.0, ceil(salt), 0.0, 1.0) * (high - low);
}
vec4 nodeRandomColor(float x, vec2 hue, vec2 saturation, vec2 brightness, float seed) {
    return vec4(patternHsvToRgb(vec3(
                    nodeRandomBetween(x, seed + 413.3, hue.x, hue.y),
                    nodeRandomBetween(x, seed + 1522.4, saturation.x, saturation.y),
                    nodeRandomBetween(x, seed + 1813.8, brightness.x, brightness.y))), 0.0);
}
// The flake found last: nodes have several outputs.
FlakeHit nodeFlakeHit;
vec4 nodeFlake(float size, float roughness, float coverage, vec3 at, vec3 n, vec3 t, vec3 b) {
    nodeFlakeHit = patternFlake(size, roughness, coverage, at, n, t, b);
    return vec4(float(nodeFlakeHit.id));
}

// Choices and ramps.
vec4 nodeSwitch(float which, vec4 v[10]) {
    float i = max(floor(which), 0.0);
    return i < 10.0 ? v[int(i)] : vec4(0.0);
}
mat3 nodeSwitch3(float which, mat3 v[10]) {
    float i = max(floor(which), 0.0);
    return i < 10.0 ? v[int(i)] : mat3(0.0);
}
mat4 nodeSwitch4(float which, mat4 v[10]) {
    float i = max(floor(which), 0.0);
    return i < 10.0 ? v[int(i)] : mat4(0.0);
}
vec4 nodeRamp(vec2 uv, int kind, int interpolation, int count, float at[10], vec4 colors[10]) {
    float x = patternRampPosition(uv, kind);
    vec4 color = colors[0];
    for (int i = 0; i < clamp(count - 1, 0, 9); ++i)
        if (x > at[i])
            color = colors[i] + (colors[i + 1] - colors[i]) *
                                    patternRampBlend(x, at[i], at[i + 1], interpolation);
    return color;
}
vec4 nodeRampGradient(float x, float low, float high, vec4 a, vec4 b, int interpolation,
                      vec4 before, float number, float count) {
    if (number >= count || x <= low) return before;
    return a + (b - a) * patternRampBlend(x, low, high, interpolation);
}

// Matrices: rows of the network are columns here, so factors change places. One without an inverse
// has the identity for it.
mat3 nodeInverse(mat3 m) {
    float d = determinant(m);
    return d != 0.0 && abs(1.0 / d) < 1e38 ? inverse(m) : mat3(1.0);
}
mat4 nodeInverse(mat4 m) {
    float d = determinant(m);
    return d != 0.0 && abs(1.0 / d) < 1e38 ? inverse(m) : mat4(1.0);
}

// Spaces. mode: 0 the same, 1 to world, 2 to object.
mat3 nodeObjectToWorld() {
    return transpose(inverse(point.objectToWorldNormal));
}
vec4 nodeTransformPoint(int mode, vec4 v) {
    if (mode == 0) return v;
    if (mode == 1)
        return vec4(nodeObjectToWorld() * (v.xyz - point.objectPosition) + point.position + worldOrigin,
                    0.0);
    return vec4(transpose(point.objectToWorldNormal) * (v.xyz - worldOrigin - point.position) +
                    point.objectPosition, 0.0);
}
vec4 nodeTransformVector(int mode, vec4 v) {
    if (mode == 0) return v;
    return vec4((mode == 1 ? nodeObjectToWorld() : transpose(point.objectToWorldNormal)) * v.xyz,
                0.0);
}
vec4 nodeTransformNormal(int mode, vec4 v) {
    vec3 m = mode == 0   ? v.xyz
             : mode == 1 ? point.objectToWorldNormal * v.xyz
                         : inverse(point.objectToWorldNormal) * v.xyz;
    float l = length(m);
    return vec4(l > 0.0 && l < 3e38 ? m / l : v.xyz, 0.0);
}
vec4 nodeRefract(vec3 i, vec3 n, float eta) {
    float d = dot(i, n);
    float k = 1.0 - eta * eta * (1.0 - d * d);
    return k < 0.0 ? vec4(0.0) : vec4(i * eta - n * (eta * d + sqrt(k)), 0.0);
}
vec4 nodeFacingRatio(vec3 view, vec3 n, float faces, float inverts) {
    float d = dot(view, n);
    float facing = faces != 0.0 ? abs(d) : d;
    return vec4(inverts != 0.0 ? 1.0 - facing : facing);
}
vec4 nodeGooch(vec4 warm, vec4 cool, float intensity, float shininess, vec3 light) {
    vec3 l = length(light) > 0.0 ? light / length(light) : vec3(0.0, 0.0, 1.0);
    vec3 n = point.normal, v = -point.view;
    vec3 reflected = v - n * (2.0 * dot(n, v));
    float highlight = powSchlick(max(dot(-l, reflected), 0.0), shininess) * intensity;
    return warm + (cool - warm) * (0.5 * (1.0 + dot(n, l))) + highlight;
}

// Differences: half a pixel, but no less than what floats can tell apart.
float nodeStep() {
    return max(0.5 * point.uvFootprint, 1.0 / 4096.0);
}
vec4 nodeShiftTexcoord(vec4 v, float axis) {
    return v + vec4(axis != 0.0 ? 0.0 : nodeStep(), axis != 0.0 ? nodeStep() : 0.0, 0.0, 0.0);
}
vec4 nodeMoved(vec4 v, vec3 d, float world) {
    return v + vec4(world != 0.0 ? d : transpose(point.objectToWorldNormal) * d, 0.0);
}
vec4 nodeShiftPosition(vec4 v, float axis, float world) {
    return nodeMoved(v, (axis != 0.0 ? point.bitangent : point.tangent) *
                            (nodeStep() * point.lengthPerUv), world);
}
vec2 nodeBlurTap(float size, float blur, float tap, float gaussian) {
    return max(size, 0.0) * patternBlurTap(point.seed, int(blur), int(tap), gaussian != 0.0);
}
vec4 nodeMovePosition(vec4 v, vec2 by, float world) {
    return nodeMoved(v, (point.tangent * by.x + point.bitangent * by.y) * point.lengthPerUv, world);
}
vec4 nodeSlope(float here, float alongU, float alongV, float scale, vec2 at, vec2 atU, vec2 atV) {
    float k = 1.0 / nodeStep();
    vec3 u = vec3((atU - at) * k, (alongU - here) * k * (scale / 16.0));
    vec3 v = vec3((atV - at) * k, (alongV - here) * k * (scale / 16.0));
    vec3 n = cross(u, v);
    if (n.z < 0.0) n = -n;
    float l = length(n);
    return vec4((l > 1e-6 && l < 1e30 ? n / l : vec3(0.0, 0.0, 1.0)) * 0.5 + 0.5, 0.0);
}

// Placed images.
vec2 nodeGltfUv(vec4 uv, vec4 pivot, vec4 scale, vec4 rotation, vec4 offset, int order) {
    vec2 inverseScale = vec2(scale.x != 0.0 ? 1.0 / scale.x : 0.0, scale.y != 0.0 ? 1.0 / scale.y : 0.0);
    return patternPlace2d(uv.xy, pivot.xy, inverseScale, -rotation.x, vec2(-offset.x, offset.y),
                          order);
}
vec2 nodeLatLong(vec3 d, float rotation) {
    return vec2(atan(d.x, d.z) * -0.15915494 + 0.5 + rotation / 360.0,
                nodeAsin(vec4(d.y)).x * 0.31830989 + 0.5);
}
vec2 nodePlane(int axis, vec3 p, int up) {
    if (axis == 0) return up == 2 ? p.yz : p.zy;
    if (axis == 1) return up == 0 ? p.zx : p.xz;
    return up == 0 ? vec2(-p.y, p.x) : p.xy;
}
float nodePlaneFootprint() {
    return point.uvFootprint * point.lengthPerUv;
}
vec4 nodeTriplanar(vec4 x, vec4 y, vec4 z, vec4 fallback, vec3 normal, float blend) {
    vec3 w = abs(normal);
    float sum = w.x + w.y + w.z;
    if (!(sum > 0.0)) return fallback;
    w = pow(w / sum, vec3(1.0 / clamp(blend, 0.03, 1.0)));
    float total = w.x + w.y + w.z;
    return total > 0.0 ? (x * w.x + y * w.y + z * w.z) / total : fallback;
}

// Hexagonal tiles; those found last.
HexTiles nodeHex;
vec4 nodeHexSet(vec4 uv, vec4 tiling, float rotation, vec4 rotationRange, float scale,
                vec4 scaleRange, float offset, vec4 offsetRange) {
    HexSpread spread;
    spread.rotation = rotation;
    spread.rotationRange = rotationRange.xy;
    spread.scale = scale;
    spread.scaleRange = scaleRange.xy;
    spread.offset = offset;
    spread.offsetRange = offsetRange.xy;
    nodeHex = hexTiles(uv.xy * tiling.xy, spread);
    return vec4(0.0);
}
float nodeHexFootprint(HexTile tile, vec4 tiling) {
    return point.uvFootprint * max(abs(tiling.x), abs(tiling.y)) / max(abs(tile.scale), 1e-6);
}
vec4 nodeHexImage(vec4 a, vec4 b, vec4 c, float falloff, float contrast, vec3 luma) {
    vec3 bright = vec3(dot(a.xyz, luma), dot(b.xyz, luma), dot(c.xyz, luma));
    vec3 w = hexShares(nodeHex, vec3(1.0) + (bright - 1.0) * contrast, falloff);
    vec3 even = hexShares(nodeHex, vec3(1.0), falloff);
    return vec4(a.xyz * w.x + b.xyz * w.y + c.xyz * w.z, dot(vec3(a.w, b.w, c.w), even));
}
vec3 nodeTurned(vec3 v, vec3 n, float angle) {
    float s = sin(-angle), k = cos(-angle);
    return v * k + cross(n, v) * s + n * (dot(n, v) * (1.0 - k));
}
vec3 nodeTileNormal(vec3 m, float angle, float strength, float flips, vec3 n, vec3 t, vec3 b) {
    if (flips != 0.0) m.y = 1.0 - m.y;
    m = m * 2.0 - 1.0;
    return unitOr((nodeTurned(t, n, angle) * m.x + nodeTurned(b, n, angle) * m.y) * strength +
                      n * m.z, n);
}
vec4 nodeHexNormal(vec4 a, vec4 b, vec4 c, float falloff, float strength, float flips, vec3 n,
                   vec3 t, vec3 s) {
    vec3 w = hexShares(nodeHex, vec3(1.0), falloff);
    vec3 bent =
        n - (normalGradient(n, nodeTileNormal(a.xyz, nodeHex.a.angle, strength, flips, n, t, s)) * w.x +
             normalGradient(n, nodeTileNormal(b.xyz, nodeHex.b.angle, strength, flips, n, t, s)) * w.y +
             normalGradient(n, nodeTileNormal(c.xyz, nodeHex.c.angle, strength, flips, n, t, s)) * w.z);
    return vec4(unitOr(bent, n), 0.0);
}

// Hair; Chiang et al. 2016 and d'Eon et al. 2011, as materialNetwork/nodes/hairNodes.cpp.
float nodeBetween(float x, float low, float high) {
    return x > low ? min(x, high) : low;
}
vec4 nodeHairRoughness(float longitudinal, float azimuthal, float scale) {
    float l = nodeBetween(longitudinal, 1e-3, 1.0), a = nodeBetween(azimuthal, 1e-3, 1.0);
    float root = 0.726 * l + 0.812 * l * l + 3.7 * pow(l, 20.0);
    float s = 0.265 * a + 1.194 * a * a + 5.372 * pow(a, 22.0);
    return vec4(root * root * scale * scale, s, 0.0, 0.0);
}
vec4 nodeHairFromColor(vec4 color, float azimuthal) {
    float b = nodeBetween(azimuthal, 0.0, 1.0);
    float scale = 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
    vec3 x = vec3(log(nodeBetween(color.x, 1e-3, 1.0)), log(nodeBetween(color.y, 1e-3, 1.0)),
                  log(nodeBetween(color.z, 1e-3, 1.0))) / scale;
    return vec4(x * x, 0.0);
}
vec3 nodeOpticalDepth(vec3 c) {
    return -log(vec3(nodeBetween(c.x, 1e-4, 1.0), nodeBetween(c.y, 1e-4, 1.0),
                     nodeBetween(c.z, 1e-4, 1.0)));
}
vec4 nodeHairFromMelanin(float concentration, float redness, vec4 eumelanin, vec4 pheomelanin) {
    float melanin = -log(max(1.0 - nodeBetween(concentration, 0.0, 1.0), 1e-4));
    float red = nodeBetween(redness, 0.0, 1.0);
    return vec4(melanin * ((1.0 - red) * nodeOpticalDepth(eumelanin.xyz) +
                           red * nodeOpticalDepth(pheomelanin.xyz)), 0.0);
}
