// SPDX-License-Identifier: Apache-2.0
// Geometry of a scene edit.

#include "plugin/python/sceneEdit.h"
#include "hdDelegate/geometry/curveForms.h"
#include "hdDelegate/geometry/nurbs.h"
#include "hdDelegate/geometry/tetSurface.h"
#include "plugin/python/fields.h"

namespace py = pybind11;

namespace patina {

namespace {

Fields& readCommon(Fields& fields, Geometry& g, PythonEdit& edit) {
    Marks marks;
    fields.read("group", g.group)
        .read("transform", g.transform)
        .read("visibility", g.visibility)
        .read("catching", g.catching)
        .read("matte_name", g.matteName)
        .read("asset_name", g.assetName)
        .read("material", g.material)
        .read("subsets", g.subsets)
        .read("primvars", g.primvars)
        .read("categories", g.categories)
        .read("double_sided", g.doubleSided)
        .read("left_handed", g.leftHanded)
        .read("light_group", g.lightGroup)
        .read("marks", marks);
    applyMarks(marks, g, g.path, edit.scene->diagnostics());
    return fields;
}

void setMesh(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    auto mesh = std::make_shared<Mesh>();
    mesh->path = path;
    Fields fields("set_mesh", path, values);
    readCommon(fields, *mesh, edit)
        .read("points", mesh->points)
        .read("face_vertex_counts", mesh->faceVertexCounts)
        .read("face_vertex_indices", mesh->faceVertexIndices)
        .read("hole_indices", mesh->holeIndices)
        .read("scheme", mesh->scheme)
        .read("interpolate_boundary", mesh->interpolateBoundary)
        .read("face_varying_linear_interpolation", mesh->faceVaryingLinearInterpolation)
        .read("triangle_subdivision_rule", mesh->triangleSubdivisionRule)
        .read("crease_indices", mesh->creaseIndices)
        .read("crease_lengths", mesh->creaseLengths)
        .read("crease_sharpnesses", mesh->creaseSharpnesses)
        .read("corner_indices", mesh->cornerIndices)
        .read("corner_sharpnesses", mesh->cornerSharpnesses)
        .read("refine_level", mesh->refineLevel)
        .finish();
    edit.set(std::shared_ptr<const Geometry>(std::move(mesh)));
}

void setCurves(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    auto curves = std::make_shared<Curves>();
    curves->path = path;
    Fields fields("set_curves", path, values);
    readCommon(fields, *curves, edit)
        .read("points", curves->points)
        .read("curve_vertex_counts", curves->curveVertexCounts)
        .read("basis", curves->basis)
        .read("wrap", curves->wrap)
        .finish();
    edit.set(std::shared_ptr<const Geometry>(std::move(curves)));
}

void setNurbsPatch(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    auto mesh = std::make_shared<Mesh>();
    auto patch = std::make_shared<NurbsPatch>();
    mesh->path = path;
    std::vector<double> rangeU, rangeV;
    Fields fields("set_nurbs_patch", path, values);
    readCommon(fields, *mesh, edit)
        .read("points", mesh->points)
        .read("u_vertex_count", patch->u.vertexCount)
        .read("v_vertex_count", patch->v.vertexCount)
        .read("u_order", patch->u.order)
        .read("v_order", patch->v.order)
        .read("u_knots", patch->u.knots)
        .read("v_knots", patch->v.knots)
        .read("u_range", rangeU)
        .read("v_range", rangeV)
        .read("weights", patch->weights)
        .read("trim_counts", patch->trim.counts)
        .read("trim_orders", patch->trim.orders)
        .read("trim_vertex_counts", patch->trim.vertexCounts)
        .read("trim_knots", patch->trim.knots)
        .read("trim_ranges", patch->trim.ranges)
        .read("trim_points", patch->trim.points)
        .read("trim_keep_inside", patch->trim.keepInside)
        .read("refine_level", mesh->refineLevel)
        .finish();
    if (rangeU.size() == 2) patch->u.low = rangeU[0], patch->u.high = rangeU[1];
    if (rangeV.size() == 2) patch->v.low = rangeV[0], patch->v.high = rangeV[1];
    for (NurbsDirection* direction : {&patch->u, &patch->v})
        fillKnots(*direction);
    mesh->patch = std::move(patch);
    setNurbsCage(*mesh);
    edit.set(std::shared_ptr<const Geometry>(std::move(mesh)));
}

void setTetMesh(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    TetMesh mesh;
    mesh.path = path;
    Fields fields("set_tet_mesh", path, values);
    readCommon(fields, mesh, edit)
        .read("points", mesh.points)
        .read("tets", mesh.tets)
        .read("surface", mesh.surface)
        .finish();
    edit.set(std::shared_ptr<const Geometry>(surfaceOf(mesh, edit.scene->diagnostics())));
}

void setHermiteCurves(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    HermiteCurves curves;
    curves.path = path;
    Fields fields("set_hermite_curves", path, values);
    readCommon(fields, curves, edit)
        .read("points", curves.points)
        .read("tangents", curves.tangents)
        .read("curve_vertex_counts", curves.curveVertexCounts)
        .finish();
    edit.set(std::shared_ptr<const Geometry>(toBezier(curves, edit.scene->diagnostics())));
}

void setNurbsCurves(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    NurbsCurves curves;
    curves.path = path;
    Fields fields("set_nurbs_curves", path, values);
    readCommon(fields, curves, edit)
        .read("points", curves.points)
        .read("curve_vertex_counts", curves.curveVertexCounts)
        .read("orders", curves.orders)
        .read("knots", curves.knots)
        .read("ranges", curves.ranges)
        .read("weights", curves.weights)
        .finish();
    edit.set(std::shared_ptr<const Geometry>(toBezier(curves, edit.scene->diagnostics())));
}

void setPoints(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    auto points = std::make_shared<Points>();
    points->path = path;
    Fields fields("set_points", path, values);
    readCommon(fields, *points, edit).read("points", points->points).finish();
    edit.set(std::shared_ptr<const Geometry>(std::move(points)));
}

void setImplicit(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    auto implicit = std::make_shared<Implicit>();
    implicit->path = path;
    Fields fields("set_implicit", path, values);
    readCommon(fields, *implicit, edit)
        .read("shape", implicit->shape)
        .read("axis", implicit->axis)
        .read("radius", implicit->radius)
        .read("radius_top", implicit->radiusTop)
        .read("height", implicit->height)
        .read("size", implicit->size)
        .read("width", implicit->width)
        .read("length", implicit->length)
        .finish();
    edit.set(std::shared_ptr<const Geometry>(std::move(implicit)));
}

void setVolume(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    auto volume = std::make_shared<Volume>();
    volume->path = path;
    std::vector<std::string> names, files, grids;
    Fields fields("set_volume", path, values);
    readCommon(fields, *volume, edit)
        .read("field_names", names)
        .read("field_files", files)
        .read("field_grids", grids)
        .read("light", volume->light)
        .finish();
    if (files.size() != names.size() || grids.size() != names.size())
        throw py::value_error("set_volume: " + path +
                              ": needs as many field_files and field_grids as field_names");
    for (size_t i = 0; i < names.size(); ++i)
        volume->fields.push_back({names[i], files[i], grids[i], nullptr});
    edit.set(std::shared_ptr<const Geometry>(std::move(volume)));
}

void setSplats(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    auto splats = std::make_shared<Splats>();
    splats->path = path;
    SplatCloud cloud;
    Fields fields("set_splats", path, values);
    readCommon(fields, *splats, edit)
        .read("shape", cloud.shape)
        .read("positions", cloud.positions)
        .read("orientations", cloud.orientations)
        .read("scales", cloud.scales)
        .read("opacities", cloud.opacities)
        .read("degree", cloud.degree)
        .read("harmonics", cloud.harmonics)
        .read("color_space", splats->colorSpace)
        .finish();
    setCloud(*splats, std::move(cloud), edit.scene->diagnostics());
    edit.set(std::shared_ptr<const Geometry>(std::move(splats)));
}

void setInstancer(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    auto instancer = std::make_shared<Instancer>();
    instancer->path = path;
    Fields fields("set_instancer", path, values);
    fields.read("group", instancer->group)
        .read("prototypes", instancer->prototypes)
        .read("prototype_indices", instancer->prototypeIndices)
        .read("transforms", instancer->transforms)
        .read("ids", instancer->ids)
        .read("categories", instancer->categories)
        .read("primvars", instancer->primvars)
        .read("visibility", instancer->visibility)
        .read("names", instancer->names)
        .read("assets", instancer->assets)
        .read("asset_name", instancer->assetName)
        .finish();
    if (instancer->transforms.size() != instancer->prototypeIndices.size())
        throw py::value_error("set_instancer: " + path +
                              ": needs as many transforms as prototype_indices");
    edit.set(std::shared_ptr<const Instancer>(std::move(instancer)));
}

} // namespace

void bindSceneGeometry(py::class_<PythonEdit>& edit) {
    edit.def("set_mesh", &setMesh, py::arg("path"),
             "A UsdGeomMesh; keywords are the fields of Mesh.")
        .def("set_curves", &setCurves, py::arg("path"),
             "A UsdGeomBasisCurves; keywords are the fields of Curves.")
        .def(
            "set_nurbs_patch", &setNurbsPatch, py::arg("path"),
            "A UsdGeomNurbsPatch; weights are one per point, ranges two numbers; trim points three "
            "each: u and v, multiplied by w, and w.")
        .def("set_tet_mesh", &setTetMesh, py::arg("path"),
             "A UsdGeomTetMesh; tets are four indices of points each, surface three or nothing.")
        .def("set_hermite_curves", &setHermiteCurves, py::arg("path"),
             "A UsdGeomHermiteCurves, as Bezier curves.")
        .def("set_nurbs_curves", &setNurbsCurves, py::arg("path"),
             "A UsdGeomNurbsCurves, as Bezier curves; ranges are two numbers per curve.")
        .def("set_points", &setPoints, py::arg("path"),
             "A UsdGeomPoints; keywords are the fields of Points.")
        .def("set_implicit", &setImplicit, py::arg("path"),
             "Sphere, cube, cone, cylinder, capsule or plane.")
        .def("set_volume", &setVolume, py::arg("path"),
             "A UsdVolVolume; fields are given by their names, files and the grids in the files. "
             "light: "
             "what its glow gives to others, over what is seen of it, 1 by default.")
        .def("set_splats", &setSplats, py::arg("path"),
             "A UsdVolParticleField; shape is that of its kernels, orientations are quaternions, "
             "the real part "
             "first.")
        .def("set_instancer", &setInstancer, py::arg("path"),
             "Copies of groups; keywords are Instancer's fields.");
}

} // namespace patina
