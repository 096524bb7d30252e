// SPDX-License-Identifier: Apache-2.0
// Which lights reach and are blocked by a prim: rows of bits, one per category of links. The first
// number tells the words of a row.
layout(std430, binding = 9) readonly buffer Links { int links[]; };
bool isLinked(int row, int category) {
    if (category < 0) return true;
    int words = links[0];
    if (category >= 32 * words) return false;
    return (links[1 + row * words + category / 32] & (1 << (category & 31))) != 0;
}
