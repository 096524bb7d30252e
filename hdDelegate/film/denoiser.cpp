// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/denoiser.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <stdexcept>

namespace patina {

namespace {

/// The C interface of Open Image Denoise, versions 1.4 and 2, as far as it is needed.
struct Library {
    using Handle = void*;
    static constexpr int typeCpu = 1, formatFloat3 = 3;

    Handle (*newDevice)(int type) = nullptr;
    void (*setDeviceInt)(Handle, const char*, int) = nullptr;
    void (*commitDevice)(Handle) = nullptr;
    void (*releaseDevice)(Handle) = nullptr;
    int (*deviceError)(Handle, const char**) = nullptr;
    Handle (*newFilter)(Handle, const char*) = nullptr;
    void (*setImage)(Handle, const char*, void*, int format, size_t width, size_t height,
                     size_t offset, size_t pixelStride, size_t rowStride) = nullptr;
    void (*setBool)(Handle, const char*, bool) = nullptr;
    void (*commitFilter)(Handle) = nullptr;
    void (*executeFilter)(Handle) = nullptr;
    void (*releaseFilter)(Handle) = nullptr;
    std::string missing;

    explicit Library(const std::vector<std::string>& paths) {
        void* file = nullptr;
        for (const std::string& path : paths) {
            file = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
            if (file) break;
            const char* why = dlerror();
            if (missing.empty() && why) missing = why;
        }
        if (!file) {
            missing = "Open Image Denoise is not found (" + missing + ")";
            return;
        }
        missing.clear();
        find(file, newDevice, "oidnNewDevice");
        find(file, setDeviceInt, "oidnSetDeviceInt", "oidnSetDevice1i");
        find(file, commitDevice, "oidnCommitDevice");
        find(file, releaseDevice, "oidnReleaseDevice");
        find(file, deviceError, "oidnGetDeviceError");
        find(file, newFilter, "oidnNewFilter");
        find(file, setImage, "oidnSetSharedFilterImage");
        find(file, setBool, "oidnSetFilterBool", "oidnSetFilter1b");
        find(file, commitFilter, "oidnCommitFilter");
        find(file, executeFilter, "oidnExecuteFilter");
        find(file, releaseFilter, "oidnReleaseFilter");
    }

private:
    template <class Function>
    void find(void* file, Function& function, const char* name, const char* older = nullptr) {
        void* found = dlsym(file, name);
        if (!found && older) found = dlsym(file, older);
        if (!found && missing.empty())
            missing = std::string("this Open Image Denoise has no function ") + name;
        function = reinterpret_cast<Function>(found);
    }
};

std::mutex mutex;
std::string chosen;
std::shared_ptr<const Library> loaded;

/// A library that was found stays: its threads live on. A missing one is looked for again.
std::shared_ptr<const Library> library() {
    const std::lock_guard<std::mutex> lock(mutex);
    if (loaded && loaded->missing.empty()) return loaded;
    std::vector<std::string> paths;
    const char* named = std::getenv("PATINA_OIDN_LIBRARY");
    if (!chosen.empty())
        paths.push_back(chosen);
    else if (named && *named)
        paths.push_back(named);
    else
        paths = {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1"};
    loaded = std::make_shared<const Library>(paths);
    return loaded;
}

/// A device of the library, and its filters.
class Device {
public:
    Device(const Library& library, int threads)
        : _library(library), _device(library.newDevice(Library::typeCpu)) {
        if (!_device) throw std::runtime_error("Open Image Denoise finds no device");
        if (threads > 0) _library.setDeviceInt(_device, "numThreads", threads);
        _library.commitDevice(_device);
        check();
    }
    ~Device() { _library.releaseDevice(_device); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    struct Image {
        const char* name;
        std::vector<float>& pixels;
    };

    /// @param images by their names in the library, three floats per pixel; "output" is written
    void filter(const std::vector<Image>& images, const std::vector<const char*>& flags, int width,
                int height) {
        void* filter = _library.newFilter(_device, "RT");
        if (filter) {
            for (const Image& image : images)
                _library.setImage(filter, image.name, image.pixels.data(), Library::formatFloat3,
                                  size_t(width), size_t(height), 0, 0, 0);
            for (const char* flag : flags)
                _library.setBool(filter, flag, true);
            _library.commitFilter(filter);
            _library.executeFilter(filter);
            _library.releaseFilter(filter);
        }
        check();
    }

private:
    void check() {
        const char* message = nullptr;
        if (_library.deviceError(_device, &message) == 0) return;
        const std::string text = message ? message : "unknown error";
        throw std::runtime_error("Open Image Denoise: " + text.substr(0, text.find('\n')));
    }

    const Library& _library;
    void* _device;
};

/// From so many samples of a pixel on, in the mean, guides count as free of noise. With fewer the
/// filter takes them as noisy. Cleaning them first takes three to seven times as long as that, in
/// which further samples gain more (docs/measurements/denoise.md).
constexpr double samplesOfCleanGuides = 4.0;

/// Of the pixels that have any: a crop of the image leaves the others empty.
double meanSamples(const Film& film) {
    double sum = 0.0, pixels = 0.0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            sum += film.sampleCount(x, y);
            pixels += film.sampleCount(x, y) > 0;
        }
    return pixels > 0.0 ? sum / pixels : 0.0;
}

} // namespace

void setDenoiserLibrary(const std::string& path) {
    const std::lock_guard<std::mutex> lock(mutex);
    chosen = path;
}

std::string denoiserMissing() {
    return library()->missing;
}

void denoise(Film& film, int threads, bool ofLight) {
    const std::shared_ptr<const Library> found = library();
    if (!found->missing.empty()) throw std::runtime_error(found->missing);
    const int width = film.width(), height = film.height();
    if (width < 1 || height < 1) throw std::runtime_error("there is no image to denoise");

    std::vector<float> albedo = film.resolve(denoisingAlbedoAov);
    std::vector<float> normal = film.resolve(denoisingNormalAov);
    for (float& value : albedo)
        value = std::clamp(value, 0.0f, 1.0f);
    const bool guided = !albedo.empty() && !normal.empty();
    std::vector<const char*> flags = {"hdr"};
    if (guided && meanSamples(film) >= samplesOfCleanGuides) flags.push_back("cleanAux");
    std::vector<std::string> aovs = {"color"};
    for (const AovSpec& spec : film.aovs())
        if (ofLight && (!spec.paths.empty() || spec.id == AovId::shadow)) aovs.push_back(spec.name);
    Device device(*found, threads);
    std::vector<std::vector<float>> results;
    for (const std::string& aov : aovs) {
        std::vector<float> noisy = film.resolve(film.denoised(aov) ? aov + ".noisy" : aov);
        results.emplace_back(noisy.size());
        std::vector<Device::Image> images = {{"color", noisy}, {"output", results.back()}};
        if (guided) images.push_back({"albedo", albedo}), images.push_back({"normal", normal});
        device.filter(images, flags, width, height);
    }
    for (size_t i = 0; i < aovs.size(); ++i)
        film.setDenoised(std::move(results[i]), aovs[i]);
}

std::vector<float> denoisedPixels(std::vector<float>& color, std::vector<float>& albedo,
                                  std::vector<float>& normal, int width, int height,
                                  bool cleanGuides, int threads) {
    const std::shared_ptr<const Library> found = library();
    if (!found->missing.empty()) throw std::runtime_error(found->missing);
    for (float& value : albedo)
        value = std::clamp(value, 0.0f, 1.0f);
    std::vector<const char*> flags = {"hdr"};
    if (cleanGuides) flags.push_back("cleanAux");
    std::vector<float> result(color.size());
    Device(*found, threads)
        .filter({{"color", color}, {"output", result}, {"albedo", albedo}, {"normal", normal}},
                flags, width, height);
    return result;
}

} // namespace patina
