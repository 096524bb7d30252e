// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace patina {

/// A 64-bit checksum of a stream: words are mixed by a multiplication and a rotation each, so that
/// order counts and every bit of a word reaches the result.
class StreamChecksum {
public:
    void add(const void* data, size_t bytes);
    uint64_t value() const { return _state ^ (_state >> 31); }

private:
    void mix(uint64_t word);
    uint64_t _state = 0x243F6A8885A308D3ull;
};

using FilePtr = std::unique_ptr<FILE, int (*)(FILE*)>;

/// The name of a file with accumulators in messages, and how the file begins.
struct FilmFileKind {
    const char* name;     ///< "checkpoint"
    char magic[8];        ///< no terminator
    uint32_t version = 0; ///< of the layout
};

/// Writes the binary files of films: magic, version, byte-order mark, values, and a checksum of all
/// that stands before it.
/// @throws std::runtime_error with a one-line reason
class FilmFileWriter {
public:
    /// @param temporary what is written to
    /// @param name as messages have it
    FilmFileWriter(const FilmFileKind& kind, const std::string& temporary, const std::string& name);
    void bytes(const void* data, size_t size);
    template <class T> void value(T v) { bytes(&v, sizeof v); }
    void text(const std::string& s);
    void seal() { value(_sum.value()); } ///< what stands before can be trusted when it is read
    void finish();

private:
    void raw(const void* data, size_t size);
    [[noreturn]] void fail();

    const char* _kind;
    std::string _name;
    FilePtr _file;
    StreamChecksum _sum;
};

/// Reads them.
/// @throws std::runtime_error with a one-line reason
class FilmFileReader {
public:
    FilmFileReader(const FilmFileKind& kind, const std::string& name);
    void bytes(void* data, size_t size);
    template <class T> T value() {
        T v;
        bytes(&v, sizeof v);
        return v;
    }
    std::string text(uint32_t longest);
    void checkSeal();
    uint64_t left() const { return _left; } ///< bytes
    void finish();
    [[noreturn]] void fail(const std::string& reason) const;

private:
    void raw(void* data, size_t size);

    const char* _kind;
    std::string _name;
    FilePtr _file;
    uint64_t _left = 0;
    StreamChecksum _sum;
};

} // namespace patina
