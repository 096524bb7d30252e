// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/filmFile.h"

#include "hdDelegate/film/temporaryFailure.h"
#include "base/regularFile.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>

namespace patina {

namespace {

constexpr uint32_t byteOrderMark = 0x01020304;

uint64_t load(const char* p, size_t bytes) {
    uint64_t word = 0;
    std::memcpy(&word, p, bytes);
    return word;
}

/// Others may put a link in its place where they may write to the folder.
FILE* opened(const std::string& temporary) {
    const int file = ::open(temporary.c_str(), O_WRONLY | O_TRUNC | O_NOFOLLOW | O_CLOEXEC);
    return file < 0 ? nullptr : ::fdopen(file, "wb");
}

} // namespace

void StreamChecksum::add(const void* data, size_t bytes) {
    const char* p = static_cast<const char*>(data);
    for (; bytes >= 8; bytes -= 8, p += 8)
        mix(load(p, 8));
    if (bytes) mix(load(p, bytes) ^ (uint64_t(bytes) << 56));
}

void StreamChecksum::mix(uint64_t word) {
    _state = (_state ^ word) * 0x9E3779B97F4A7C15ull;
    _state = (_state << 29) | (_state >> 35);
}

FilmFileWriter::FilmFileWriter(const FilmFileKind& kind, const std::string& temporary,
                               const std::string& name)
    : _kind(kind.name), _name(name), _file(opened(temporary), &std::fclose) {
    if (!_file) fail();
    bytes(kind.magic, sizeof kind.magic);
    value(kind.version);
    value(byteOrderMark);
}

void FilmFileWriter::bytes(const void* data, size_t size) {
    _sum.add(data, size);
    raw(data, size);
}

void FilmFileWriter::text(const std::string& s) {
    value(uint32_t(s.size()));
    bytes(s.data(), s.size());
}

void FilmFileWriter::finish() {
    const uint64_t sum = _sum.value();
    raw(&sum, sizeof sum);
    if (std::fflush(_file.get()) != 0 || std::fclose(_file.release()) != 0) fail();
}

void FilmFileWriter::raw(const void* data, size_t size) {
    if (size && std::fwrite(data, 1, size, _file.get()) != size) fail();
}

void FilmFileWriter::fail() {
    failWith(std::string("cannot write ") + _kind + " '" + _name + "'", errno);
}

FilmFileReader::FilmFileReader(const FilmFileKind& kind, const std::string& name)
    : _kind(kind.name), _name(name), _file(nullptr, &std::fclose) {
    const std::string problem = whyUnreadable(name, Limit::imageBytes);
    if (!problem.empty()) fail("it " + problem);
    _file.reset(std::fopen(name.c_str(), "rb"));
    if (!_file) fail(std::strerror(errno));
    std::fseek(_file.get(), 0, SEEK_END);
    _left = uint64_t(std::max(0L, std::ftell(_file.get())));
    std::rewind(_file.get());
    char start[sizeof kind.magic];
    bytes(start, sizeof start);
    if (std::memcmp(start, kind.magic, sizeof start) != 0)
        fail(std::string("it is not a ") + _kind);
    const uint32_t version = value<uint32_t>();
    if (version != kind.version)
        fail("it has version " + std::to_string(version) + ", this program reads " +
             std::to_string(kind.version));
    if (value<uint32_t>() != byteOrderMark) fail("it is from a machine of other byte order");
}

void FilmFileReader::bytes(void* data, size_t size) {
    raw(data, size);
    _sum.add(data, size);
}

std::string FilmFileReader::text(uint32_t longest) {
    const uint32_t size = value<uint32_t>();
    if (size > longest || size > _left) fail("it is damaged");
    std::string s(size, '\0');
    bytes(&s[0], size);
    return s;
}

void FilmFileReader::checkSeal() {
    const uint64_t expected = _sum.value();
    if (value<uint64_t>() != expected) fail("it is damaged (checksum differs)");
}

void FilmFileReader::finish() {
    const uint64_t expected = _sum.value();
    uint64_t stored;
    raw(&stored, sizeof stored);
    if (stored != expected) fail("it is damaged (checksum differs)");
    if (_left) fail("it is damaged (data after its end)");
}

void FilmFileReader::fail(const std::string& reason) const {
    throw std::runtime_error(std::string("cannot read ") + _kind + " '" + _name + "': " + reason);
}

void FilmFileReader::raw(void* data, size_t size) {
    if (size > _left || std::fread(data, 1, size, _file.get()) != size) fail("it is truncated");
    _left -= size;
}

} // namespace patina
