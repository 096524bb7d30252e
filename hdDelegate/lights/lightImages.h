// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/imageTextureLoad.h"
#include "hdDelegate/lights/environmentMap.h"
#include "hdDelegate/scene/light.h"

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace patina {

/// Reads the images of lights and keeps them, with what importance sampling needs, from one build
/// of the lights to the next. Thread safe.
class LightImages {
public:
    /// Reads one image. The default reads through loadImageLinear().
    using Loader = std::function<ImageRGB(const std::string& file, const std::string& colorSpace,
                                          const std::string& prim, const std::string& input)>;

    explicit LightImages(Loader loader) : _loader(std::move(loader)) {}
    explicit LightImages(Diagnostics& diagnostics);

    /// @returns never null; one magenta pixel where the file cannot be read
    std::shared_ptr<const ImageRGB> image(const std::string& file, const std::string& colorSpace,
                                          const std::string& prim, const std::string& input);
    /// That of a light which has one: its texture, and what its network paints.
    std::shared_ptr<const ImageRGB> image(const Light& light);
    /// The same around a dome.
    std::shared_ptr<const EnvironmentMap> environment(const Light& dome);

    /// The space of colours, for what is asked for from now on.
    void setRenderingSpace(const RenderingSpace& space) { _renderingSpace = &space; }

    /// Lets go of what no light holds any more. For a back end that has built its lights.
    void forgetUnused();

private:
    using Image = std::shared_ptr<const ImageRGB>;
    /// @param make asked where there is none of that key
    Image kept(const std::string& key, const std::function<ImageRGB()>& make);
    std::string keyOf(const Light& light) const;

    Loader _loader;
    Diagnostics* _diagnostics = nullptr; ///< of networks; null: nobody reads them
    std::atomic<const RenderingSpace*> _renderingSpace{&RenderingSpace::rec709()};
    std::mutex _mutex;
    std::mutex _building; ///< of environments: who waits for one shares it
    std::map<std::string, Image> _images;
    std::map<std::string, std::shared_ptr<const EnvironmentMap>> _environments;
};

} // namespace patina
