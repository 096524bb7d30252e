// SPDX-License-Identifier: Apache-2.0
// Film, image files and colour of the Python module. Names are PEP 8's; options of images are the
// fields of ImageOptions in snake case.

#include "plugin/python/filmAtRest.h"
#include "hdDelegate/film/atomicFile.h"
#include "hdDelegate/film/denoiser.h"
#include "hdDelegate/film/imageFile.h"
#include "hdDelegate/film/relativeError.h"
#include "materialNetwork/color/colorSpaces.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <stdexcept>

namespace py = pybind11;

namespace patina {

namespace {

/// An array that owns the vector's memory: no copy.
template <class T> py::array_t<T> arrayOf(std::vector<float>&& values, std::vector<size_t> shape) {
    static_assert(sizeof(T) == sizeof(float), "ids are the bits of floats");
    auto* owner = new std::vector<float>(std::move(values));
    py::capsule release(owner, [](void* p) { delete static_cast<std::vector<float>*>(p); });
    return py::array_t<T>(shape, reinterpret_cast<T*>(owner->data()), release);
}

py::array resolve(const Film& film, const std::string& name) {
    AovSpec spec;
    if (!film.findSpec(name, spec)) throw py::key_error("the film holds no AOV '" + name + "'");
    std::vector<float> values;
    {
        py::gil_scoped_release release;
        values = film.resolve(name);
    }
    std::vector<size_t> shape = {size_t(film.height()), size_t(film.width())};
    if (spec.components > 1) shape.push_back(size_t(spec.components));
    if (spec.isInteger) return arrayOf<int32_t>(std::move(values), shape);
    return arrayOf<float>(std::move(values), shape);
}

std::vector<std::string> aovNames(const Film& film) {
    std::vector<std::string> names;
    for (const AovSpec& spec : film.aovs())
        names.push_back(spec.name);
    return names;
}

void reset(Film& film, int width, int height, const std::vector<std::string>& aovs, bool keep) {
    mustRest(film);
    std::vector<AovSpec> specs;
    for (const std::string& name : aovs)
        specs.push_back(standardAov(name));
    film.reset(width, height, specs, keep);
}

bool addColor(Film& film, int x, int y, std::array<float, 3> c, float alpha) {
    if (x < 0 || y < 0 || x >= film.width() || y >= film.height())
        throw py::index_error("there is no such pixel");
    mustRest(film);
    return film.addColor(x, y, {c[0], c[1], c[2]}, alpha);
}

Metadata metadataFrom(const py::dict& dict) {
    Metadata metadata;
    for (auto item : dict) {
        std::string name = py::str(item.first);
        if (py::isinstance<py::int_>(item.second) && !py::isinstance<py::bool_>(item.second)) {
            long long value = item.second.cast<long long>();
            if (value == int(value))
                metadata[name] = int(value);
            else
                metadata[name] = double(value);
        } else if (py::isinstance<py::float_>(item.second)) {
            metadata[name] = item.second.cast<double>();
        } else {
            metadata[name] = std::string(py::str(item.second));
        }
    }
    return metadata;
}

py::dict metadataTo(const Metadata& metadata) {
    py::dict dict;
    for (auto& [name, value] : metadata) {
        if (auto text = std::get_if<std::string>(&value)) {
            // Foreign files hold bytes of any encoding.
            dict[py::str(name)] = py::reinterpret_steal<py::object>(
                PyUnicode_DecodeUTF8(text->data(), Py_ssize_t(text->size()), "replace"));
        } else if (auto number = std::get_if<int>(&value)) {
            dict[py::str(name)] = *number;
        } else {
            dict[py::str(name)] = std::get<double>(value);
        }
    }
    return dict;
}

Outliers outliersFrom(const std::string& name) {
    if (name == "keep") return Outliers::Keep;
    if (name == "spread") return Outliers::Spread;
    throw py::value_error("outliers are kept or spread: 'keep' or 'spread', not '" + name + "'");
}

const RenderingSpace& renderingSpaceOf(const std::string& name) {
    const RenderingSpace* space = RenderingSpace::find(name);
    if (!space) throw py::value_error("there is no linear colour space '" + name + "'");
    return *space;
}

ImageOptions optionsFrom(const py::dict& dict) {
    ImageOptions o;
    const std::map<std::string, std::function<void(const py::handle&)>> fields = {
        {"aovs", [&](auto& v) { o.aovs = v.template cast<std::vector<std::string>>(); }},
        {"display_width", [&](auto& v) { o.displayWidth = v.template cast<int>(); }},
        {"display_height", [&](auto& v) { o.displayHeight = v.template cast<int>(); }},
        {"data_window",
         [&](auto& v) {
             auto window = v.template cast<std::array<int, 4>>();
             std::copy(window.begin(), window.end(), o.dataWindow);
         }},
        {"pixel_aspect_ratio", [&](auto& v) { o.pixelAspectRatio = v.template cast<double>(); }},
        {"deep", [&](auto& v) { o.deep = v.template cast<bool>(); }},
        {"half", [&](auto& v) { o.half = v.template cast<bool>(); }},
        {"integer_ids", [&](auto& v) { o.integerIds = v.template cast<bool>(); }},
        {"compression", [&](auto& v) { o.compression = v.template cast<std::string>(); }},
        {"bits", [&](auto& v) { o.bits = v.template cast<int>(); }},
        {"rendering_color_space",
         [&](auto& v) { o.renderingSpace = &renderingSpaceOf(v.template cast<std::string>()); }},
        {"display", [&](auto& v) { o.display = v.template cast<std::string>(); }},
        {"view", [&](auto& v) { o.view = v.template cast<std::string>(); }},
        {"raw", [&](auto& v) { o.raw = v.template cast<bool>(); }},
        {"dither", [&](auto& v) { o.dither = v.template cast<bool>(); }},
        {"outliers", [&](auto& v) { o.outliers = outliersFrom(v.template cast<std::string>()); }},
        {"quality", [&](auto& v) { o.quality = v.template cast<int>(); }},
    };
    for (auto item : dict) {
        std::string name = py::str(item.first);
        auto field = fields.find(name);
        if (field == fields.end()) throw py::value_error("unknown image option '" + name + "'");
        try {
            field->second(item.second);
        } catch (const py::cast_error&) {
            throw py::value_error("image option '" + name + "' has a value of the wrong type");
        }
    }
    return o;
}

void writeFilm(const Film& film, const std::string& path, const py::dict& options,
               const py::dict& metadata) {
    ImageOptions o = optionsFrom(options);
    Metadata m = metadataFrom(metadata);
    py::gil_scoped_release release;
    writeImage(film, path, o, m);
}

std::vector<std::string> usualChannels(size_t count) {
    static const char* const color[] = {"R", "G", "B", "A"};
    if (count == 1) return {"Y"};
    std::vector<std::string> names;
    for (size_t c = 0; c < count; ++c)
        names.push_back(c < 4 ? color[c] : "channel" + std::to_string(c));
    return names;
}

using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;

void writeArray(const std::string& path, const FloatArray& pixels,
                std::vector<std::string> channels, const py::dict& options,
                const py::dict& metadata) {
    if (pixels.ndim() != 2 && pixels.ndim() != 3)
        throw py::value_error("an image is an array of height, width and, if not grey, channels");
    ImageData image;
    image.height = int(pixels.shape(0));
    image.width = int(pixels.shape(1));
    size_t count = pixels.ndim() == 3 ? size_t(pixels.shape(2)) : 1;
    image.channels = channels.empty() ? usualChannels(count) : std::move(channels);
    if (image.channels.size() != count)
        throw py::value_error("the array has " + std::to_string(count) + " channels, the names " +
                              std::to_string(image.channels.size()));
    image.pixels.assign(pixels.data(), pixels.data() + pixels.size());
    image.metadata = metadataFrom(metadata);
    ImageOptions o = optionsFrom(options);
    py::gil_scoped_release release;
    writePixels(image, path, o);
}

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

py::object colorsToRendering(const Floats& colors, const std::string& space,
                             const std::string& rendering) {
    if (colors.ndim() != 2 || colors.shape(1) < 3)
        throw py::value_error("colours are rows of at least three numbers");
    std::vector<float> values(colors.data(), colors.data() + colors.size());
    if (!ColorSpaces::shared().valueToRendering(space, renderingSpaceOf(rendering), values.data(),
                                                size_t(colors.shape(0)), int(colors.shape(1))))
        return py::none();
    return arrayOf<float>(std::move(values), {size_t(colors.shape(0)), size_t(colors.shape(1))});
}

} // namespace

void bindFilm(py::module_& m) {
    py::class_<Film, std::shared_ptr<Film>>(m, "Film", "Accumulates the samples of an image.")
        .def(py::init<>())
        .def("reset", &reset, py::arg("width"), py::arg("height"),
             py::arg("aovs") = std::vector<std::string>{}, py::arg("keep") = false,
             "Clears the film; ValueError names an unknown AOV.")
        .def(
            "copy",
            [](const Film& film) {
                auto copy = std::make_shared<Film>();
                copy->copyFrom(film);
                return copy;
            },
            py::call_guard<py::gil_scoped_release>(), "An equal film of its own.")
        .def_property_readonly("width", &Film::width, "Pixels.")
        .def_property_readonly("height", &Film::height, "Pixels.")
        .def_property_readonly("aovs", &aovNames, "Names besides color and alpha.")
        .def_property_readonly("dropped_samples", &Film::droppedSamples,
                               "Samples that were not finite; they count as black.")
        .def_readwrite("resume_token", &Film::resumeToken,
                       "The origin of the film, in words; a checkpoint of another is refused.")
        .def("resolve", &resolve, py::arg("name"),
             "Array of height x width (x components), top row first; int32 for ids.")
        .def(
            "relative_error",
            [](const Film& film, bool shared) {
                return relativeError(film, 0, 0, film.width(), film.height(),
                                     shared ? PixelNoise::Shared : PixelNoise::Independent);
            },
            py::arg("shared") = false,
            "Expected mean of |luminance - its limit| / (limit + 0.01) over the pixels, by their "
            "samples; shared: all pixels have the same random numbers (rasterizer).")
        .def("add_color", &addColor, py::arg("x"), py::arg("y"), py::arg("radiance"),
             py::arg("alpha") = 1.0f,
             "Adds a sample of linear colour; False, and black, where it is not finite.")
        .def_property_readonly(
            "has_deep", [](const Film& film) { return film.deep() != nullptr; },
            "Whether samples were kept by their depths, for deep images.")
        .def("save_checkpoint", &Film::saveCheckpoint, py::arg("file"),
             py::call_guard<py::gil_scoped_release>(),
             "Writes the samples to a file; RuntimeError says in one line why not.")
        .def(
            "load_checkpoint",
            [](Film& film, const std::string& file) {
                mustRest(film);
                film.loadCheckpoint(file);
            },
            py::arg("file"), py::call_guard<py::gil_scoped_release>(),
            "Reads what save_checkpoint() wrote; RuntimeError where it is something else.");

    py::class_<ImageData>(m, "ImageData", "An image as it is in its file.")
        .def_readonly("width", &ImageData::width)
        .def_readonly("height", &ImageData::height)
        .def_readonly("x", &ImageData::x)
        .def_readonly("y", &ImageData::y)
        .def_readonly("display_width", &ImageData::displayWidth)
        .def_readonly("display_height", &ImageData::displayHeight)
        .def_readonly("pixel_aspect_ratio", &ImageData::pixelAspectRatio)
        .def_readonly("channels", &ImageData::channels)
        .def_property_readonly(
            "pixels",
            [](py::object self) {
                ImageData& image = self.cast<ImageData&>();
                std::vector<size_t> shape = {size_t(image.height), size_t(image.width),
                                             image.channels.size()};
                return py::array_t<float>(shape, image.pixels.data(), self);
            },
            "Float array of height x width x channels, top row first, without a copy.")
        .def_property_readonly(
            "metadata", [](const ImageData& image) { return metadataTo(image.metadata); },
            "The file's own metadata, by name.");

    py::class_<AtomicFile>(m, "AtomicFile",
                           "A file that appears all at once: written to temporary_path, and "
                           "renamed by commit(). RuntimeError where the path is no regular file.")
        .def(py::init<const std::string&>(), py::arg("path"))
        .def_property_readonly("temporary_path", &AtomicFile::temporaryPath,
                               "Where to write; it has the file's own ending.")
        .def("commit", &AtomicFile::commit, py::call_guard<py::gil_scoped_release>(),
             "Renames what was written to its place; RuntimeError where that fails.")
        .def("discard", &AtomicFile::discard, "Ends without the file, unless it was committed.");
    m.def("set_denoiser_library", &setDenoiserLibrary, py::arg("path"),
          "Which Open Image Denoise to load; empty for $PATINA_OIDN_LIBRARY or the system's.");
    m.def("denoiser_missing", &denoiserMissing, py::call_guard<py::gil_scoped_release>(),
          "Why images cannot be denoised here, in one line; empty where they can.");
    m.def(
        "denoise",
        [](Film& film, int threads, bool aovs) {
            mustRest(film);
            denoise(film, threads, aovs);
        },
        py::arg("film"), py::arg("threads") = 0, py::arg("aovs") = false,
        py::call_guard<py::gil_scoped_release>(),
        "Replaces the film's colour by what Open Image Denoise makes of it, led by the AOVs "
        "denoisingAlbedo and denoisingNormal where both are there; the noisy one is color.noisy "
        "then. With `aovs` likewise those of light. RuntimeError says in one line why not.");
    m.def(
        "denoised_error",
        [](const Film& film, int threads) {
            mustRest(film);
            return denoisedError(film, threads);
        },
        py::arg("film"), py::arg("threads") = 0, py::call_guard<py::gil_scoped_release>(),
        "Film.relative_error() of the colour that denoise() leaves, at most: from halves of the "
        "samples (AOVs denoisingHalfColor, denoisingHalfAlbedo, denoisingHalfNormal), each of "
        "which tells how far the other is off when denoised. Below 0 without them. RuntimeError "
        "says in one line why not.");
    m.def(
        "keep_noisy",
        [](Film& film) {
            mustRest(film);
            film.setDenoised(film.resolve(film.denoised() ? "color.noisy" : "color"));
        },
        py::arg("film"), "In place of denoise(): colour and color.noisy are both the means.");
    m.def("check_output", &checkOutput, py::arg("path"),
          "RuntimeError says early why a file could not be written; its folder is not touched.");

    m.def("read_image", &readImage, py::arg("path"), py::call_guard<py::gil_scoped_release>(),
          "Reads any image; RuntimeError says in one line why not.");
    m.def(
        "read_deep",
        [](const std::string& path) {
            const DeepImage image = readDeep(path);
            const size_t n = image.channels.size();
            py::array_t<int> counts({image.height, image.width}, image.counts.data());
            py::array_t<float> values({image.values.size() / n, n}, image.values.data());
            return py::make_tuple(image.channels, counts, values);
        },
        py::arg("path"),
        "Reads a deep image: names of channels, samples by pixel, and their values one after the "
        "other; RuntimeError says in one line why not.");
    m.def("write_images", &writeFilm, py::arg("film"), py::arg("path"),
          py::arg("options") = py::dict(), py::arg("metadata") = py::dict(),
          "Writes a film: OpenEXR with all its AOVs, or an image for the screen.");
    m.def("write_image", &writeArray, py::arg("path"), py::arg("pixels"),
          py::arg("channels") = std::vector<std::string>{}, py::arg("options") = py::dict(),
          py::arg("metadata") = py::dict(), "Writes a float array of linear colour.");
    m.def("check_image_path", &checkImagePath, py::arg("path"),
          py::arg("aovs") = std::vector<std::string>{},
          "RuntimeError says early why an image could not be written.");
    m.def(
        "displays", [] { return ColorSpaces::shared().displays(); },
        "Displays of the OCIO configuration, in its order.");
    m.def(
        "views", [](const std::string& display) { return ColorSpaces::shared().views(display); },
        py::arg("display"), "Views of a display, in the order of the configuration.");
    m.def(
        "color_spaces", [] { return ColorSpaces::shared().names(); },
        "Names of colour spaces that colours and textures may have.");
    m.def(
        "color_to_rendering",
        [](std::vector<float> numbers, const std::string& space,
           const std::string& rendering) -> py::object {
            if (numbers.size() < 3) throw py::value_error("a colour has at least three numbers");
            if (!ColorSpaces::shared().valueToRendering(space, renderingSpaceOf(rendering),
                                                        numbers.data()))
                return py::none();
            return py::cast(numbers);
        },
        py::arg("numbers"), py::arg("color_space"), py::arg("rendering") = "",
        "A colour value in the rendering space (linear Rec.709): three numbers are converted, what "
        "follows them stays. None for an unknown space.");
    m.def("colors_to_rendering", &colorsToRendering, py::arg("colors"), py::arg("color_space"),
          py::arg("rendering") = "",
          "The same for an array of colours, one a row of three or more numbers.");
    m.def(
        "rendering_space",
        [](const std::string& name) -> py::object {
            const RenderingSpace* space = RenderingSpace::find(name);
            return space ? py::cast(space->name) : py::none();
        },
        py::arg("name"),
        "The configuration's spelling of a linear colour space, '' for linear Rec.709, None where "
        "light cannot be added in it.");
}

} // namespace patina
