#include "hdDelegate/embree/embreeGeometry.h"

#include <algorithm>

namespace patina {

namespace {

void shareBuffer(RTCGeometry geometry, RTCBufferType type, unsigned slot, RTCFormat format,
                 const void* data, size_t stride, size_t count) {
    rtcSetSharedGeometryBuffer(geometry, type, slot, format, data, 0, stride, count);
}

RTCGeometry makeTriangles(RTCDevice device, const TriangleMesh& mesh,
                          const std::vector<uvec3>& triangles) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryTimeStepCount(geometry, unsigned(mesh.positions.size()));
    for (size_t step = 0; step < mesh.positions.size(); ++step)
        shareBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, unsigned(step), RTC_FORMAT_FLOAT3,
                    mesh.positions[step].data(), sizeof(vec3), mesh.positions[step].size());
    shareBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(),
                sizeof(uvec3), triangles.size());
    return geometry;
}

RTCGeometryType curveType(const CurveSet& curves) {
    const bool ribbon = !curves.normals.empty();
    switch (curves.basis) {
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

RTCGeometry makeCurves(RTCDevice device, const CurveSet& curves) {
    RTCGeometry geometry = rtcNewGeometry(device, curveType(curves));
    rtcSetGeometryTimeStepCount(geometry, unsigned(curves.controlPoints.size()));
    for (size_t step = 0; step < curves.controlPoints.size(); ++step) {
        shareBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, unsigned(step), RTC_FORMAT_FLOAT4,
                    curves.controlPoints[step].data(), sizeof(vec4),
                    curves.controlPoints[step].size());
        if (!curves.normals.empty() && curves.basis != CurveBasis::Linear)
            shareBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, unsigned(step), RTC_FORMAT_FLOAT3,
                        curves.normals[std::min(step, curves.normals.size() - 1)].data(),
                        sizeof(vec3), curves.controlPoints[step].size());
    }
    shareBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, curves.segments.data(),
                sizeof(uint32_t), curves.segments.size());
    return geometry;
}

RTCGeometry makePoints(RTCDevice device, const PointSet& points) {
    const bool disks = !points.normals.empty();
    RTCGeometry geometry = rtcNewGeometry(device, disks ? RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT
                                                        : RTC_GEOMETRY_TYPE_SPHERE_POINT);
    rtcSetGeometryTimeStepCount(geometry, unsigned(points.points.size()));
    for (size_t step = 0; step < points.points.size(); ++step) {
        shareBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, unsigned(step), RTC_FORMAT_FLOAT4,
                    points.points[step].data(), sizeof(vec4), points.points[step].size());
        if (disks)
            shareBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, unsigned(step), RTC_FORMAT_FLOAT3,
                        points.normals[std::min(step, points.normals.size() - 1)].data(),
                        sizeof(vec3), points.points[step].size());
    }
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
    const std::vector<uvec3>& triangles = surface.topology().triangles;
    if (surface.shape == Surface::Shape::Triangles && !triangles.empty())
        return makeTriangles(device, surface.mesh, triangles);
    if (surface.shape == Surface::Shape::Curves && !surface.curves.segments.empty())
        return makeCurves(device, surface.curves);
    if (surface.shape == Surface::Shape::Points && !surface.points.points.empty() &&
        !surface.points.points[0].empty())
        return makePoints(device, surface.points);
    return nullptr;
}

} // namespace patina
