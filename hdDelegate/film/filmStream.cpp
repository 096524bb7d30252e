// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/filmStream.h"

#include "hdDelegate/film/cryptomatteHash.h"

#include <algorithm>
#include <stdexcept>

namespace patina {

namespace {

constexpr uint32_t longestText = 4096, longestName = 1 << 20, maxAovs = 1024;
constexpr uint32_t maxSamples = 1 << 29; ///< before a span and in it: both together are an int

} // namespace

void FilmStream::writeHeader(FilmFileWriter& file, const Film& film) {
    file.value(int32_t(film._width));
    file.value(int32_t(film._height));
    file.value(film.droppedSamples());
    file.value(film._firstSample);
    file.text(film.resumeToken);
    file.value(uint32_t(film._aovs.size()));
    for (const AovSpec& spec : film._aovs) {
        file.text(spec.name);
        file.value(int32_t(spec.components));
        file.value(int32_t(spec.kind));
        file.value(spec.clearValue);
        file.value(uint32_t(spec.isInteger));
        if (spec.kind != AovKind::Coverage) continue;
        const auto names = film.coverageNames(spec.name);
        file.value(uint32_t(names.size()));
        for (const auto& item : names)
            file.text(item.second);
    }
    file.seal();
}

FilmStream::Header FilmStream::readHeader(FilmFileReader& file) {
    Header header;
    header.width = file.value<int32_t>();
    header.height = file.value<int32_t>();
    header.dropped = file.value<uint64_t>();
    header.firstSample = file.value<uint32_t>();
    if (header.firstSample > maxSamples) file.fail("it is damaged");
    header.token = file.text(longestText);
    const uint32_t count = file.value<uint32_t>();
    if (count > maxAovs) file.fail("it is damaged");
    header.aovs.resize(count);
    for (AovSpec& spec : header.aovs) {
        spec.name = file.text(longestText);
        spec.id = aovIdOf(spec.name);
        spec.components = file.value<int32_t>();
        const int32_t kind = file.value<int32_t>();
        spec.clearValue = file.value<float>();
        spec.isInteger = file.value<uint32_t>() != 0;
        if (kind < 0 || kind > int(AovKind::Coverage)) file.fail("it is damaged");
        spec.kind = AovKind(kind);
        try {
            checkAovSpec(spec);
        } catch (const std::invalid_argument&) {
            file.fail("it is damaged");
        }
        if (spec.kind != AovKind::Coverage) continue;
        std::vector<std::string>& names = header.names[spec.name];
        for (uint32_t left = file.value<uint32_t>(); left > 0; --left)
            names.push_back(file.text(longestName));
    }
    file.checkSeal();
    return header;
}

void FilmStream::reset(Film& film, const Header& header) {
    film._width = 0; // so that nothing is kept
    film.reset(header.width, header.height, header.aovs);
    film._firstSample = header.firstSample;
    film._dropped = header.dropped;
    film.resumeToken = header.token;
    addNames(film, header);
}

void FilmStream::addNames(Film& film, const Header& header) {
    for (const auto& [aov, names] : header.names)
        if (const int i = film.aovIndex(aov); i >= 0)
            for (const std::string& name : names)
                film._planes[size_t(i)].names.add(cryptomatteId(name), name);
}

/// @param act called with the bytes of each array's piece of a row, and their number
template <class FilmType, class Act>
void FilmStream::eachRow(FilmType& film, const Tile& tile, const Act& act) {
    for (int y = tile.y0; y < tile.y1; ++y) {
        const size_t first = film.index(tile.x0, y), count = size_t(tile.x1 - tile.x0);
        const auto row = [&](auto& values) {
            if (values.empty()) return;
            const size_t stride = values.size() / film._pixels.size();
            act(&values[first * stride], count * stride * sizeof values[0]);
        };
        row(film._pixels);
        for (auto& plane : film._planes) {
            row(plane.sums);
            row(plane.nearest);
        }
    }
}

/// @param act called with each AOV that has cells, and each pixel's
template <class FilmType, class Act>
void FilmStream::eachCell(FilmType& film, const Tile& tile, const Act& act) {
    for (auto& plane : film._planes)
        for (int y = tile.y0; !plane.cells.empty() && y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x)
                act(plane, plane.cells[film.index(x, y)]);
}

void FilmStream::writePixels(FilmFileWriter& file, const Film& film, const Tile& tile) {
    static_assert(sizeof(Film::Pixel) == 96, "pixels are written as bytes, without padding");
    eachRow(film, tile, [&](const void* data, size_t size) { file.bytes(data, size); });
    eachCell(film, tile, [&](const auto&, const CoverageCell& cell) {
        file.value(uint32_t(cell.size()));
        for (size_t i = 0; i < cell.size(); ++i)
            file.value(cell[i]);
    });
}

void FilmStream::readPixels(FilmFileReader& file, Film& film, const Tile& tile) {
    eachRow(film, tile, [&](void* data, size_t size) { file.bytes(data, size); });
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
            if (film.pixel(x, y).count > maxSamples) file.fail("it is damaged");
    eachCell(film, tile, [&](auto& plane, CoverageCell& cell) {
        for (uint32_t left = file.value<uint32_t>(); left > 0; --left) {
            const auto count = file.value<CoverageCount>();
            cell.add(count.id, count.samples, plane.room);
        }
    });
}

size_t FilmStream::bytesOfPixel(const std::vector<AovSpec>& aovs) {
    size_t bytes = sizeof(Film::Pixel);
    for (const AovSpec& spec : aovs) {
        Film::Plane plane;
        Film::clearPlane(spec, 1, plane);
        bytes += plane.sums.size() * sizeof(double) + plane.nearest.size() * sizeof(float) +
                 plane.cells.size() * sizeof(uint32_t);
    }
    return bytes;
}

void FilmStream::append(Film& film, const Film& part, const Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            const size_t to = film.index(x, y), from = part.index(x - tile.x0, y - tile.y0);
            appendPixel(film._pixels[to], part._pixels[from]);
            for (size_t a = 0; a < film._planes.size(); ++a)
                appendPlane(film._aovs[a], film._planes[a], to, part._planes[a], from);
        }
}

void FilmStream::appendPixel(Film::Pixel& pixel, const Film::Pixel& part) {
    if (pixel.count == 0) {
        pixel = part;
        return;
    }
    Film::recordMean(pixel);
    // Of one span: it has ended, or it is open, and zeros are the other's sums.
    pixel.closed = pixel.closed + part.closed;
    pixel.open = part.open;
    pixel.count += part.count;
}

void FilmStream::appendPlane(const AovSpec& spec, Film::Plane& plane, size_t to,
                             const Film::Plane& part, size_t from) {
    const size_t n = size_t(spec.components);
    if (!plane.cells.empty()) {
        plane.cells[to].add(part.cells[from], plane.room);
    } else if (!plane.nearest.empty()) {
        float* values = &plane.nearest[to * (n + 1)];
        const float* other = &part.nearest[from * (n + 1)];
        if (other[n] < values[n]) std::copy(other, other + n + 1, values);
    } else if (!plane.sums.empty()) {
        double* sums = &plane.sums[to * (2 * n + 1)];
        const double* other = &part.sums[from * (2 * n + 1)];
        for (size_t i = 0; i < n; ++i) {
            sums[i] += other[i];
            sums[n + i] = other[n + i];
        }
        sums[2 * n] += other[2 * n];
    }
}

} // namespace patina
