// SPDX-License-Identifier: Apache-2.0
// Sets `point`, which materials read, from what the vertex shader gives.
//
// eye: where the camera is, in world space; pixelAngle: radians across a pixel; pass: other seeds for
// materials that draw numbers.
void setPoint(vec3 eye, float pixelAngle, int pass) {
    vec3 dx = dFdx(vPosition), dy = dFdy(vPosition);
    vec3 view = eye - vPosition;
    float distance = length(view);
    point.view = view / max(distance, 1e-20);
    vec3 g = cross(dx, dy);
    float area = length(g);
    g = area > 0.0 ? g / area : point.view;
    if (dot(g, point.view) < 0.0) g = -g;
    point.geometricNormal = gl_FrontFacing ? g : -g;
    point.position = vPosition;
    point.objectPosition = vObjectPosition;
    point.normal = unitOr(vNormal, point.geometricNormal);
    if (dot(point.normal, point.geometricNormal) < 0.0) point.normal = -point.normal;
    vec3 t = vTangent.xyz - point.normal * dot(point.normal, vTangent.xyz);
    point.tangent = unitOr(t, anyTangent(point.normal));
    point.bitangent = cross(point.normal, point.tangent) * (vTangent.w < 0.0 ? -1.0 : 1.0);
    point.objectToWorldNormal = normalToWorld;
    vec2 ux = dFdx(vUv), uy = dFdy(vUv);
    float uvArea = abs(ux.x * uy.y - ux.y * uy.x);
    float perLength = sqrt(uvArea / max(area, 1e-20));
    float cosine = max(0.1, abs(dot(g, point.view)));
    point.uvFootprint = perLength * pixelAngle * distance / sqrt(cosine);
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    point.seed = noiseHash3(int(pixel.x), int(pixel.y), pass) | 1u;
}
