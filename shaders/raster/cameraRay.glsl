// SPDX-License-Identifier: Apache-2.0
// The camera's ray through the place in the window that a fragment shows.
in vec2 vWindow;

// Whence it starts and where it goes, and from where to where it sees anything that has a place.
vec2 cameraRay(out vec3 start, out vec3 direction) {
    vec4 near = clipToWorld * vec4(vWindow, -1.0, 1.0);
    start = near.xyz / near.w;
    direction = isPerspective != 0 ? normalize(start - eye) : forward;
    // The near plane is fitted to surfaces and volumes; lights may be before it.
    float cosine = max(dot(direction, forward), 1e-6);
    start -= direction * (nearShift / cosine);
    vec2 seen = vec2(0.0, farReach / cosine);
    for (int i = 0; i < planes; ++i) {
        float before = dot(clipPlanes[i], vec4(start, 1.0)), slope = dot(clipPlanes[i].xyz, direction);
        if (slope > 0.0)
            seen.x = max(seen.x, -before / slope);
        else if (slope < 0.0)
            seen.y = min(seen.y, -before / slope);
        else if (before < 0.0)
            seen.y = 0.0;
    }
    return seen;
}
