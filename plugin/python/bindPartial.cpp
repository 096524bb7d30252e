// SPDX-License-Identifier: Apache-2.0
// Parts of cut frames: the tiles and spans that they are made of, and their files.

#include "plugin/python/filmAtRest.h"
#include "hdDelegate/film/film.h"
#include "hdDelegate/film/partial.h"
#include "hdDelegate/film/spans.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace patina {

namespace {

std::vector<Tile> tiles(int width, int height, const std::array<int, 4>& window, int part,
                        int parts) {
    if (width < 1 || height < 1 || part < 0 || part >= parts)
        throw py::value_error("there is no such part");
    return tilesOfPart(tilesOf(width, height, window), part, parts);
}

std::vector<uint32_t> spanEnds(uint32_t samples) {
    std::vector<uint32_t> ends;
    for (uint32_t end = 0; end < samples;) {
        end = std::min(nextSpanEnd(end), samples);
        ends.push_back(end);
    }
    return ends;
}

} // namespace

void bindPartial(py::module_& m) {
    py::class_<Tile>(m, "Tile", "A rectangle of pixels, ends excluded.")
        .def_readonly("x0", &Tile::x0)
        .def_readonly("y0", &Tile::y0)
        .def_readonly("x1", &Tile::x1)
        .def_readonly("y1", &Tile::y1);
    m.def("tiles_of_part", &tiles, py::arg("width"), py::arg("height"),
          py::arg("window") = std::array<int, 4>{0, 0, -1, -1}, py::arg("part") = 0,
          py::arg("parts") = 1, "The tiles of one of several parts of an image, from 0.");
    m.def("span_ends", &spanEnds, py::arg("samples"),
          "After how many samples a frame of so many may be cut; the last is its end.");
    py::class_<PartialWriter>(m, "PartialWriter",
                              "Writes the file of a part; RuntimeError says in one line why not.")
        .def(py::init<const std::string&, const std::string&, std::vector<Tile>>(), py::arg("file"),
             py::arg("description"), py::arg("tiles"))
        .def("add", &PartialWriter::add, py::arg("film"), py::call_guard<py::gil_scoped_release>(),
             "A film with the samples of one span, or of all spans from the first.")
        .def("commit", &PartialWriter::commit, py::arg("report"),
             py::call_guard<py::gil_scoped_release>());
    m.def("partial_description", &partialDescription, py::arg("file"),
          "The origin of a part, as PartialWriter was told.");
    py::class_<PartialErrors>(m, "PartialErrors",
                              "What the tiles of parts told of their error while they were merged.")
        .def(py::init<>())
        .def("samples_of_whole", &PartialErrors::samplesOfWhole, py::arg("tolerance"),
             py::arg("min_samples"),
             "The count at which the image rendered at once was done; 0: no tile went on after it.")
        .def("steps_of_whole", &PartialErrors::stepsOfWhole, py::arg("min_samples"),
             "Counts before the last one at which that image had its denoised error looked at.");
    m.def(
        "merge_partial",
        [](Film& film, const std::string& file, double tolerance, int minSamples, int samples,
           PartialErrors* errors) {
            mustRest(film);
            return mergePartial(film, file, {tolerance, minSamples, samples, errors});
        },
        py::arg("film"), py::arg("file"), py::arg("tolerance") = 0.0, py::arg("min_samples") = 0,
        py::arg("samples") = 0, py::arg("errors") = py::none(),
        py::call_guard<py::gil_scoped_release>(),
        "Adds a part behind the samples that a film has, and returns its report. Of the same tiles "
        "the parts come in the order of their samples.");
}

} // namespace patina
