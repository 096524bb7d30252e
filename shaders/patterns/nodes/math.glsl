// SPDX-License-Identifier: Apache-2.0
// Arithmetic, component by component. Scalars fill their register, so one function serves all sizes
// and the scalar-vector variants.

PATINA_FN vec4 nodeAdd(vec4 a, vec4 b) {
    return a + b;
}
PATINA_FN vec4 nodeSubtract(vec4 a, vec4 b) {
    return a - b;
}
PATINA_FN vec4 nodeMultiply(vec4 a, vec4 b) {
    return a * b;
}
PATINA_FN float dividedOrZero(float a, float b) {
    return b == 0.0f ? 0.0f : a / b;
}
PATINA_FN vec4 nodeDivide(vec4 a, vec4 b) {
    return vec4(dividedOrZero(a.x, b.x), dividedOrZero(a.y, b.y), dividedOrZero(a.z, b.z),
                dividedOrZero(a.w, b.w));
}
PATINA_FN float moduloOrZero(float a, float b) {
    return b == 0.0f ? 0.0f : a - b * floor(a / b);
}
PATINA_FN vec4 nodeModulo(vec4 a, vec4 b) {
    return vec4(moduloOrZero(a.x, b.x), moduloOrZero(a.y, b.y), moduloOrZero(a.z, b.z),
                moduloOrZero(a.w, b.w));
}
PATINA_FN vec4 nodePower(vec4 a, vec4 b) {
    return vec4(powerOrZero(a.x, b.x), powerOrZero(a.y, b.y), powerOrZero(a.z, b.z),
                powerOrZero(a.w, b.w));
}
PATINA_FN vec4 nodeMin(vec4 a, vec4 b) {
    return min(a, b);
}
PATINA_FN vec4 nodeMax(vec4 a, vec4 b) {
    return max(a, b);
}
PATINA_FN vec4 nodeClamp(vec4 x, vec4 low, vec4 high) {
    return min(max(x, low), high);
}
PATINA_FN vec4 nodeMix(vec4 fg, vec4 bg, vec4 share) {
    return bg + (fg - bg) * share;
}
PATINA_FN vec4 nodeInvert(vec4 x, vec4 amount) {
    return amount - x;
}
PATINA_FN vec4 nodeAbsolute(vec4 x) {
    return abs(x);
}
PATINA_FN float signOf(float x) {
    return float(x > 0.0f) - float(x < 0.0f);
}
PATINA_FN vec4 nodeSign(vec4 x) {
    return vec4(signOf(x.x), signOf(x.y), signOf(x.z), signOf(x.w));
}
PATINA_FN vec4 nodeFloor(vec4 x) {
    return floor(x);
}
PATINA_FN vec4 nodeCeil(vec4 x) {
    return ceil(x);
}
PATINA_FN vec4 nodeRound(vec4 x) {
    return vec4(roundAway(x.x), roundAway(x.y), roundAway(x.z), roundAway(x.w));
}
PATINA_FN vec4 nodeFract(vec4 x) {
    return x - floor(x);
}
PATINA_FN vec4 nodeSqrt(vec4 x) {
    return sqrt(max(x, vec4(0.0f)));
}
PATINA_FN vec4 nodeLog(vec4 x) {
    return log(max(x, vec4(1e-37f)));
}
PATINA_FN vec4 nodeExp(vec4 x) {
    return exp(min(x, vec4(80.0f)));
}
PATINA_FN vec4 nodeSin(vec4 x) {
    return sin(x);
}
PATINA_FN vec4 nodeCos(vec4 x) {
    return cos(x);
}
PATINA_FN vec4 nodeTan(vec4 x) {
    return tan(x);
}
PATINA_FN vec4 nodeAsin(vec4 x) {
    return vec4(arcsine(x.x), arcsine(x.y), arcsine(x.z), arcsine(x.w));
}
PATINA_FN vec4 nodeAcos(vec4 x) {
    return vec4(arccosine(x.x), arccosine(x.y), arccosine(x.z), arccosine(x.w));
}
PATINA_FN vec4 nodeAtan2(vec4 y, vec4 x) {
    return vec4(atan(y.x, x.x), atan(y.y, x.y), atan(y.z, x.z), atan(y.w, x.w));
}
PATINA_FN float nodeTriangleWave(float x) {
    float a = abs(x);
    return 0.5f - abs(a - floor(a) - 0.5f);
}

PATINA_FN float smoothBetween(float x, float low, float high) {
    float t = high > low ? clamp((x - low) / (high - low), 0.0f, 1.0f) : float(x >= high);
    return t * t * (3.0f - 2.0f * t);
}
PATINA_FN vec4 nodeSmoothstep(vec4 x, vec4 low, vec4 high) {
    return vec4(smoothBetween(x.x, low.x, high.x), smoothBetween(x.y, low.y, high.y),
                smoothBetween(x.z, low.z, high.z), smoothBetween(x.w, low.w, high.w));
}

PATINA_FN float remapped(float x, float low, float high, float outLow, float outHigh) {
    float t = dividedOrZero(x - low, high - low);
    return outLow + t * (outHigh - outLow);
}
PATINA_FN vec4 nodeRemap(vec4 x, vec4 low, vec4 high, vec4 outLow, vec4 outHigh) {
    return vec4(remapped(x.x, low.x, high.x, outLow.x, outHigh.x),
                remapped(x.y, low.y, high.y, outLow.y, outHigh.y),
                remapped(x.z, low.z, high.z, outLow.z, outHigh.z),
                remapped(x.w, low.w, high.w, outLow.w, outHigh.w));
}
