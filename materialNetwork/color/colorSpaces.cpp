// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/color/colorSpaces.h"

#include "materialNetwork/color/colorSpacesBuiltin.h"
#include "base/regularFile.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <mutex>
#include <stdexcept>

namespace ocio = OCIO_NAMESPACE;

namespace patina {

namespace {

constexpr const char* linearRec709 = "lin_rec709";

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// OCIO processors one after the other; none at all is the identity.
class OcioTransform : public ColorTransform {
public:
    explicit OcioTransform(const std::vector<ocio::ConstProcessorRcPtr>& processors) {
        // Lossless only: the default trades pow() for an approximation that is visible in ratios.
        for (auto& p : processors)
            if (!p->isNoOp())
                _steps.push_back(p->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS));
    }
    void apply(float* pixels, size_t count, int stride) const override {
        constexpr size_t maxAtOnce = 1 << 20; // OCIO counts in long
        for (size_t at = 0; at < count; at += maxAtOnce) {
            long n = long(std::min(maxAtOnce, count - at));
            ptrdiff_t step = stride * ptrdiff_t(sizeof(float));
            ocio::PackedImageDesc image(pixels + at * size_t(stride), n, 1, 3, ocio::BIT_DEPTH_F32,
                                        sizeof(float), step, step * n);
            for (auto& s : _steps)
                s->apply(image);
        }
    }
    bool isIdentity() const override { return _steps.empty(); }

private:
    std::vector<ocio::ConstCPUProcessorRcPtr> _steps;
};

ColorTransformPtr transformOf(const std::vector<ocio::ConstProcessorRcPtr>& processors) {
    return std::make_shared<OcioTransform>(processors);
}

/// @param to into the rendering space, not out of it
void applyMatrix(const RenderingSpace& space, bool to, float* pixels, size_t count, int stride) {
    for (size_t i = 0; i < count; ++i, pixels += stride) {
        const glm::vec3 color(pixels[0], pixels[1], pixels[2]);
        const glm::vec3 result = to ? space.from709(color) : space.to709(color);
        std::copy(&result.x, &result.x + 3, pixels);
    }
}

/// From a space to the rendering space, or from that to another, by way of linear Rec.709.
class Chained : public ColorTransform {
public:
    Chained(ColorTransformPtr other, const RenderingSpace& space, bool to)
        : _other(std::move(other)), _space(space), _to(to) {}
    void apply(float* pixels, size_t count, int stride) const override {
        if (!_to) applyMatrix(_space, false, pixels, count, stride);
        _other->apply(pixels, count, stride);
        if (_to) applyMatrix(_space, true, pixels, count, stride);
    }
    bool isIdentity() const override { return false; }

private:
    ColorTransformPtr _other;
    const RenderingSpace& _space;
    bool _to;
};

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (auto& n : names)
        text += (text.empty() ? "" : ", ") + n;
    return text;
}

} // namespace

struct ColorSpaces::Impl {
    ocio::ConstConfigRcPtr builtin, user; ///< user is null without a configuration of the user's
    std::string userRec709;   ///< the user's name of linear Rec.709, or what stands for it
    bool bridge = false;      ///< go through the interchange role instead of that name
    mutable std::mutex mutex; ///< of what follows
    mutable std::map<std::string, ColorTransformPtr> ofValues;

    const ocio::ConstConfigRcPtr& active() const { return user ? user : builtin; }
    void findRec709();
    bool isNamedData(const std::string& name) const; ///< by the configuration
    ColorTransformPtr convert(const std::string& name, bool toRec709) const;
};

// A user's configuration need not say which of its spaces is linear Rec.709. Exact is the way over
// ACES2065-1, if it names that; then the usual names; scene_linear is the last resort.
void ColorSpaces::Impl::findRec709() {
    if (user->hasRole(ocio::ROLE_INTERCHANGE_SCENE)) {
        bridge = true;
        return;
    }
    ocio::ConstColorSpaceRcPtr known = builtin->getColorSpace(linearRec709);
    std::vector<std::string> candidates = {linearRec709};
    for (size_t i = 0; i < known->getNumAliases(); ++i)
        candidates.push_back(known->getAlias(i));
    for (auto& name : candidates) {
        if (name == "linear" || !user->getColorSpace(name.c_str())) continue;
        userRec709 = name;
        return;
    }
    userRec709 = ocio::ROLE_SCENE_LINEAR;
    if (!user->getColorSpace(userRec709.c_str()))
        throw std::runtime_error("the OCIO configuration has no role scene_linear");
}

ColorTransformPtr ColorSpaces::Impl::convert(const std::string& name, bool toRec709) const {
    if (isData(name)) return transformOf({});
    try {
        if (const ocio::ConstTransformRcPtr own = parseChromaticities(name))
            return transformOf({builtin->getProcessor(
                own, toRec709 ? ocio::TRANSFORM_DIR_FORWARD : ocio::TRANSFORM_DIR_INVERSE)});
        if (user && user->getColorSpace(name.c_str())) {
            if (user->getColorSpace(name.c_str())->isData()) return transformOf({});
            if (bridge)
                return transformOf({toRec709 ? ocio::Config::GetProcessorFromConfigs(
                                                   user, name.c_str(), builtin, linearRec709)
                                             : ocio::Config::GetProcessorFromConfigs(
                                                   builtin, linearRec709, user, name.c_str())});
            return transformOf({toRec709 ? user->getProcessor(name.c_str(), userRec709.c_str())
                                         : user->getProcessor(userRec709.c_str(), name.c_str())});
        }
        if (!builtin->getColorSpace(name.c_str())) return nullptr;
        return transformOf({toRec709 ? builtin->getProcessor(name.c_str(), linearRec709)
                                     : builtin->getProcessor(linearRec709, name.c_str())});
    } catch (const ocio::Exception&) {
        return nullptr;
    }
}

bool ColorSpaces::Impl::isNamedData(const std::string& name) const {
    for (const auto* config : {&user, &builtin})
        if (*config)
            if (const ocio::ConstColorSpaceRcPtr space = (*config)->getColorSpace(name.c_str()))
                return space->isData();
    return false;
}

ColorSpaces::ColorSpaces(const std::string& configFile) : _impl(new Impl) {
    _impl->builtin = builtinColorConfig();
    if (configFile.empty()) return;
    try {
        if (configFile.rfind("ocio://", 0) != 0) { // those are in the library
            const std::string problem = whyUnreadable(configFile, Limit::documentBytes);
            if (!problem.empty()) throw std::runtime_error("the file " + problem);
        }
        _impl->user = ocio::Config::CreateFromFile(configFile.c_str());
        _impl->findRec709();
    } catch (const std::exception& e) {
        throw std::runtime_error("cannot use OCIO configuration '" + configFile +
                                 "': " + oneLine(e.what()));
    }
}

ColorSpaces::~ColorSpaces() = default;

namespace {

struct Shared {
    std::unique_ptr<ColorSpaces> spaces;
    std::optional<Message> problem;
    Shared() {
        const char* file = std::getenv("OCIO");
        try {
            spaces = std::make_unique<ColorSpaces>(file ? file : "");
        } catch (const std::exception& e) {
            problem = messages::ocioUnusable(e.what());
            spaces = std::make_unique<ColorSpaces>();
        }
    }
};

const Shared& sharedSpaces() {
    static const Shared shared;
    return shared;
}

} // namespace

const ColorSpaces& ColorSpaces::shared() {
    return *sharedSpaces().spaces;
}

const std::optional<Message>& ColorSpaces::sharedProblem() {
    return sharedSpaces().problem;
}

bool ColorSpaces::isData(const std::string& name) {
    static const char* const names[] = {"",     "raw",      "none",    "non-color",    "noncolor",
                                        "data", "identity", "unknown", "utility - raw"};
    std::string n = lower(name);
    return std::any_of(std::begin(names), std::end(names), [&](const char* d) { return n == d; });
}

std::string ColorSpaces::nameOf(const std::string& name) const {
    for (const auto* config : {&_impl->user, &_impl->builtin})
        if (*config)
            if (const ocio::ConstColorSpaceRcPtr space = (*config)->getColorSpace(name.c_str()))
                return space->getName();
    return parseChromaticities(name) ? name : std::string();
}

ColorTransformPtr ColorSpaces::toRec709(const std::string& name) const {
    return _impl->convert(name, true);
}

ColorTransformPtr ColorSpaces::fromRec709(const std::string& name) const {
    return _impl->convert(name, false);
}

ColorTransformPtr ColorSpaces::toRendering(const std::string& name,
                                           const RenderingSpace& to) const {
    const ColorTransformPtr transform = toRec709(name);
    if (!transform || to.isRec709() || isData(name) || _impl->isNamedData(name)) return transform;
    if (nameOf(name) == to.name) return transformOf({});
    return std::make_shared<Chained>(transform, to, true);
}

bool ColorSpaces::valueToRec709(const std::string& name, float* values, size_t count,
                                int stride) const {
    if (isData(name) || lower(name) == "auto") return true;
    ColorTransformPtr transform;
    {
        const std::lock_guard<std::mutex> lock(_impl->mutex);
        const auto known = _impl->ofValues.find(name);
        // Names come from documents: there may be any number of them.
        if (known == _impl->ofValues.end() && _impl->ofValues.size() >= 1000)
            _impl->ofValues.clear();
        transform = known != _impl->ofValues.end()
                        ? known->second
                        : _impl->ofValues[name] = _impl->convert(name, true);
    }
    if (transform) transform->apply(values, count, stride);
    return bool(transform);
}

bool ColorSpaces::valueToRendering(const std::string& name, const RenderingSpace& to, float* values,
                                   size_t count, int stride) const {
    const bool known = valueToRec709(name, values, count, stride);
    if (!to.isRec709() && (name.empty() || !(isData(name) || _impl->isNamedData(name))))
        applyMatrix(to, true, values, count, stride);
    return known;
}

ColorTransformPtr ColorSpaces::display(const std::string& display, const std::string& view,
                                       const RenderingSpace& from) const {
    const ocio::ConstConfigRcPtr& config = _impl->active();
    std::string d = display.empty() ? config->getDefaultDisplay() : display;
    std::vector<std::string> known = displays();
    if (std::find(known.begin(), known.end(), d) == known.end())
        throw std::runtime_error("unknown display '" + d + "'; known are " + listed(known));
    std::string v = view.empty() ? config->getDefaultView(d.c_str()) : view;
    known = views(d);
    if (std::find(known.begin(), known.end(), v) == known.end())
        throw std::runtime_error("display '" + d + "' has no view '" + v + "'; known are " +
                                 listed(known));
    try {
        std::vector<ocio::ConstProcessorRcPtr> steps;
        std::string source = _impl->user ? _impl->userRec709 : linearRec709;
        if (_impl->user && _impl->bridge) {
            source = ocio::ROLE_INTERCHANGE_SCENE;
            steps.push_back(ocio::Config::GetProcessorFromConfigs(_impl->builtin, linearRec709,
                                                                  config, source.c_str()));
        }
        auto transform = ocio::DisplayViewTransform::Create();
        transform->setSrc(source.c_str());
        transform->setDisplay(d.c_str());
        transform->setView(v.c_str());
        steps.push_back(config->getProcessor(transform));
        const ColorTransformPtr of709 = transformOf(steps);
        if (from.isRec709()) return of709;
        return std::make_shared<Chained>(of709, from, false);
    } catch (const ocio::Exception& e) {
        throw std::runtime_error("display '" + d + "', view '" + v + "': " + oneLine(e.what()));
    }
}

std::vector<std::string> ColorSpaces::displays() const {
    const ocio::ConstConfigRcPtr& config = _impl->active();
    std::vector<std::string> names;
    for (int i = 0; i < config->getNumDisplays(); ++i)
        names.push_back(config->getDisplay(i));
    return names;
}

std::vector<std::string> ColorSpaces::views(const std::string& display) const {
    const ocio::ConstConfigRcPtr& config = _impl->active();
    std::vector<std::string> names;
    for (int i = 0; i < config->getNumViews(display.c_str()); ++i)
        names.push_back(config->getView(display.c_str(), i));
    return names;
}

std::vector<std::string> ColorSpaces::names() const {
    std::vector<std::string> names;
    for (auto* config : {&_impl->user, &_impl->builtin}) {
        if (!*config) continue;
        for (int i = 0; i < (*config)->getNumColorSpaces(); ++i) {
            std::string name = (*config)->getColorSpaceNameByIndex(i);
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
    }
    return names;
}

} // namespace patina
