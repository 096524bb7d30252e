// SPDX-License-Identifier: Apache-2.0
layout(location = 0) out vec4 outPosition;
layout(location = 1) out vec4 outNormal;
layout(location = 2) out ivec4 outIds;
#ifdef AOV_ALBEDO
layout(location = 3) out vec4 outAlbedo;
#endif
#if AOV_PRIMVARS > 0
layout(location = 4) out vec4 outPrimvars[AOV_PRIMVARS];
layout(location = 8) uniform ivec4 aovSlots; // of the primvars asked for, -1 where there is none; number AOV_PREF then has the own position, w -1
#endif
#ifdef AOV_NG
layout(location = 4 + AOV_PRIMVARS) out vec4 outGeometricNormal;
#endif

void main() {
    setPointFromCamera();
#ifdef PRESENCE
    if (!isPresent()) discard;
#endif
    outPosition = vec4(point.position, (drawInfo.z & STRIP) != 0 ? 2.0 : 1.0); // see receivers.comp.glsl
    outNormal = vec4(point.normal, 0.0);
    outIds = ivec4(drawInfo.y, vIds.y, vIds.x, vIds.w);
#ifdef AOV_ALBEDO
    materialSetup();
    outAlbedo = vec4(materialAlbedo(), 0.0);
#endif
#if AOV_PRIMVARS > 0
    for (int i = 0; i < AOV_PRIMVARS; ++i)
        outPrimvars[i] = primvar(aovSlots[i], i == AOV_PREF ? vec4(vObjectPosition, -1.0) : vec4(0.0));
#endif
#ifdef AOV_NG
    outGeometricNormal = vec4(point.geometricNormal, 0.0);
#endif
}
