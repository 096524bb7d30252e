// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/sceneDump.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <sstream>

namespace patina {

namespace {

const char* const interpolationNames[] = {"constant", "uniform", "varying", "vertex",
                                          "faceVarying"};
const char* const kernelNames[] = {"gaussianEllipsoid", "gaussianSurflet", "constantSurflet"};
const char* const schemeNames[] = {"none", "catmullClark", "loop", "bilinear"};
const char* const basisNames[] = {"linear", "bezier", "bspline", "catmullRom"};
const char* const wrapNames[] = {"nonperiodic", "periodic", "pinned"};
const char* const projectionNames[] = {"standard",         "fisheyeEquidistant",
                                       "fisheyeEquisolid", "fisheyeStereographic",
                                       "cylindrical",      "spherical"};
const char* const stereoNames[] = {"mono", "left", "right", "sideBySide", "overUnder"};
const char* const shapeNames[] = {"sphere", "cube", "cone", "cylinder", "capsule", "plane"};

std::string number(double x) {
    if (x == 0.0) return "0"; // no negative zero
    char text[32];
    std::snprintf(text, sizeof(text), "%.6g", x);
    return text;
}

std::string text(const std::string& s) {
    return '"' + s + '"';
}
std::string text(double x) {
    return number(x);
}
std::string text(bool x) {
    return x ? "true" : "false";
}

/// Writes the fields of prims, leaving out what is as the default.
class Writer {
public:
    explicit Writer(int maxValues) : _maxValues(size_t(maxValues < 0 ? 0 : maxValues)) {}

    void prim(const std::string& kind, const std::string& path) {
        _out << kind << ' ' << path << '\n';
    }
    template <class T> void field(const char* name, const T& value, const T& fallback) {
        if (value != fallback) line(name, text(value));
    }
    void field(const char* name, float value, float fallback) {
        if (value != fallback) line(name, number(value));
    }
    void field(const char* name, int value, int fallback) {
        if (value != fallback) line(name, number(value));
    }
    void line(const std::string& name, const std::string& value) {
        _out << "  " << name << " = " << value << '\n';
    }
    /// @param group numbers that belong together
    template <class T>
    void array(const std::string& name, const T* data, size_t count, int group = 1) {
        if (count) line(name, list(data, count, group));
    }
    void array(const std::string& name, const std::vector<int>& v) {
        array(name, v.data(), v.size());
    }
    void array(const std::string& name, const std::vector<float>& v) {
        array(name, v.data(), v.size());
    }
    void array(const std::string& name, const std::vector<double>& v) {
        array(name, std::vector<float>(v.begin(), v.end()));
    }
    void names(const std::string& name, const std::vector<std::string>& v) {
        if (v.empty()) return;
        std::string all;
        for (const std::string& s : v)
            all += (all.empty() ? "" : " ") + s;
        line(name, all);
    }
    void transform(const std::string& name, const MotionTransform& m) {
        if (!m.moves() && !m.empty() && m.first() == dmat4(1.0)) return;
        for (size_t i = 0; i < m.values.size(); ++i) {
            const mat4 value(m.values[i]);
            array(timed(name, m.times, i), &value[0][0], 16, 4);
        }
    }
    void points(const Sampled<std::vector<vec3>>& p) {
        for (size_t i = 0; i < p.values.size(); ++i)
            if (!p.values[i].empty())
                array(timed("points", p.times, i), &p.values[i][0].x, 3 * p.values[i].size(), 3);
    }
    std::string str() const { return _out.str(); }

private:
    static std::string timed(const std::string& name, const std::vector<float>& times, size_t i) {
        return times.size() > 1 ? name + "@" + number(times[i]) : name;
    }
    template <class T> std::string list(const T* data, size_t count, int group) const {
        std::string all;
        const size_t shown = count <= _maxValues ? count : _maxValues - _maxValues % size_t(group);
        for (size_t i = 0; i < shown; ++i)
            all += (i == 0              ? ""
                    : i % size_t(group) ? " "
                                        : (group > 1 ? ", " : " ")) +
                   number(double(data[i]));
        if (shown < count) {
            // FNV-1a over the rounded text of what is not shown would be slow; bits are enough.
            uint32_t hash = 2166136261u;
            for (size_t i = shown; i < count; ++i) {
                uint32_t bits;
                static_assert(sizeof(T) == sizeof(bits), "floats and ints");
                std::memcpy(&bits, &data[i], sizeof(bits));
                hash = (hash ^ bits) * 16777619u;
            }
            char tail[64];
            std::snprintf(tail, sizeof(tail), "%s... %zu values, %08x", all.empty() ? "" : " ",
                          count, hash);
            all += tail;
        }
        return all;
    }

    std::ostringstream _out;
    size_t _maxValues;
};

void writePrimvars(Writer& w, const std::vector<Primvar>& primvars) {
    for (const Primvar& p : primvars) {
        std::string name = "primvar " + p.name + " " + interpolationNames[int(p.interpolation)];
        if (p.components > 1) name += " x" + std::to_string(p.components);
        w.array(name, p.values.data(), p.values.size(), p.components);
        w.array("primvar " + p.name + " indices", p.indices);
    }
}

/// @param whose the first words of the names
void writeMarks(Writer& w, const Marked& marks, const std::string& whose = {}) {
    const auto field = [&](const char* name, bool value, bool fallback) {
        w.field((whose + name).c_str(), value, fallback);
    };
    field("visibility camera", marks.visibility.camera, true);
    field("visibility diffuse", marks.visibility.diffuse, true);
    field("visibility shadow", marks.visibility.shadow, true);
    field("visibility specular", marks.visibility.specular, true);
    field("visibility transmission", marks.visibility.transmission, true);
    field("visibility volume", marks.visibility.volume, true);
    field("matte", marks.catching.matte, false);
    field("catches shadows", marks.catching.shadows, false);
    field("catches reflections", marks.catching.reflections, false);
    field("dielectricPriority", marks.dielectricPriority, 0);
    if (!marks.matteName.empty()) w.line(whose + "matteName", text(marks.matteName));
}

void writeDirection(Writer& w, const std::string& name, const NurbsDirection& d) {
    w.line(name, std::to_string(d.vertexCount) + " order " + std::to_string(d.order));
    w.array(name + " knots", d.knots);
    if (d.low < d.high) w.array(name + " range", std::vector<double>{d.low, d.high});
}

void writeMesh(Writer& w, const Mesh& m) {
    const Mesh d;
    w.points(m.points);
    w.array("faceVertexCounts", m.faceVertexCounts);
    w.array("faceVertexIndices", m.faceVertexIndices);
    w.array("holeIndices", m.holeIndices);
    if (m.scheme != d.scheme) w.line("scheme", schemeNames[int(m.scheme)]);
    w.field("interpolateBoundary", m.interpolateBoundary, d.interpolateBoundary);
    w.field("faceVaryingLinearInterpolation", m.faceVaryingLinearInterpolation,
            d.faceVaryingLinearInterpolation);
    w.field("triangleSubdivisionRule", m.triangleSubdivisionRule, d.triangleSubdivisionRule);
    w.array("creaseIndices", m.creaseIndices);
    w.array("creaseLengths", m.creaseLengths);
    w.array("creaseSharpnesses", m.creaseSharpnesses);
    w.array("cornerIndices", m.cornerIndices);
    w.array("cornerSharpnesses", m.cornerSharpnesses);
    w.field("refineLevel", m.refineLevel, d.refineLevel);
    if (!m.patch) return;
    writeDirection(w, "patch u", m.patch->u);
    writeDirection(w, "patch v", m.patch->v);
    w.array("patch weights", m.patch->weights);
    const TrimCurves& trim = m.patch->trim;
    w.array("trim counts", trim.counts);
    w.array("trim orders", trim.orders);
    w.array("trim vertexCounts", trim.vertexCounts);
    w.array("trim knots", trim.knots);
    w.array("trim ranges", trim.ranges);
    w.array("trim points", trim.points);
    w.field("trim keepInside", trim.keepInside, false);
}

void writeSplats(Writer& w, const Splats& s) {
    const SplatCloud& c = *s.cloud;
    const auto floats = [&](const char* name, const auto& values, int components) {
        if (!values.empty())
            w.array(name, &values[0].x, size_t(components) * values.size(), components);
    };
    if (c.shape != SplatShape::GaussianEllipsoid) w.line("shape", kernelNames[int(c.shape)]);
    floats("positions", c.positions, 3);
    floats("orientations", c.orientations, 4);
    floats("scales", c.scales, 3);
    w.array("opacities", c.opacities);
    w.field("degree", c.degree, 0);
    floats("harmonics", c.harmonics, 3);
    w.field("colorSpace", s.colorSpace, std::string());
}

void writeImplicit(Writer& w, const Implicit& i) {
    const Implicit d;
    w.line("shape", shapeNames[int(i.shape)]);
    w.field("axis", i.axis, d.axis);
    w.field("radius", i.radius, d.radius);
    w.field("radiusTop", i.radiusTop, d.radiusTop);
    w.field("height", i.height, d.height);
    w.field("size", i.size, d.size);
    w.field("width", i.width, d.width);
    w.field("length", i.length, d.length);
}

void writeVector(Writer& w, const char* name, const vec3& v, const vec3& fallback) {
    if (v != fallback) w.array(name, &v.x, 3);
}

void writeGeometry(Writer& w, const Geometry& g) {
    static const char* const kinds[] = {"Mesh", "Curves", "Points", "Implicit", "Volume", "Splats"};
    w.prim(kinds[int(g.kind)], g.path);
    w.field("group", g.group, std::string());
    w.transform("transform", g.transform);
    writeMarks(w, g);
    w.field("material", g.material, std::string());
    w.field("doubleSided", g.doubleSided, true);
    w.field("leftHanded", g.leftHanded, false);
    w.field("lightGroup", g.lightGroup, std::string());
    w.names("categories", g.categories);
    if (const auto* mesh = dynamic_cast<const Mesh*>(&g)) writeMesh(w, *mesh);
    if (const auto* implicit = dynamic_cast<const Implicit*>(&g)) writeImplicit(w, *implicit);
    if (const auto* points = dynamic_cast<const Points*>(&g)) w.points(points->points);
    if (const auto* curves = dynamic_cast<const Curves*>(&g)) {
        w.points(curves->points);
        w.array("curveVertexCounts", curves->curveVertexCounts);
        w.line("basis", basisNames[int(curves->basis)]);
        if (curves->wrap != CurveWrap::Nonperiodic) w.line("wrap", wrapNames[int(curves->wrap)]);
    }
    if (const auto* volume = dynamic_cast<const Volume*>(&g)) {
        writeVector(w, "light", volume->light, vec3(1.0f));
        for (const VolumeField& f : volume->fields)
            w.line("field " + f.name, text(f.file) + " " + text(f.field));
    }
    if (const auto* splats = dynamic_cast<const Splats*>(&g)) writeSplats(w, *splats);
    for (const GeomSubset& s : g.subsets)
        w.array("subset " + s.path + " material " + text(s.material), s.faces);
    writePrimvars(w, g.primvars);
}

void writeInstancer(Writer& w, const Instancer& i) {
    w.prim("Instancer", i.path);
    w.field("group", i.group, std::string());
    writeMarks(w, {i.visibility, {}, {}, {}});
    w.names("prototypes", i.prototypes);
    w.array("prototypeIndices", i.prototypeIndices);
    for (size_t k = 0; k < i.transforms.size() && k < 64; ++k)
        w.transform("transform " + std::to_string(k), i.transforms[k]);
    w.line("instances", std::to_string(i.transforms.size()));
    for (size_t k = 0; k < i.marks.size() && k < 64; ++k)
        writeMarks(w, i.marks[k], "instance " + std::to_string(k) + " ");
    w.array("ids", i.ids);
    for (size_t k = 0; k < i.categories.size() && k < 64; ++k)
        w.names("categories " + std::to_string(k), i.categories[k]);
    writePrimvars(w, i.primvars);
}

void writeInput(Writer& w, const std::string& name, float v, float d) {
    w.field(name.c_str(), v, d);
}
void writeInput(Writer& w, const std::string& name, bool v, bool d) {
    w.field(name.c_str(), v, d);
}
void writeInput(Writer& w, const std::string& name, const std::string& v, const std::string& d) {
    w.field(name.c_str(), v, d);
}
void writeInput(Writer& w, const std::string& name, const vec3& v, const vec3& d) {
    writeVector(w, name.c_str(), v, d);
}
void writeInput(Writer& w, const std::string& name, const std::vector<float>& v,
                const std::vector<float>&) {
    w.array(name, v);
}
void writeInput(Writer& w, const std::string& name, const std::vector<vec3>& v,
                const std::vector<vec3>&) {
    if (!v.empty()) w.array(name, &v[0].x, 3 * v.size(), 3);
}

void writeFilter(Writer& w, const LightFilter& f) {
    const LightFilter d;
    w.line("filter", f.path);
    w.line("filter.type", lightFilterRows[int(f.type)].word);
    w.transform("filter.transform", f.transform);
#define PATINA_FILTER_INPUT(type, field_, names, fallback, description)                            \
    writeInput(w, "filter." #field_, f.field_, d.field_);
#include "hdDelegate/scene/lightFilterInputs.inc"
}

void writeNetwork(Writer& w, const Network& network) {
    for (const auto& [name, c] : network.terminals)
        w.line("terminal " + name, c.node + (c.output.empty() ? "" : "." + c.output));
    for (const NetworkNode& node : network.nodes) {
        w.line("node " + node.path, node.id);
        for (const auto& [name, value] : node.inputs) {
            const std::string label = "  " + std::string(valueTypeName(value.type)) + " " + name;
            if (valueTypeComponents(value.type) == 0)
                w.line(label, text(value.text));
            else
                w.array(label, value.numbers);
            if (!value.colorSpace.empty()) w.line("  colorSpace " + name, value.colorSpace);
        }
        for (const auto& [name, c] : node.connections)
            w.line("  connect " + name, c.node + (c.output.empty() ? "" : "." + c.output));
    }
}

void writeLight(Writer& w, const Light& l) {
    const Light d;
    w.prim("Light", l.path);
    w.line("type", lightRow(l.type).word);
    w.field("group", l.group, d.group);
    w.transform("transform", l.transform);
    w.field("visible", l.visible, d.visible);
    w.field("cameraVisible", l.cameraVisible, d.cameraVisible);
#define PATINA_LIGHT_INPUT(group, type, field_, key, input, fallback, description)                 \
    writeInput(w, #field_, l.field_, d.field_);
#include "hdDelegate/scene/lightTypes.inc"
    w.field("textureColorSpace", l.textureColorSpace, d.textureColorSpace);
    if (!l.network.empty()) writeNetwork(w, l.network);
    w.field("shapingConeAuthored", l.shapingConeAuthored, d.shapingConeAuthored);
    w.field("lightLink", l.lightLink, d.lightLink);
    w.field("shadowLink", l.shadowLink, d.shadowLink);
    for (const LightFilter& filter : l.filters)
        writeFilter(w, filter);
    for (const LightPortal& portal : l.portals) {
        w.line("portal", portal.path);
        w.transform("portal.transform", portal.transform);
        w.field("portal.width", portal.width, 1.0f);
        w.field("portal.height", portal.height, 1.0f);
    }
    w.field("lightGroup", l.lightGroup, d.lightGroup);
    w.field("geometry", l.geometry, d.geometry);
    w.field("materialSyncMode", l.materialSyncMode, d.materialSyncMode);
}

void writeCamera(Writer& w, const Camera& c) {
    const Camera d;
    w.prim("Camera", c.path);
    w.transform("transform", c.transform);
    w.field("orthographic", c.orthographic, d.orthographic);
#define PATINA_CAMERA_INPUT(field_, key, Getter, unit, positive, fallback, description)            \
    w.field(#field_, c.field_, d.field_);
#include "hdDelegate/scene/cameraTypes.inc"
    w.field("clipNear", c.clipNear, d.clipNear);
    w.field("clipFar", c.clipFar, d.clipFar);
    if (!c.clippingPlanes.empty())
        w.array("clippingPlanes", &c.clippingPlanes[0].x, 4 * c.clippingPlanes.size(), 4);
    w.field("shutterOpen", c.shutterOpen, d.shutterOpen);
    w.field("shutterClose", c.shutterClose, d.shutterClose);
    w.field("exposureScale", c.exposureScale, d.exposureScale);
    const CameraLens &l = c.lens, n;
    if (!l.standard()) w.line("projection", projectionNames[int(l.projection)]);
    w.field("fieldOfView", l.fieldOfView, n.fieldOfView);
    w.field("verticalFieldOfView", l.verticalFieldOfView, n.verticalFieldOfView);
    w.field("apertureBlades", l.apertureBlades, n.apertureBlades);
    w.field("apertureBladeCurvature", l.apertureBladeCurvature, n.apertureBladeCurvature);
    w.field("apertureRotation", l.apertureRotation, n.apertureRotation);
    w.field("apertureAspect", l.apertureAspect, n.apertureAspect);
    if (l.stereo != n.stereo) w.line("stereo", stereoNames[int(l.stereo)]);
    w.field("interocularDistance", l.interocularDistance, n.interocularDistance);
    w.field("convergenceDistance", l.convergenceDistance, n.convergenceDistance);
    w.field("distortionMap", l.distortionMap, n.distortionMap);
    w.field("distortionK1", l.distortionK1, n.distortionK1);
    w.field("distortionK2", l.distortionK2, n.distortionK2);
}

} // namespace

std::string dumpScene(const SceneState& scene, int maxValues) {
    Writer w(maxValues);
    if (!scene.renderingSpace->isRec709())
        w.line("renderingColorSpace", scene.renderingSpace->name);
    if (scene.metersPerUnit != 0.01) w.line("metersPerUnit", number(scene.metersPerUnit));
    for (const auto& item : scene.cameras)
        writeCamera(w, *item.second);
    for (const auto& item : scene.geometry)
        writeGeometry(w, *item.second);
    for (const auto& item : scene.instancers)
        writeInstancer(w, *item.second);
    for (const auto& item : scene.lights)
        writeLight(w, *item.second);
    for (const auto& item : scene.materials)
        w.prim("Material", item.second->path), writeNetwork(w, item.second->network);
    return w.str();
}

} // namespace patina
