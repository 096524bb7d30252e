// Layout of a checkpoint: magic, version, byte-order mark, header, pixels, planes, checksum of all
// that stands before it.

#include "hdDelegate/film/atomicFile.h"
#include "hdDelegate/film/film.h"
#include "hdDelegate/film/temporaryFailure.h"
#include "materialNetwork/regularFile.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace patina {

namespace {

constexpr char magic[8] = {'P', 'a', 't', 'i', 'n', 'a', 'C', 'P'};
constexpr uint32_t formatVersion = 2;
constexpr uint32_t byteOrderMark = 0x01020304;
constexpr uint32_t longestText = 4096, maxAovs = 1024;

/// A 64-bit checksum of a stream: words are mixed by a multiplication and a rotation each, so that
/// order counts and every bit of a word reaches the result.
class Checksum {
public:
    void add(const void* data, size_t bytes) {
        const char* p = static_cast<const char*>(data);
        for (; bytes >= 8; bytes -= 8, p += 8)
            mix(load(p, 8));
        if (bytes) mix(load(p, bytes) ^ (uint64_t(bytes) << 56));
    }
    uint64_t value() const { return _state ^ (_state >> 31); }

private:
    static uint64_t load(const char* p, size_t bytes) {
        uint64_t word = 0;
        std::memcpy(&word, p, bytes);
        return word;
    }
    void mix(uint64_t word) {
        _state = (_state ^ word) * 0x9E3779B97F4A7C15ull;
        _state = (_state << 29) | (_state >> 35);
    }
    uint64_t _state = 0x243F6A8885A308D3ull;
};

using FilePtr = std::unique_ptr<FILE, int (*)(FILE*)>;

class Writer {
public:
    Writer(FILE* file, const std::string& name) : _file(file), _name(name) {}
    void bytes(const void* data, size_t size) {
        _sum.add(data, size);
        raw(data, size);
    }
    template <class T> void value(T v) { bytes(&v, sizeof v); }
    template <class T> void array(const std::vector<T>& v) {
        bytes(v.data(), v.size() * sizeof(T));
    }
    void text(const std::string& s) {
        value(uint32_t(s.size()));
        bytes(s.data(), s.size());
    }
    void finish() {
        uint64_t sum = _sum.value();
        raw(&sum, sizeof sum);
        if (std::fflush(_file) != 0) fail();
    }

private:
    void raw(const void* data, size_t size) {
        if (size && std::fwrite(data, 1, size, _file) != size) fail();
    }
    [[noreturn]] void fail() {
        failWith("cannot write checkpoint '" + _name + "'", errno);
    }
    FILE* _file;
    const std::string& _name;
    Checksum _sum;
};

class Reader {
public:
    Reader(FILE* file, const std::string& name) : _file(file), _name(name) {
        std::fseek(_file, 0, SEEK_END);
        _left = uint64_t(std::max(0L, std::ftell(_file)));
        std::rewind(_file);
    }
    void bytes(void* data, size_t size) {
        raw(data, size);
        _sum.add(data, size);
    }
    template <class T> T value() {
        T v;
        bytes(&v, sizeof v);
        return v;
    }
    /// Sizes are checked against the file before memory is asked for.
    template <class T> void array(std::vector<T>& v, uint64_t count) {
        if (count > _left / sizeof(T)) fail("it is truncated");
        v.resize(count);
        bytes(v.data(), count * sizeof(T));
    }
    std::string text() {
        uint32_t size = value<uint32_t>();
        if (size > longestText) fail("it is damaged");
        std::string s(size, '\0');
        bytes(&s[0], size);
        return s;
    }
    void finish() {
        uint64_t expected = _sum.value(), stored;
        raw(&stored, sizeof stored);
        if (stored != expected) fail("it is damaged (checksum differs)");
        if (_left) fail("it is damaged (data after its end)");
    }
    [[noreturn]] void fail(const std::string& reason) {
        throw std::runtime_error("cannot read checkpoint '" + _name + "': " + reason);
    }

private:
    void raw(void* data, size_t size) {
        if (size > _left || std::fread(data, 1, size, _file) != size) fail("it is truncated");
        _left -= size;
    }
    FILE* _file;
    const std::string& _name;
    uint64_t _left = 0;
    Checksum _sum;
};

} // namespace

void Film::saveCheckpoint(const std::string& file) const {
    static_assert(sizeof(Pixel) == 56, "pixels are written as bytes, without padding");
    AtomicFile target(file);
    FilePtr stream(std::fopen(target.temporaryPath().c_str(), "wb"), &std::fclose);
    if (!stream)
        failWith("cannot write checkpoint '" + file + "'", errno);
    Writer w(stream.get(), file);
    w.bytes(magic, sizeof magic);
    w.value(formatVersion);
    w.value(byteOrderMark);
    w.value(int32_t(_width));
    w.value(int32_t(_height));
    w.value(droppedSamples());
    w.text(resumeToken);
    w.value(uint32_t(_aovs.size()));
    for (const AovSpec& spec : _aovs) {
        w.text(spec.name);
        w.value(int32_t(spec.components));
        w.value(int32_t(spec.kind));
        w.value(spec.clearValue);
        w.value(uint32_t(spec.isInteger));
    }
    w.array(_pixels);
    for (const Plane& plane : _planes) {
        w.array(plane.sums);
        w.array(plane.nearest);
    }
    w.finish();
    if (std::fclose(stream.release()) != 0)
        failWith("cannot write checkpoint '" + file + "'", errno);
    target.commit();
}

void Film::loadCheckpoint(const std::string& file) {
    const std::string problem = whyUnreadable(file, maxImageBytes);
    if (!problem.empty())
        throw std::runtime_error("cannot read checkpoint '" + file + "': it " + problem);
    FilePtr stream(std::fopen(file.c_str(), "rb"), &std::fclose);
    if (!stream)
        throw std::runtime_error("cannot read checkpoint '" + file + "': " + std::strerror(errno));
    Reader r(stream.get(), file);
    char start[sizeof magic];
    r.bytes(start, sizeof start);
    if (std::memcmp(start, magic, sizeof magic) != 0) r.fail("it is not a checkpoint");
    uint32_t version = r.value<uint32_t>();
    if (version != formatVersion)
        r.fail("it has version " + std::to_string(version) + ", this program reads " +
               std::to_string(formatVersion));
    if (r.value<uint32_t>() != byteOrderMark) r.fail("it is from a machine of other byte order");

    int width = r.value<int32_t>(), height = r.value<int32_t>();
    uint64_t dropped = r.value<uint64_t>();
    std::string token = r.text();
    uint32_t count = r.value<uint32_t>();
    if (count > maxAovs || width < 0 || height < 0) r.fail("it is damaged");
    std::vector<AovSpec> specs(count);
    for (AovSpec& spec : specs) {
        spec.name = r.text();
        spec.id = aovIdOf(spec.name);
        spec.components = r.value<int32_t>();
        int32_t kind = r.value<int32_t>();
        spec.clearValue = r.value<float>();
        spec.isInteger = r.value<uint32_t>() != 0;
        if (spec.components < 1 || spec.components > 16 || kind < 0 || kind > 1)
            r.fail("it is damaged");
        spec.kind = AovKind(kind);
    }

    uint64_t pixelCount = uint64_t(width) * uint64_t(height);
    std::vector<Pixel> pixels;
    r.array(pixels, pixelCount);
    std::vector<Plane> planes;
    for (const AovSpec& spec : specs) {
        Plane shape = clearedPlane(spec, 1); // says which of the two vectors is used, if any
        planes.emplace_back();
        r.array(planes.back().sums, shape.sums.size() * pixelCount);
        r.array(planes.back().nearest, shape.nearest.size() * pixelCount);
    }
    r.finish();

    _width = width;
    _height = height;
    _aovs = std::move(specs);
    _pixels = std::move(pixels);
    _planes = std::move(planes);
    _denoised.clear();
    _dropped = dropped;
    resumeToken = std::move(token);
}

} // namespace patina
