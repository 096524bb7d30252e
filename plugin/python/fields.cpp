// SPDX-License-Identifier: Apache-2.0
#include "plugin/python/fields.h"

#include <cstring>
#include <map>

namespace py = pybind11;

namespace patina {

namespace {

template <class T> using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

template <class T> Array<T> arrayOf(py::handle from) {
    Array<T> array = Array<T>::ensure(from);
    if (!array) {
        PyErr_Clear();
        throw py::value_error("is not an array of numbers");
    }
    return array;
}

/// Copies an array whose elements are N numbers each.
template <class T, int N, class Number> std::vector<T> elements(py::handle from) {
    static_assert(sizeof(T) == N * sizeof(Number), "elements are packed");
    const Array<Number> array = arrayOf<Number>(from);
    if (array.size() == 0) return {};
    if (array.size() % N != 0 || (array.ndim() > 1 && N > 1 && array.shape(0) * N != array.size()))
        throw py::value_error("is not an array of " + std::to_string(N) + " numbers per element");
    const T* begin = reinterpret_cast<const T*>(array.data());
    const size_t count = size_t(array.size()) / N;
    py::gil_scoped_release release;
    return std::vector<T>(begin, begin + count);
}

/// Splits (times, values) into its parts; false when the value has no times.
bool splitTimes(py::handle from, std::vector<float>& times, py::sequence& values) {
    if (!py::isinstance<py::tuple>(from) || py::len(from) != 2) return false;
    const py::tuple pair = py::reinterpret_borrow<py::tuple>(from);
    if (!py::isinstance<py::sequence>(pair[1]) && !py::isinstance<py::array>(pair[1])) return false;
    times = elements<float, 1, float>(pair[0]);
    values = py::reinterpret_borrow<py::sequence>(pair[1]);
    if (times.empty() || times.size() != py::len(values))
        throw py::value_error("needs as many values as times");
    for (size_t i = 1; i < times.size(); ++i)
        if (!(times[i] > times[i - 1])) throw py::value_error("needs times that ascend");
    return true;
}

std::vector<dmat4> matrices(py::handle from) {
    // Row vectors row by row are column vectors column by column.
    return elements<dmat4, 16, double>(arrayOf<double>(from).reshape({-1}));
}

template <class T> void fromName(py::handle from, T& to, const std::map<std::string, T>& names) {
    const std::string name = from.cast<std::string>();
    const auto found = names.find(name);
    if (found == names.end()) throw py::value_error("does not know '" + name + "'");
    to = found->second;
}

Interpolation interpolationFrom(py::handle from) {
    Interpolation interpolation = Interpolation::Constant;
    fromName<Interpolation>(from, interpolation,
                            {{"constant", Interpolation::Constant},
                             {"uniform", Interpolation::Uniform},
                             {"varying", Interpolation::Varying},
                             {"vertex", Interpolation::Vertex},
                             {"faceVarying", Interpolation::FaceVarying}});
    return interpolation;
}

Primvar primvarFrom(const py::sequence& item) {
    if (py::len(item) < 3 || py::len(item) > 4)
        throw py::value_error("needs (name, interpolation, values[, indices]) for each primvar");
    Primvar primvar;
    primvar.name = item[0].cast<std::string>();
    primvar.interpolation = interpolationFrom(item[1]);
    const Array<float> values = arrayOf<float>(item[2]);
    const py::ssize_t count = values.ndim() == 0 ? 1 : values.shape(0);
    primvar.components = 1;
    for (py::ssize_t d = 1; d < values.ndim(); ++d)
        primvar.components *= int(values.shape(d));
    if (primvar.components < 1 || primvar.components > 16)
        throw py::value_error("has a primvar '" + primvar.name + "' of " +
                              std::to_string(primvar.components) + " numbers per element");
    const float* data = values.data();
    {
        py::gil_scoped_release release;
        primvar.values.assign(data, data + count * primvar.components);
    }
    if (py::len(item) == 4 && !py::object(item[3]).is_none()) convert(item[3], primvar.indices);
    return primvar;
}

} // namespace

void convert(py::handle from, vec3& to) {
    const std::vector<vec3> values = elements<vec3, 3, float>(from);
    if (values.size() != 1) throw py::value_error("needs three numbers");
    to = values[0];
}

void convert(py::handle from, std::vector<int>& to) {
    to = elements<int, 1, int32_t>(from);
}
void convert(py::handle from, std::vector<float>& to) {
    to = elements<float, 1, float>(from);
}
void convert(py::handle from, std::vector<double>& to) {
    to = elements<double, 1, double>(from);
}
void convert(py::handle from, std::vector<vec3>& to) {
    to = elements<vec3, 3, float>(from);
}
void convert(py::handle from, std::vector<vec4>& to) {
    to = elements<vec4, 4, float>(from);
}

void convert(py::handle from, MotionTransform& to) {
    std::vector<float> times;
    py::sequence samples;
    std::vector<dmat4> values;
    if (splitTimes(from, times, samples)) {
        values = matrices(samples);
        if (values.size() != times.size()) throw py::value_error("needs a matrix for each time");
        to.times = std::move(times);
        to.values = std::move(values);
        return;
    }
    values = matrices(from);
    if (values.size() != 1) throw py::value_error("needs one matrix");
    to = MotionTransform(values[0]);
}

void convert(py::handle from, std::vector<MotionTransform>& to) {
    std::vector<float> times;
    py::sequence samples;
    std::vector<std::vector<dmat4>> values;
    if (splitTimes(from, times, samples)) {
        for (size_t i = 0; i < times.size(); ++i)
            values.push_back(matrices(py::object(samples[i])));
        for (const auto& sample : values)
            if (sample.size() != values[0].size())
                throw py::value_error("needs equally many instances at all times");
    } else {
        times = {0.0f};
        values.push_back(matrices(from));
    }
    to.assign(values[0].size(), MotionTransform());
    for (size_t i = 0; i < to.size(); ++i) {
        to[i].times = times;
        to[i].values.reserve(times.size());
        for (const auto& sample : values)
            to[i].values.push_back(sample[i]);
    }
}

void convert(py::handle from, Sampled<std::vector<vec3>>& to) {
    std::vector<float> times;
    py::sequence samples;
    to = {};
    if (splitTimes(from, times, samples)) {
        to.times = std::move(times);
        for (size_t i = 0; i < to.times.size(); ++i)
            to.values.push_back(elements<vec3, 3, float>(py::object(samples[i])));
    } else {
        to.times = {0.0f};
        to.values.push_back(elements<vec3, 3, float>(from));
    }
}

void convert(py::handle from, std::vector<Primvar>& to) {
    to.clear();
    for (py::handle item : from)
        to.push_back(primvarFrom(item.cast<py::sequence>()));
}

void convert(py::handle from, std::vector<GeomSubset>& to) {
    to.clear();
    for (py::handle item : from) {
        const py::sequence parts = item.cast<py::sequence>();
        if (py::len(parts) != 3)
            throw py::value_error("needs (path, material, indices) for each subset");
        GeomSubset subset;
        subset.path = parts[0].cast<std::string>();
        subset.material = parts[1].cast<std::string>();
        convert(parts[2], subset.faces);
        to.push_back(std::move(subset));
    }
}

void convert(py::handle from, Visibility& to) {
    if (py::isinstance<py::bool_>(from)) {
        to = Visibility::all(from.cast<bool>());
        return;
    }
    const auto flags = from.cast<std::vector<bool>>();
    if (flags.size() == 3) { // all that is not the camera's or a shadow ray is indirect
        to = Visibility::all(flags[1]);
        to.camera = flags[0];
        to.shadow = flags[2];
        return;
    }
    if (flags.size() != 6)
        throw py::value_error("needs (camera, indirect, shadow), or (camera, diffuse, shadow, "
                              "specular, transmission, volume)");
    to = {flags[0], flags[1], flags[2], flags[3], flags[4], flags[5]};
}

void convert(py::handle from, Marks& to) {
    for (const auto& item : from.cast<py::dict>()) {
        MarkValue& value = to[item.first.cast<std::string>()];
        if (py::isinstance<py::str>(item.second))
            value = item.second.cast<std::string>();
        else
            value = item.second.cast<double>();
    }
}

void convert(py::handle from, Catching& to) {
    const auto flags = from.cast<std::vector<bool>>();
    if (flags.size() != 3) throw py::value_error("needs (matte, shadows, reflections)");
    to = {flags[0], flags[1], flags[2]};
}

void convert(py::handle from, SplatShape& to) {
    fromName<SplatShape>(from, to,
                         {{"gaussianEllipsoid", SplatShape::GaussianEllipsoid},
                          {"gaussianSurflet", SplatShape::GaussianSurflet},
                          {"constantSurflet", SplatShape::ConstantSurflet}});
}
void convert(py::handle from, SubdivisionScheme& to) {
    fromName<SubdivisionScheme>(from, to,
                                {{"none", SubdivisionScheme::None},
                                 {"catmullClark", SubdivisionScheme::CatmullClark},
                                 {"loop", SubdivisionScheme::Loop},
                                 {"bilinear", SubdivisionScheme::Bilinear}});
}

void convert(py::handle from, CurveBasis& to) {
    fromName<CurveBasis>(from, to,
                         {{"linear", CurveBasis::Linear},
                          {"bezier", CurveBasis::Bezier},
                          {"bspline", CurveBasis::Bspline},
                          {"catmullRom", CurveBasis::CatmullRom}});
}

void convert(py::handle from, CurveWrap& to) {
    fromName<CurveWrap>(from, to,
                        {{"nonperiodic", CurveWrap::Nonperiodic},
                         {"periodic", CurveWrap::Periodic},
                         {"pinned", CurveWrap::Pinned}});
}

void convert(py::handle from, ImplicitShape& to) {
    fromName<ImplicitShape>(from, to,
                            {{"sphere", ImplicitShape::Sphere},
                             {"cube", ImplicitShape::Cube},
                             {"cone", ImplicitShape::Cone},
                             {"cylinder", ImplicitShape::Cylinder},
                             {"capsule", ImplicitShape::Capsule},
                             {"plane", ImplicitShape::Plane}});
}

void convert(py::handle from, LightType& to) {
    std::map<std::string, LightType> words;
    for (const LightRow& row : lightRows)
        words[row.word] = row.type;
    fromName(from, to, words);
}

void convert(py::handle from, LightFilterType& to) {
    std::map<std::string, LightFilterType> words;
    for (const LightFilterRow& row : lightFilterRows)
        words[row.word] = row.type;
    fromName(from, to, words);
}

void convert(py::handle from, std::vector<LightFilter>& to) {
    to.clear();
    for (const py::handle& item : py::cast<py::sequence>(from)) {
        if (!py::isinstance<py::dict>(item)) throw py::value_error("needs a dict for each filter");
        LightFilter filter;
        const auto values = py::reinterpret_borrow<py::kwargs>(item);
        Fields("a filter of set_light", "", values)
            .read("path", filter.path)
            .read("type", filter.type)
            .read("transform", filter.transform)
#define PATINA_FILTER_INPUT(type, field, names, fallback, description) .read(#field, filter.field)
#include "hdDelegate/scene/lightFilterInputs.inc"
            .finish();
        to.push_back(std::move(filter));
    }
}

void convert(py::handle from, std::vector<LightPortal>& to) {
    to.clear();
    for (const py::handle& item : py::cast<py::sequence>(from)) {
        if (!py::isinstance<py::dict>(item)) throw py::value_error("needs a dict for each portal");
        LightPortal portal;
        const auto values = py::reinterpret_borrow<py::kwargs>(item);
        Fields("a portal of set_light", "", values)
            .read("path", portal.path)
            .read("transform", portal.transform)
            .read("width", portal.width)
            .read("height", portal.height)
            .finish();
        to.push_back(std::move(portal));
    }
}

void Fields::finish() const {
    for (auto item : _values) {
        const std::string name = py::str(item.first);
        if (!_known.count(name))
            throw py::type_error(std::string(_function) + " has no field '" + name + "'");
    }
}

void Fields::fail(const char* name, const std::string& why) const {
    throw py::value_error(std::string(_function) + ": " + _prim + ": " + name + " " + why);
}

} // namespace patina
