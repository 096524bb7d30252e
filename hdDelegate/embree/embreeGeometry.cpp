// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/embreeGeometry.h"

#include <algorithm>

namespace patina {

namespace {

void shareBuffer(RTCGeometry geometry, RTCBufferType type, unsigned slot, RTCFormat format,
                 const void* data, size_t stride, size_t count) {
    rtcSetSharedGeometryBuffer(geometry, type, slot, format, data, 0, stride, count);
}

void sharePoints(RTCGeometry geometry, const PlacedShape& placed) {
    rtcSetGeometryTimeStepCount(geometry, unsigned(placed.points.size()));
    for (size_t step = 0; step < placed.points.size(); ++step)
        shareBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, unsigned(step), RTC_FORMAT_FLOAT4,
                    placed.points[step].data(), sizeof(vec4), placed.points[step].size());
}

void shareNormals(RTCGeometry geometry, const PlacedShape& placed) {
    for (size_t step = 0; step < placed.points.size(); ++step)
        shareBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, unsigned(step), RTC_FORMAT_FLOAT3,
                    placed.normals[std::min(step, placed.normals.size() - 1)].data(), sizeof(vec3),
                    placed.points[step].size());
}

RTCGeometry makeTriangles(RTCDevice device, const std::vector<std::vector<vec3>>& positions,
                          const std::vector<uvec3>& triangles) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryTimeStepCount(geometry, unsigned(positions.size()));
    for (size_t step = 0; step < positions.size(); ++step)
        shareBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, unsigned(step), RTC_FORMAT_FLOAT3,
                    positions[step].data(), sizeof(vec3), positions[step].size());
    shareBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(),
                sizeof(uvec3), triangles.size());
    return geometry;
}

RTCGeometryType curveType(CurveBasis basis, bool ribbon) {
    switch (basis) {
    case CurveBasis::Bezier:
        return ribbon ? RTC_GEOMETRY_TYPE_NORMAL_ORIENTED_BEZIER_CURVE
                      : RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE;
    case CurveBasis::Bspline:
        return ribbon ? RTC_GEOMETRY_TYPE_NORMAL_ORIENTED_BSPLINE_CURVE
                      : RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE;
    case CurveBasis::CatmullRom:
        return ribbon ? RTC_GEOMETRY_TYPE_NORMAL_ORIENTED_CATMULL_ROM_CURVE
                      : RTC_GEOMETRY_TYPE_ROUND_CATMULL_ROM_CURVE;
    default: return RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE;
    }
}

RTCGeometry makeCurves(RTCDevice device, const CurveSet& curves, const PlacedShape& placed) {
    const bool ribbon = !placed.normals.empty();
    RTCGeometry geometry = rtcNewGeometry(device, curveType(curves.basis, ribbon));
    sharePoints(geometry, placed);
    if (ribbon && curves.basis != CurveBasis::Linear) shareNormals(geometry, placed);
    shareBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, curves.segments.data(),
                sizeof(uint32_t), curves.segments.size());
    return geometry;
}

RTCGeometry makePoints(RTCDevice device, const PlacedShape& placed) {
    const bool disks = !placed.normals.empty();
    RTCGeometry geometry = rtcNewGeometry(device, disks ? RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT
                                                        : RTC_GEOMETRY_TYPE_SPHERE_POINT);
    sharePoints(geometry, placed);
    if (disks) shareNormals(geometry, placed);
    return geometry;
}

RTCGeometry makeInstance(RTCDevice device, const Surface& surface) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, surface.shared->scene);
    rtcSetGeometryTimeStepCount(geometry, unsigned(surface.places.size()));
    for (size_t step = 0; step < surface.places.size(); ++step)
        rtcSetGeometryTransform(geometry, unsigned(step), RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                                &surface.places[step]);
    return geometry;
}

} // namespace

RTCGeometry makeGeometry(RTCDevice device, const Surface& surface) {
    if (surface.shared) return makeInstance(device, surface);
    const PrimShape& rest = *surface.rest;
    const PlacedShape& placed = surface.placed;
    if (surface.shape == Surface::Shape::Triangles && !rest.mesh.triangles.empty())
        return makeTriangles(device, placed.positions, rest.mesh.triangles);
    if (surface.shape == Surface::Shape::Curves && !rest.curves.segments.empty())
        return makeCurves(device, rest.curves, placed);
    if (surface.shape == Surface::Shape::Points && !placed.points.empty() &&
        !placed.points[0].empty())
        return makePoints(device, placed);
    return nullptr;
}

} // namespace patina
