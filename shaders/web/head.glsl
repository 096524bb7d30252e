// SPDX-License-Identifier: Apache-2.0
// Begins every fragment shader of the material page (GLSL ES 3.00).
#include "shaders/web/inputs.glsl"

// The page evaluates samples where it evaluates light: a second copy of all lobes would cost drivers
// as much again to compile. The drawn lobe's own value waits in the sample.
int drawnLobe = -1;
MaterialSample pendingSample(MaterialSample s, LobeSample l, int drawn, vec3 weight, float chance) {
    bool reflects = (l.event & LOBE_REFLECT) != 0;
    drawnLobe = drawn;
    if (drawn < 0 || l.event == 0 ||
        isReflected(s.wi, point.geometricNormal, woOutside()) != reflects)
        return materialSampleNone();
    s.event = l.event;
    s.pdf = chance * l.pdf;
    bool delta = (l.event & LOBE_DELTA) != 0;
    vec3 own =
        delta ? drawnAlone(weight, l.weight, chance) : drawnValue(weight, l.weight, l.pdf);
    s.diffuseWeight = s.diffuse ? own : vec3(0.0);
    s.specularWeight = s.diffuse ? vec3(0.0) : own;
    return s;
}
#define finishSample pendingSample
