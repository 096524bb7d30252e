// SPDX-License-Identifier: Apache-2.0
// A checkpoint is a film's header and all of its pixels.

#include "hdDelegate/film/atomicFile.h"
#include "hdDelegate/film/filmStream.h"

#include <stdexcept>

namespace patina {

namespace {

constexpr FilmFileKind checkpoint = {"checkpoint", {'P', 'a', 't', 'i', 'n', 'a', 'C', 'P'}, 3};

} // namespace

void Film::saveCheckpoint(const std::string& file) const {
    AtomicFile target(file);
    FilmFileWriter writer(checkpoint, target.temporaryPath(), file);
    FilmStream::writeHeader(writer, *this);
    FilmStream::writePixels(writer, *this, {0, 0, _width, _height});
    writer.finish();
    target.commit();
}

void Film::loadCheckpoint(const std::string& file) {
    FilmFileReader reader(checkpoint, file);
    const FilmStream::Header header = FilmStream::readHeader(reader);
    if (header.width < 0 || header.height < 0) reader.fail("it is damaged");
    const uint64_t pixels = uint64_t(header.width) * uint64_t(header.height);
    if (pixels > reader.left() / FilmStream::bytesOfPixel(header.aovs))
        reader.fail("it is truncated");
    Film loaded;
    try {
        FilmStream::reset(loaded, header);
    } catch (const std::invalid_argument&) {
        reader.fail("it is damaged");
    }
    FilmStream::readPixels(reader, loaded, {0, 0, header.width, header.height});
    reader.finish();

    _width = loaded._width;
    _height = loaded._height;
    _aovs = std::move(loaded._aovs);
    _pixels = std::move(loaded._pixels);
    _planes = std::move(loaded._planes);
    _denoised.clear();
    _dropped = header.dropped;
    _firstSample = header.firstSample;
    resumeToken = header.token;
}

} // namespace patina
