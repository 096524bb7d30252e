layout(location = 0) out vec4 outPosition;
layout(location = 1) out vec4 outNormal;
layout(location = 2) out ivec4 outIds;

void main() {
    setPointFromCamera();
#ifdef PRESENCE
    if (!isPresent()) discard;
#endif
    outPosition = vec4(point.position, 1.0);
    outNormal = vec4(point.normal, 0.0);
    outIds = ivec4(drawInfo.y, vIds.y, vIds.x, 0);
}
