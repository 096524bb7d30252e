#include "hdDelegate/raster/rasterLights.h"

#include "hdDelegate/film/sampler.h"
#include "hdDelegate/scene/lightShaping.h"
#include "hdDelegate/scene/lightUnits.h"
#include "materialNetwork/diagnostics.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr float pi = 3.14159265f;

/// The rotation nearest to a transform in the order z, y, x; its scale is dropped.
mat3 rotationOf(const mat4& m) {
    const vec3 z = glm::normalize(vec3(m[2]));
    vec3 y = vec3(m[1]) - glm::dot(vec3(m[1]), z) * z;
    y = glm::normalize(y);
    vec3 x = glm::cross(y, z);
    if (glm::dot(x, vec3(m[0])) < 0.0f) x = -x;
    const mat3 r(x, y, z);
    return std::isfinite(x.x + y.x + z.x) ? r : mat3(1.0f);
}

bool isFinite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Pair `set` of a pass. Sets are scrambled apart from each other and from those of
/// rasterRenderer.cpp, so that no light's samples go with the pixels' offsets.
vec2 passNumbers(uint32_t seed, uint32_t pass, uint32_t set) {
    return Sampler(set, 1, seed, pass).next2();
}

} // namespace

RasterLights::RasterLights(const SceneState& state, const RenderSettings& settings,
                           RasterInstances& places, float timeCode, int domeSamples,
                           LightImages& images, const std::map<std::string, int>& categories,
                           Diagnostics& diagnostics)
    : _domeSamples(domeSamples), _seed(uint32_t(settings.seed)), _shadows(settings.enableShadows) {
    if (!settings.enableSceneLights) return;
    for (const auto& item : state.lights) {
        const Light& light = *item.second;
        if (!light.visible) continue;
        if (light.type == LightType::Mesh) continue; // see RasterEmitters
        for (const RasterPlace& place : places.places(light.group))
            add(light, place.groupToWorld * transformAt(light.transform, timeCode), images,
                categories, diagnostics);
    }
    if (!settings.domeLightCameraVisibility)
        for (Source& s : _sources)
            s.cameraVisible &= s.kind != Dome;
    uploadDome();
}

void RasterLights::add(const Light& light, const mat4& toWorld, LightImages& images,
                       const std::map<std::string, int>& categories, Diagnostics& diagnostics) {
    Source s;
    s.radiance = glm::max(lightRadiance(light, toWorld), vec3(0.0f));
    if (!isFinite(s.radiance) && light.normalize) s.radiance = vec3(0.0f);
    if (!isFinite(s.radiance)) {
        diagnostics.warn(light.path, "inputs:intensity", "the light is not finite; it is off");
        return;
    }
    s.position = vec3(toWorld[3]);
    s.shadows = light.shadowEnable;
    s.cameraVisible = light.cameraVisible;
    GpuLight& g = s.fixed;
    g.shadow = vec4(-1.0f, 0.0f, 0.0f, 0.0f);
    g.shadowColor = vec4(light.shadowColor, 0.0f);
    const auto category = categories.find(light.lightLink);
    // A link that no drawn prim is in lights nothing.
    const int lit = light.lightLink.empty()        ? -1
                    : category == categories.end() ? 63
                                                   : category->second;
    const LightShaping shaping(light, toWorld, nullptr);
    g.shaping = vec4(shaping.axis(), shaping.active() ? light.shapingFocus : 0.0f);
    const bool cone = light.shapingConeAuthored && light.shapingConeAngle < 180.0f;
    g.focusTint = vec4(light.shapingFocusTint, cone ? 1.0f : 0.0f);
    const float cutoff = light.shapingConeAngle * pi / 180.0f;
    const float softness = std::clamp(light.shapingConeSoftness, 0.0f, 1.0f);
    g.cone = vec4(cutoff * (1.0f - softness), cutoff, 0.0f, 0.0f);
    if (!light.iesFile.empty())
        diagnostics.warn(light.path, "inputs:shaping:ies:file",
                         "the rasterizer does not read IES profiles");
    switch (light.type) {
    case LightType::Distant: {
        s.kind = Distant;
        s.toLight = glm::normalize(vec3(toWorld[2]));
        s.halfAngle = 0.5f * std::clamp(light.angle, 0.0f, 180.0f) * pi / 180.0f;
        const float sine = std::sin(0.5f * s.halfAngle);
        g.cone.z = 2.0f * sine * sine;
        g.cone.w = 2.0f * pi * g.cone.z;
        s.delta = !(g.cone.z > 0.0f);
        break;
    }
    case LightType::Dome:
        s.kind = _dome < 0 ? Dome : OtherDome;
        s.domeToWorld = rotationOf(toWorld);
        if (!light.textureFile.empty())
            s.environment = images.environment(light.textureFile, light.textureColorSpace,
                                               environmentFormat(light.textureFormat), light.path,
                                               "inputs:texture:file");
        if (_dome < 0) _dome = int(_sources.size());
        break;
    default: {
        const bool point = light.type == LightType::Sphere &&
                           (light.treatAsPoint || (light.radius == 0.0f && light.normalize));
        if (point) {
            s.kind = Point;
            s.delta = true;
            const double size = lightSizeFactor(light, toWorld);
            s.radiance = glm::max(lightBaseRadiance(light), vec3(0.0f)) * 0.25f *
                         (light.normalize ? 1.0f : float(size));
            break;
        }
        s.shape = makeAreaShape(light, toWorld);
        if (!s.shape.valid) {
            diagnostics.warn(light.path, "xformOpOrder", "the light has no size and is off");
            return;
        }
        s.kind = Kind(int(s.shape.kind));
        if (light.type == LightType::Rect && !light.textureFile.empty()) {
            const auto image = images.image(light.textureFile, light.textureColorSpace, light.path,
                                            "inputs:texture:file");
            glm::dvec3 sum(0.0);
            for (const vec3& p : image->pixels)
                sum += glm::dvec3(p);
            s.radiance *= vec3(sum / double(std::max<size_t>(1, image->pixels.size())));
            diagnostics.warn(light.path, "inputs:texture:file",
                             "the rasterizer shows the mean of a rect light's texture");
        }
    }
    }
    for (int i = 0; i < 3; ++i) {
        g.axis[i] = vec4(s.shape.axes[i], 0.0f);
        g.inverse[i] = vec4(s.shape.inverse[i], 0.0f);
    }
    g.axis[2].w = float(lit);
    g.inverse[0].w = light.diffuse;
    g.inverse[1].w = light.specular;
    g.inverse[2].w = s.cameraVisible && !s.delta ? 1.0f : 0.0f;
    g.origin = vec4(s.kind == Distant ? s.toLight : s.shape.origin, s.delta ? 1.0f : 0.0f);
    if (s.radiance != vec3(0.0f)) _sources.push_back(std::move(s));
    if (_dome >= int(_sources.size())) _dome = -1;
}

/// The image and its density as latlong maps, whatever the format of the file.
void RasterLights::uploadDome() {
    if (_dome < 0 || !_sources[size_t(_dome)].environment) return;
    const EnvironmentMap& map = *_sources[size_t(_dome)].environment;
    const auto directionAt = [](int x, int y, int w, int h) {
        const float longitude = (0.5f - (float(x) + 0.5f) / float(w)) * 2.0f * pi;
        const float theta = (float(y) + 0.5f) / float(h) * pi;
        return vec3(std::sin(theta) * std::sin(longitude), std::cos(theta),
                    std::sin(theta) * std::cos(longitude));
    };
    const int w = 1024, h = 512, dw = 512, dh = 256;
    std::vector<vec4> image(size_t(w) * h);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            image[size_t(y) * w + x] = vec4(map.radiance(directionAt(x, y, w, h)), 1.0f);
    _domeMap = GlTexture(GL_TEXTURE_2D, GL_RGBA32F, w, h, 1, 0);
    gl.TextureSubImage2D(_domeMap.id(), 0, 0, 0, w, h, GL_RGBA, GL_FLOAT, image.data());
    gl.GenerateTextureMipmap(_domeMap.id());
    _domeMap.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    _domeMap.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    _domeMap.parameter(GL_TEXTURE_WRAP_S, GL_REPEAT);
    _domeMap.parameter(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    std::vector<float> density(size_t(dw) * dh);
    for (int y = 0; y < dh; ++y)
        for (int x = 0; x < dw; ++x)
            density[size_t(y) * dw + x] = map.pdf(directionAt(x, y, dw, dh));
    _domeDensity = GlTexture(GL_TEXTURE_2D, GL_R32F, dw, dh);
    gl.TextureSubImage2D(_domeDensity.id(), 0, 0, 0, dw, dh, GL_RED, GL_FLOAT, density.data());
    _domeDensity.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    _domeDensity.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    _domeDensity.parameter(GL_TEXTURE_WRAP_S, GL_REPEAT);
}

vec3 RasterLights::domeRadiance() const {
    return _dome < 0 ? vec3(0.0f) : _sources[size_t(_dome)].radiance;
}

mat4 RasterLights::domeToWorld() const {
    return _dome < 0 ? mat4(1.0f) : mat4(_sources[size_t(_dome)].domeToWorld);
}

bool RasterLights::domeVisible() const {
    return _dome >= 0 && _sources[size_t(_dome)].cameraVisible;
}

GpuLight RasterLights::draw(const Source& s, vec2 u) const {
    GpuLight g = s.fixed;
    vec3 radiance = s.radiance;
    switch (s.kind) {
    case Rect:
    case Disk: {
        vec2 q = u - 0.5f;
        if (s.kind == Disk)
            q = std::sqrt(u.x) * vec2(std::cos(2.0f * pi * u.y), std::sin(2.0f * pi * u.y));
        g.sampled = vec4(s.shape.origin + s.shape.axes * vec3(q, 0.0f), 1.0f);
        g.normal = vec4(s.shape.normal, 1.0f / s.shape.area);
        break;
    }
    case Sphere:
    case Cylinder: {
        vec3 q, n;
        const float phi = 2.0f * pi * u.y;
        if (s.kind == Sphere) {
            const float z = 1.0f - 2.0f * u.x, r = std::sqrt(std::max(0.0f, 1.0f - z * z));
            q = n = vec3(r * std::cos(phi), r * std::sin(phi), z);
        } else {
            n = vec3(0.0f, std::cos(phi), std::sin(phi));
            q = n + vec3(u.x - 0.5f, 0.0f, 0.0f);
        }
        const vec3 wide = glm::transpose(s.shape.inverse) * n;
        const float length = glm::length(wide);
        const float stretched = std::fabs(s.shape.determinant) * length;
        g.sampled = vec4(s.shape.origin + s.shape.axes * q, 1.0f);
        g.normal = vec4(wide / length, 1.0f / ((s.kind == Sphere ? 4.0f : 2.0f) * pi * stretched));
        break;
    }
    case Triangle: break; // see sample()
    case Point: g.sampled = vec4(s.position, 1.0f); break;
    case Distant: {
        const float z = 1.0f - g.cone.z * u.x;
        const float r = std::sqrt(std::max(0.0f, 1.0f - z * z)), phi = 2.0f * pi * u.y;
        const vec3 helper = std::fabs(s.toLight.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 1, 0);
        const vec3 x = glm::normalize(glm::cross(helper, s.toLight));
        const vec3 y = glm::cross(s.toLight, x);
        g.sampled = vec4(x * (r * std::cos(phi)) + y * (r * std::sin(phi)) + s.toLight * z, 0.0f);
        g.normal = vec4(0.0f, 0.0f, 0.0f, s.delta ? 1.0f : 1.0f / g.cone.w);
        break;
    }
    case Dome:
    case MoreDome:
    case OtherDome: {
        vec3 d;
        float pdf = 0.25f / pi;
        if (s.environment) {
            d = s.environment->sample(u, pdf);
            radiance *= s.environment->radiance(d);
        } else {
            const float z = 1.0f - 2.0f * u.x, r = std::sqrt(std::max(0.0f, 1.0f - z * z));
            d = vec3(r * std::cos(2.0f * pi * u.y), r * std::sin(2.0f * pi * u.y), z);
        }
        g.sampled = vec4(s.domeToWorld * d, 0.0f);
        g.normal = vec4(0.0f, 0.0f, 0.0f, pdf);
        if (!(pdf > 0.0f)) radiance = vec3(0.0f), g.normal.w = 1.0f;
        break;
    }
    }
    g.radiance = vec4(radiance, float(s.kind));
    return g;
}

std::vector<GpuLight> RasterLights::sample(uint32_t pass, const RasterEmitters& emitters,
                                           const ShadowBounds& bounds, int mapSize,
                                           std::vector<ShadowView>& shadows) const {
    std::vector<GpuLight> out;
    uint32_t dimension = 100;
    // Of very many lights every pass takes as many as it can, each in its turn.
    const size_t count = _sources.size();
    const size_t taken = std::min<size_t>(count, maxLights);
    const size_t first = count > taken ? size_t(pass) * taken % count : 0;
    const float share = taken > 0 ? float(count) / float(taken) : 1.0f;
    for (size_t k = 0; k < taken; ++k) {
        const size_t i = (first + k) % count;
        const Source& s = _sources[i];
        dimension = 100 + 16 * uint32_t(i);
        const int samples = s.kind == Dome || s.kind == OtherDome ? _domeSamples : 1;
        for (int n = 0; n < samples; ++n) {
            const uint32_t index = samples > 1 ? pass * uint32_t(samples) + uint32_t(n) : pass;
            GpuLight g = draw(s, passNumbers(_seed, index, dimension));
            const float factor = share / float(samples);
            // The first of the dome also stands for what samples of the BSDF find.
            if (n > 0 && s.kind == Dome) g.radiance.w = float(MoreDome);
            g.radiance *= vec4(vec3(factor), 1.0f);
            if (_shadows && s.shadows)
                castShadow(g, passNumbers(_seed, index, dimension + 1).x, bounds, mapSize, shadows);
            out.push_back(g);
        }
    }
    for (uint32_t n = 0; n < uint32_t(emitterSamples) && !emitters.empty(); ++n) {
        const vec2 u = passNumbers(_seed, pass * emitterSamples + n, 17);
        const vec2 turn = passNumbers(_seed, pass * emitterSamples + n, 18);
        float within, chance;
        const RasterEmitter& e = emitters.choose(u.x, within, chance);
        // Uniform over the triangle (Turk 1990).
        const float root = std::sqrt(within);
        GpuLight g;
        g.sampled = vec4(e.corner + e.edge1 * (root * (1.0f - u.y)) + e.edge2 * (root * u.y), 1.0f);
        g.normal = vec4(glm::normalize(glm::cross(e.edge1, e.edge2)), chance / e.area);
        g.radiance = vec4(e.radiance / float(emitterSamples), float(Triangle));
        g.origin = g.shaping = g.focusTint = g.shadowColor = vec4(0.0f);
        g.cone = vec4(0.0f, 0.0f, e.twoSided ? 1.0f : 0.0f, 0.0f);
        for (int i = 0; i < 3; ++i)
            g.axis[i] = g.inverse[i] = vec4(0.0f, 0.0f, 0.0f, i < 2 ? 1.0f : 0.0f);
        g.axis[2].w = float(e.category);
        g.shadow = vec4(-1.0f, 0.0f, 0.0f, 0.0f);
        if (_shadows) castShadow(g, turn.x, bounds, mapSize, shadows);
        out.push_back(g);
    }
    return out;
}

} // namespace patina
