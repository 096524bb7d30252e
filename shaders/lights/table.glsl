// SPDX-License-Identifier: Apache-2.0
// Bilinear interpolation in tables that every host reads in its own way.

struct TableCell {
    int low; // places of four values: of a row, and of the row after it
    int lowNext;
    int high;
    int highNext;
    float across; // how far from a value to the next, and from a row to the next
    float along;
};

PATINA_FN vec3 tableMix(TableCell c, vec3 low, vec3 lowNext, vec3 high, vec3 highNext) {
    return (1.0f - c.along) * ((1.0f - c.across) * low + c.across * lowNext) +
           c.along * ((1.0f - c.across) * high + c.across * highNext);
}

// Of a table over directions, in even steps of theta (0 to pi) and, row by row, of phi (a whole turn; the last row
// is the first again). A single row is for every phi.
PATINA_FN TableCell directionCell(int thetas, int phis, float theta, float phi) {
    TableCell c;
    float turn = phi / TWO_PI;
    float x = theta * INV_PI * float(thetas - 1);
    float y = (turn - floor(turn)) * float(phis - 1);
    int i = min(int(x), thetas - 2);
    int k = max(min(int(y), phis - 2), 0);
    c.low = k * thetas + i;
    c.lowNext = c.low + 1;
    c.high = c.low + select(thetas, 0, phis > 1);
    c.highNext = c.high + 1;
    c.across = x - float(i);
    c.along = y - float(k);
    return c;
}
