// SPDX-License-Identifier: Apache-2.0
layout(location = 7) uniform vec4 meshLight; // w: modes of RasterMeshLight
layout(location = 13) uniform int meshFilters; // in lightTables: where those of the mesh light stand, place by place; -1 none

// What a surface gives off to the camera: its material's emission, and what a mesh light makes of it.
vec3 glow() {
    vec3 own = materialEmission(point.view);
    if (meshLight.w == 0.0) return own;
    vec3 light = dot(point.geometricNormal, point.view) > 0.0 ? meshLight.rgb : vec3(0.0);
#ifdef LIGHT_FILTERS
    if (meshFilters >= 0)
        light *= filtersToCamera(int(lightTables[meshFilters + vIds.w].x), point.position, -point.view);
#endif
    if (meshLight.w == 3.0) return light;
    return meshLight.w == 1.0 && MATERIAL_GLOWS ? light * own : light + own;
}
