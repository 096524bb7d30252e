// SPDX-License-Identifier: Apache-2.0
// The image of cookies and gobos in the plane of the opening, its top towards y. Hosts read the texels.

const int IMAGE_OFF = 0; // beside it
const int IMAGE_CLAMP = 1;
const int IMAGE_REPEAT = 2;

struct FilterImage {
    vec2 size;   // in the filter's space; below 0 where it is mirrored
    vec2 center; // where its middle is
    int wrap;
    int width; // texels
    int height;
};

PATINA_FN int filterImageRow(int i, int size, bool repeats) {
    int turned = select(i + size, select(i - size, i, i >= size), i < 0);
    return max(min(select(turned, i, repeats), size - 1), 0);
}

// at: where light crosses the plane. @returns whether the image is there
PATINA_FN bool filterTexels(PATINA_IN(FilterImage) m, vec3 at, PATINA_OUT(TableCell) c) {
    float u = 0.5f + (at.x - m.center.x) / m.size.x;
    float v = 0.5f - (at.y - m.center.y) / m.size.y;
    bool within = u >= 0.0f && u <= 1.0f && v >= 0.0f && v <= 1.0f;
    bool repeats = m.wrap == IMAGE_REPEAT;
    u = clamp(select(u - floor(u), u, repeats), 0.0f, 1.0f) * float(m.width) - 0.5f;
    v = clamp(select(v - floor(v), v, repeats), 0.0f, 1.0f) * float(m.height) - 0.5f;
    int i = int(floor(u));
    int k = int(floor(v));
    int next = filterImageRow(i + 1, m.width, repeats);
    int low = filterImageRow(k, m.height, repeats) * m.width;
    int high = filterImageRow(k + 1, m.height, repeats) * m.width;
    c.across = u - float(i);
    c.along = v - float(k);
    i = filterImageRow(i, m.width, repeats);
    c.low = low + i;
    c.lowNext = low + next;
    c.high = high + i;
    c.highNext = high + next;
    return within || m.wrap != IMAGE_OFF;
}
