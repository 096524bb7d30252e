// The numbers of shaders/raster/pass.glsl: the golden ratio's sequence, turned by a hash.
uint hash(uint x) { // PCG (Jarzynski and Olano 2020)
    uint s = x * 747796405u + 2891336453u;
    uint w = ((s >> ((s >> 28u) + 4u)) ^ s) * 277803737u;
    return (w >> 22u) ^ w;
}
float randomAt(uvec2 pixel, uint index, uint dimension) {
    uint h = hash(pixel.x + hash(pixel.y + hash(dimension)));
    uint axis = dimension % 3u;
    uint step = axis == 0u ? 3518319155u : (axis == 1u ? 2882110345u : 2360945575u);
    return float((h + index * step) >> 8u) * (1.0 / 16777216.0);
}
