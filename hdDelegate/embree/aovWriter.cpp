#include "hdDelegate/embree/aovWriter.h"

#include "hdDelegate/film/denoiser.h"

namespace patina {

namespace {

constexpr char primvarPrefix[] = "primvars:";

} // namespace

void writeAovs(const std::vector<AovSpec>& aovs, const AovTarget& target, const CameraRays& camera,
               const SurfacePoint& point, const Bsdf& bsdf) {
    const ShadingPoint& s = point.shading;
    const Hit& hit = *point.hit;
    const vec3 inCamera = vec3(camera.worldToCamera() * vec4(s.position, 1.0f));
    for (size_t i = 0; i < aovs.size(); ++i) {
        const std::string& name = aovs[i].name;
        if (name == denoisingAlbedoAov || name == denoisingNormalAov) continue; // of whole paths
        float out[4] = {0, 0, 0, 0};
        const auto put3 = [&](const vec3& v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; };
        if (name == "depth")
            out[0] = -inCamera.z;
        else if (name == "cameraDepth")
            out[0] = glm::length(inCamera);
        else if (name == "deviceDepth")
            out[0] = camera.windowDepth(inCamera);
        else if (name == "normal")
            put3(s.normal);
        else if (name == "Neye") {
            const vec3 n = mat3(camera.worldToCamera()) * s.normal;
            put3(n / std::max(1e-30f, glm::length(n)));
        } else if (name == "position")
            put3(s.worldPosition());
        else if (name == "albedo")
            put3(bsdf.albedo());
        else if (name == "primId")
            out[0] = glm::intBitsToFloat(hit.surface->primId);
        else if (name == "instanceId")
            out[0] = glm::intBitsToFloat(hit.instanceId);
        else if (name == "elementId")
            out[0] = glm::intBitsToFloat(hit.surface->element(hit.primitive));
        else if (name.rfind(primvarPrefix, 0) == 0) {
            const int attribute =
                hit.surface->findAttribute(name.substr(sizeof(primvarPrefix) - 1));
            if (attribute >= 0)
                readAttribute(*hit.surface, attribute, hit.primitive, hit.u, hit.v, out);
        }
        target.film.addAov(int(i), target.x, target.y, out, target.distance);
    }
}

} // namespace patina
