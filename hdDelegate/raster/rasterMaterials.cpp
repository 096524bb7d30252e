#include "hdDelegate/raster/rasterMaterials.h"

#include "hdDelegate/raster/deviceError.h"
#include "hdDelegate/raster/glFaults.h"
#include "materialNetwork/material.h"

#include <algorithm>

namespace patina {

namespace {

GLint wrapOf(TextureWrap wrap) {
    switch (wrap) {
    case TextureWrap::Black: return GL_CLAMP_TO_BORDER;
    case TextureWrap::Clamp: return GL_CLAMP_TO_EDGE;
    case TextureWrap::Mirror: return GL_MIRRORED_REPEAT;
    case TextureWrap::Repeat: break;
    }
    return GL_REPEAT;
}

} // namespace

RasterMaterials::RasterMaterials(Diagnostics& diagnostics)
    : _diagnostics(diagnostics), _textures(diagnostics) {}

void RasterMaterials::update(const SceneState& state, const RenderSettings& settings) {
    for (auto it = _materials.begin(); it != _materials.end();) {
        const auto found = state.materials.find(it->first);
        const auto now = found != state.materials.end() && settings.enableSceneMaterials
                             ? found->second
                             : nullptr;
        it = it->second.prim == now && it->second.methods == settings.methods
                 ? std::next(it)
                 : _materials.erase(it);
    }
}

const RasterMaterial& RasterMaterials::get(const std::string& path, const std::string& user,
                                           const SceneState& state,
                                           const RenderSettings& settings) {
    std::shared_ptr<const MaterialPrim> prim;
    if (!path.empty() && settings.enableSceneMaterials) {
        const auto found = state.materials.find(path);
        if (found != state.materials.end())
            prim = found->second;
        else
            _diagnostics.warn(user, "material:binding",
                              "material " + path + " does not exist; displayColor is shown");
    }
    const std::string key = prim ? path : std::string();
    const auto known = _materials.find(key);
    if (known != _materials.end()) return known->second.material;
    Cached& cached = _materials[key];
    cached.prim = prim;
    cached.methods = settings.methods;
    RasterMaterial& m = cached.material;
    m.program =
        compileMaterial(prim && !prim->network.empty() ? prim->network : makeDisplayColorNetwork(),
                        _textures, _diagnostics, settings.methods);
    m.glsl = makeGlslMaterial(*m.program);
    for (const std::string& line : m.glsl.leftOut)
        _diagnostics.warn(key, "", line);
    m.programs = build(m.glsl, int(m.program->primvars().size()), key);
    if (!m.programs && key.empty())
        throw DeviceError("the driver does not take the shader of displayColor");
    if (!m.programs) {
        const RasterMaterial& shown = get(std::string(), user, state, settings);
        m.program = shown.program;
        m.glsl = shown.glsl;
        m.programs = shown.programs;
    }
    m.parameters = GlBuffer(m.glsl.parameters);
    for (const int handle : m.glsl.textures)
        m.textures.push_back(texture(handle));
    return m;
}

std::shared_ptr<const RasterPrograms> RasterMaterials::build(const GlslMaterial& glsl, int primvars,
                                                             const std::string& user) {
    const bool faulty = !user.empty() && glFault("material") == user;
    const std::string head = "#define PRIMVARS " + std::to_string(primvars) + "\n" +
                             (glsl.presence ? "#define PRESENCE\n" : "") +
                             "#define MATERIAL_GLOWS " + (glsl.emission ? "true\n" : "false\n");
    auto& shared = _programs[head + glsl.text + (faulty ? "faulty" : "")];
    if (shared) return shared;
    const GlStage vertex{GL_VERTEX_SHADER, "surface",
                         head + "#include \"shaders/raster/surface.vert.glsl\"\n"};
    const std::string surface = head +
                                "#include \"shaders/raster/material.glsl\"\n"
                                "#include \"shaders/raster/pass.glsl\"\n" +
                                glsl.text + "#include \"shaders/raster/surface.frag.glsl\"\n" +
                                (faulty ? "#error asked for by PATINA_GL_FAULT\n" : "");
    auto programs = std::make_shared<RasterPrograms>();
    std::string error;
    programs->color =
        GlProgram::make({vertex,
                         {GL_FRAGMENT_SHADER, "material",
                          surface + "#include \"shaders/raster/lighting.frag.glsl\"\n"}},
                        error);
    if (programs->color)
        programs->aovs =
            GlProgram::make({vertex,
                             {GL_FRAGMENT_SHADER, "material",
                              surface + "#include \"shaders/raster/aovs.frag.glsl\"\n"}},
                            error);
    if (programs->aovs && glsl.presence)
        programs->shadow = GlProgram::make(
            {{GL_VERTEX_SHADER, "shadow",
              "#define SHADOW\n" + head + "#include \"shaders/raster/surface.vert.glsl\"\n"},
             {GL_FRAGMENT_SHADER, "material",
              surface + "#include \"shaders/raster/presence.frag.glsl\"\n"}},
            error);
    ++_built;
    if (!programs->aovs || (glsl.presence && !programs->shadow)) {
        _diagnostics.warn(user, "",
                          "the driver does not take the material's shader; displayColor is "
                          "shown: " +
                              oneLine(error));
        return nullptr;
    }
    return shared = programs;
}

/// The texels with the driver's own sampler; larger textures start at a smaller level.
std::shared_ptr<const GlTexture> RasterMaterials::texture(int handle) {
    auto& cached = _uploaded[handle];
    if (cached) return cached;
    auto texture = std::make_shared<GlTexture>();
    const std::shared_ptr<const ImageTexture> image = _textures.image(handle);
    const vec4 magenta(1.0f, 0.0f, 1.0f, 1.0f);
    if (!image) {
        *texture = GlTexture(GL_TEXTURE_2D, GL_RGBA16F, 1, 1);
        gl.TextureSubImage2D(texture->id(), 0, 0, 0, 1, 1, GL_RGBA, GL_FLOAT, &magenta);
        return cached = texture;
    }
    const int largest = largestTexture();
    const auto& levels = image->levels();
    size_t first = 0;
    while (first + 1 < levels.size() &&
           std::max(levels[first].width, levels[first].height) > largest)
        ++first;
    const TextureRequest& request = _textures.request(handle);
    const auto size = [&](size_t level) {
        return std::to_string(levels[level].width) + " x " + std::to_string(levels[level].height);
    };
    if (first > 0)
        _diagnostics.warn(request.prim, request.input,
                          "'" + request.file + "' has " + size(0) + " pixels, the driver takes " +
                              std::to_string(largest) + " along a side; it is shown with " +
                              size(first));
    *texture = GlTexture(GL_TEXTURE_2D, GL_RGBA16F, levels[first].width, levels[first].height, 1,
                         int(levels.size() - first));
    std::vector<vec4> texels;
    for (size_t l = first; l < levels.size(); ++l) {
        const int w = levels[l].width, h = levels[l].height;
        texels.resize(size_t(w) * size_t(h));
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                texels[size_t(h - 1 - y) * size_t(w) + size_t(x)] = image->texel(int(l), x, y);
        gl.TextureSubImage2D(texture->id(), GLint(l - first), 0, 0, w, h, GL_RGBA, GL_FLOAT,
                             texels.data());
    }
    texture->parameter(GL_TEXTURE_MIN_FILTER,
                       request.nearest ? GL_NEAREST : GL_LINEAR_MIPMAP_LINEAR);
    texture->parameter(GL_TEXTURE_MAG_FILTER, request.nearest ? GL_NEAREST : GL_LINEAR);
    texture->parameter(GL_TEXTURE_WRAP_S, wrapOf(request.wrapS));
    texture->parameter(GL_TEXTURE_WRAP_T, wrapOf(request.wrapT));
    return cached = texture;
}

} // namespace patina
