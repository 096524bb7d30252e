// SPDX-License-Identifier: Apache-2.0
// Frames of a sequence, averaged and denoised: arrays of images, without a film.

#include "hdDelegate/film/denoiser.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace py = pybind11;

namespace patina {

namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Arrays = std::map<std::string, Floats>;

/// @param size height and width, which the first array sets
const float* pixelsOf(const Arrays& arrays, const std::string& name, int components,
                      std::array<py::ssize_t, 2>& size, bool needed = true) {
    const auto found = arrays.find(name);
    if (found == arrays.end() && !needed) return nullptr;
    if (found == arrays.end()) throw py::key_error("a frame has no " + name);
    const Floats& array = found->second;
    const bool fits = array.ndim() == (components > 1 ? 3 : 2) &&
                      (components == 1 || array.shape(2) == components);
    if (fits && size[0] == 0) size = {array.shape(0), array.shape(1)};
    if (!fits || array.shape(0) != size[0] || array.shape(1) != size[1])
        throw py::value_error(name + " has not the size of a frame");
    return array.data();
}

py::tuple accumulateArrays(const std::vector<Arrays>& arrays, size_t current, int threads) {
    if (current >= arrays.size()) throw py::index_error("there is no such frame");
    std::array<py::ssize_t, 2> size = {0, 0};
    std::vector<SequenceFrame> frames;
    for (const Arrays& of : arrays) {
        SequenceFrame frame;
        frame.color = pixelsOf(of, "color", 3, size);
        frame.alpha = pixelsOf(of, "alpha", 1, size);
        frame.albedo = pixelsOf(of, "denoisingAlbedo", 3, size);
        frame.normal = pixelsOf(of, "denoisingNormal", 3, size);
        frame.depth = pixelsOf(of, "depth", 1, size);
        frame.later = pixelsOf(of, "motionForward", 2, size);
        frame.earlier = pixelsOf(of, "motionBackward", 2, size);
        frame.samples = pixelsOf(of, "sampleCount", 1, size, false);
        frames.push_back(frame);
    }
    Accumulated made;
    {
        py::gil_scoped_release release;
        made = accumulate(frames, current, int(size[1]), int(size[0]), threads);
    }
    const py::ssize_t three = 3;
    return py::make_tuple(py::array_t<float>({size[0], size[1], three}, made.color.data()),
                          py::array_t<float>({size[0], size[1]}, made.frames.data()));
}

Floats denoiseArrays(const Floats& color, const Floats& albedo, const Floats& normal,
                     double samples, int threads) {
    std::array<py::ssize_t, 2> size = {0, 0};
    const Arrays arrays = {{"color", color}, {"albedo", albedo}, {"normal", normal}};
    std::vector<std::vector<float>> images;
    for (const char* name : {"color", "albedo", "normal"}) {
        const float* pixels = pixelsOf(arrays, name, 3, size);
        images.emplace_back(pixels, pixels + size[0] * size[1] * 3);
    }
    {
        py::gil_scoped_release release;
        images = denoised({{int(size[1]), int(size[0]), std::move(images[0]), std::move(images[1]),
                            std::move(images[2]), samples}},
                          threads);
    }
    const py::ssize_t three = 3;
    return Floats({size[0], size[1], three}, images[0].data());
}

} // namespace

void bindTemporal(py::module_& m) {
    m.def(
        "accumulate", &accumulateArrays, py::arg("frames"), py::arg("current"),
        py::arg("threads") = 0,
        "The colour of a frame, averaged with that of the frames around it where they see the same "
        "surface in the same light, and of how many frames each pixel is the mean. A frame is a "
        "dict of arrays: color, alpha, denoisingAlbedo, denoisingNormal, depth, motionForward, "
        "motionBackward and, where they differ, sampleCount; frames are one time code apart.");
    m.def("denoise_pixels", &denoiseArrays, py::arg("color"), py::arg("albedo"), py::arg("normal"),
          py::arg("samples"), py::arg("threads") = 0,
          "What Open Image Denoise makes of an image of height x width x 3, led by albedo and "
          "normals; samples of a pixel say how noisy these are. RuntimeError says in one line why "
          "not.");
}

} // namespace patina
