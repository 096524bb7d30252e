// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/backends/backends.h"

#include "hdDelegate/backends/fallbackRenderer.h"
#include "hdDelegate/backends/interactiveRenderer.h"

#ifdef PATINA_HAS_RASTER
#include "hdDelegate/raster/gl/hostContext.h"
#include "hdDelegate/raster/rasterRenderer.h"
#endif

namespace patina {

namespace {

std::unique_ptr<Renderer> makeRaster([[maybe_unused]] const std::shared_ptr<HostDevice>& device,
                                     std::string& error) {
#ifdef PATINA_HAS_RASTER
    return makeRasterRenderer(error, std::dynamic_pointer_cast<HostContext>(device));
#else
    error = "the rasterizer cannot run: EGL was not found when Patina was built";
    return nullptr;
#endif
}

bool worthWhile() {
#ifdef PATINA_HAS_RASTER
    return hasGpu();
#else
    return false;
#endif
}

} // namespace

const std::vector<std::string>& backendNames() {
    static const std::vector<std::string> names = {"auto", "embree", "raster", "interactive"};
    return names;
}

bool rasterizes(const std::string& name) {
    return name == "raster" || name == "interactive" || (name == "auto" && worthWhile());
}

std::unique_ptr<Renderer> makeBackend(const std::string& wanted,
                                      const std::shared_ptr<HostDevice>& device) {
    const std::string name = wanted != "auto" ? wanted : worthWhile() ? "interactive" : "embree";
    if (name != "raster" && name != "interactive") return makeRenderer(name);
    std::string error;
    std::unique_ptr<Renderer> raster = makeRaster(device, error);
    if (name == "interactive" && raster)
        return std::make_unique<InteractiveRenderer>(std::move(raster), makeRenderer("embree"));
    return std::make_unique<FallbackRenderer>(std::move(raster), error, makeRenderer("embree"));
}

std::shared_ptr<HostDevice> currentHostDevice(std::string& why) {
#ifdef PATINA_HAS_RASTER
    return HostContext::current(why);
#else
    why = "EGL was not found when Patina was built";
    return nullptr;
#endif
}

} // namespace patina
