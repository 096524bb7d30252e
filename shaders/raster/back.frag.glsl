// SPDX-License-Identifier: Apache-2.0
// The nearest faces that are turned away from the camera.
layout(location = 0) out vec4 outPosition;
layout(location = 1) out vec4 outNormal;
void main() {
    setPointFromCamera();
    if (dot(point.geometricNormal, point.view) >= 0.0) discard;
    outPosition = vec4(point.position, 1.0);
    outNormal = vec4(point.normal, 0.0);
}
