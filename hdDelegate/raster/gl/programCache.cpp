// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/programCache.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace patina {

namespace {

/// FNV-1a (Fowler, Noll, Vo 1991).
uint64_t hash(const void* data, size_t size, uint64_t h) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (size_t i = 0; i < size; ++i)
        h = (h ^ bytes[i]) * 1099511628211u;
    return h;
}

constexpr uint64_t seeds[2] = {14695981039346656037u, 0x9e3779b97f4a7c15u};

struct Header {
    char magic[8] = {'P', 'a', 't', 'G', 'l', 's', 'l', '1'};
    uint64_t key[2] = {0, 0};   ///< the file's name says so, too
    uint64_t size = 0, sum = 0; ///< of the bytes that follow
    uint64_t format = 0;
};

std::string folderOf() {
    if (const char* own = std::getenv("PATINA_CACHE"))
        return *own ? std::string(own) + "/programs" : std::string();
    const char* base = std::getenv("XDG_CACHE_HOME");
    if (base && *base == '/') return std::string(base) + "/patina/programs";
    const char* home = std::getenv("HOME");
    return home && *home == '/' ? std::string(home) + "/.cache/patina/programs" : std::string();
}

/// Makes a folder where it is missing, and takes the right to write from all but its user: the
/// driver runs what is in it.
/// @returns whether it is this user's
bool closed(const fs::path& folder) {
    ::mkdir(folder.c_str(), 0700);
    struct stat found;
    return ::stat(folder.c_str(), &found) == 0 && S_ISDIR(found.st_mode) &&
           found.st_uid == ::geteuid() &&
           (!(found.st_mode & 022) || ::chmod(folder.c_str(), found.st_mode & 0755) == 0);
}

/// Makes the folder of programs. In the user's own cache nobody else may write it, nor what holds
/// it.
bool makeFolder(const fs::path& folder) {
    std::error_code error;
    const fs::path base = folder.parent_path();
    fs::create_directories(base.parent_path(), error);
    if (!std::getenv("PATINA_CACHE")) return closed(base) && closed(folder);
    fs::create_directory(base, error);
    ::mkdir(folder.c_str(), 0700);
    return true;
}

bool readFile(const std::string& file, const Header& wanted, Header& header,
              std::vector<char>& bytes) {
    std::ifstream in(file, std::ios::binary);
    if (!in.read(reinterpret_cast<char*>(&header), sizeof header)) return false;
    if (std::memcmp(header.magic, wanted.magic, sizeof header.magic) != 0 ||
        !std::equal(header.key, header.key + 2, wanted.key) || header.size == 0 ||
        header.size > ProgramCache::largestFile)
        return false;
    bytes.resize(size_t(header.size));
    return in.read(bytes.data(), std::streamsize(bytes.size())) &&
           hash(bytes.data(), bytes.size(), seeds[0]) == header.sum;
}

/// The key as the header holds it.
Header headerOf(const std::string& key) {
    Header header;
    for (int i = 0; i < 2; ++i)
        header.key[i] = hash(key.data(), key.size(), seeds[i]);
    return header;
}

} // namespace

ProgramCache::ProgramCache(const std::vector<std::string>& sources) : _folder(folderOf()) {
    GLint formats = 0;
    if (!_folder.empty()) gl.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    if (formats < 1 || !makeFolder(_folder)) return;
    for (const GLenum name : {GL_VENDOR, GL_RENDERER, GL_VERSION}) {
        const GLubyte* text = gl.GetString(name);
        _key += text ? reinterpret_cast<const char*>(text) : "";
        _key += '\0';
    }
    for (const std::string& source : sources) {
        _key += std::to_string(source.size()) + ':';
        _key += source;
    }
    const Header header = headerOf(_key);
    char name[40];
    std::snprintf(name, sizeof name, "%016llx%016llx",
                  static_cast<unsigned long long>(header.key[0]),
                  static_cast<unsigned long long>(header.key[1]));
    _file = _folder + "/" + name + ".glprogram";
}

bool ProgramCache::load(GLuint program) const {
    if (_file.empty()) return false;
    Header header;
    std::vector<char> bytes;
    if (!readFile(_file, headerOf(_key), header, bytes)) return false;
    gl.ProgramBinary(program, GLenum(header.format), bytes.data(), GLsizei(bytes.size()));
    GLint ok = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &ok);
    if (gl.GetError() != GL_NO_ERROR || !ok) return false;
    ::utimensat(AT_FDCWD, _file.c_str(), nullptr, 0); // used now; see trim()
    return true;
}

void ProgramCache::prepare(GLuint program) const {
    if (!_file.empty()) gl.ProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
}

void ProgramCache::store(GLuint program) const {
    if (_file.empty()) return;
    GLint length = 0;
    gl.GetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length < 1 || uint64_t(length) > largestFile) return;
    std::vector<char> bytes(static_cast<size_t>(length));
    GLenum format = 0;
    GLsizei written = 0;
    gl.GetProgramBinary(program, length, &written, &format, bytes.data());
    if (gl.GetError() != GL_NO_ERROR || written < 1) return;
    bytes.resize(size_t(written));
    Header header = headerOf(_key);
    header.size = bytes.size();
    header.sum = hash(bytes.data(), bytes.size(), seeds[0]);
    header.format = format;

    makeFolder(_folder); // it may have been removed
    static std::atomic<unsigned> counter{0};
    const unsigned number = counter++;
    const std::string temporary =
        _file + "." + std::to_string(::getpid()) + "-" + std::to_string(number) + ".part";
    {
        std::ofstream out(temporary, std::ios::binary);
        out.write(reinterpret_cast<const char*>(&header), sizeof header);
        out.write(bytes.data(), std::streamsize(bytes.size()));
        out.close();
        if (!out || std::rename(temporary.c_str(), _file.c_str()) != 0)
            std::remove(temporary.c_str());
    }
    if (number % 16 == 0) trim(_folder, largestFolder);
}

void ProgramCache::trim(const std::string& folder, uint64_t limit) {
    struct File {
        fs::file_time_type used;
        uint64_t size;
        fs::path path;
    };
    std::vector<File> files;
    uint64_t sum = 0;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code gone; // another process may trim, too
        const std::string extension = it->path().extension().string();
        if ((extension != ".glprogram" && extension != ".part") || !it->is_regular_file(gone))
            continue;
        const File file{it->last_write_time(gone), uint64_t(it->file_size(gone)), it->path()};
        if (gone) continue;
        sum += file.size;
        files.push_back(file);
    }
    if (sum <= limit) return;
    std::sort(files.begin(), files.end(),
              [](const File& a, const File& b) { return a.used < b.used; });
    for (const File& file : files) {
        if (sum <= limit / 4 * 3) break;
        fs::remove(file.path, error);
        sum -= file.size;
    }
}

} // namespace patina
