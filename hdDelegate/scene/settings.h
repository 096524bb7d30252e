#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace patina {

/// How to render. Names and defaults are those that every host shows.
struct RenderSettings {
    int width = 960, height = 540; ///< pixels
    int dataWindow[4] = {0, 0, -1,
                         -1}; ///< crop: xmin, ymin, xmax, ymax inclusive; xmax < xmin means all
    double pixelAspectRatio = 1.0;
    std::string aspectRatioConformPolicy = "adjustApertureHeight"; ///< UsdRenderSettings' names

    int samples = 64;    ///< per pixel, the most that are taken
    int minSamples = 16; ///< adaptive sampling never stops below
    /// Mean relative luminance error of the image. Above 0: the fastest methods whose predicted
    /// errors fit, and sampling that stops where the noise does (ScenePlan). 0: the truth at every
    /// choice point, and all samples. Negative: default methods and all samples.
    double tolerance = -1.0;
    double seconds = 0.0; ///< time limit; 0: none
    int threads = 0;      ///< 0: all
    uint32_t seed = 0;

    int maxDepth = 16; ///< path vertices after the camera; negative: as many as the tolerance asks
                       ///< for (ScenePlan::depth), 16 without one
    int maxScatterings = 1024;  ///< inside media, per path; not counted in maxDepth
    int lightSamples = 2;       ///< where a path from the camera meets a surface; one further on
    int rouletteDepth = 4;      ///< Russian roulette starts after so many bounces
    float indirectClamp = 0.0f; ///< largest luminance of one indirect sample; 0: off (unbiased)
    float filterRadius = 1.0f;  ///< pixels; Gaussian pixel filter, 0.5 means a box

    bool enableSceneLights = true;
    bool enableSceneMaterials = true;
    bool enableShadows = true;
    bool enableMotionBlur = true;
    bool enableDepthOfField = true;
    bool domeLightCameraVisibility = true;
    std::string cullStyle = "nothing"; ///< for camera rays, Hydra's names: nothing, back, front,
                                       ///< backUnlessDoubleSided, frontUnlessDoubleSided
    float edgeLength = -1.0f; ///< pixels; subdivision refines until edges are this short; negative:
                              ///< as the tolerance allows (SubdivisionPlan), 4 without one

    bool interactive = false; ///< quick starts before speed: acceleration structures that are
                              ///< cheap to change
    std::vector<std::string> renderTags;   ///< only geometry with one of these is drawn; empty: all
    std::vector<std::string> rootPaths;    ///< only geometry at or below one of these; empty: all
    std::vector<std::string> excludePaths; ///< no geometry at or below one of these

    std::string integrator = "path";  ///< path, ambientOcclusion
    int ambientOcclusionSamples = 16; ///< rays per camera hit, with ambientOcclusion

    int environmentSamples = -1; ///< of domes per pixel and pass in the rasterizer, 4 to 1024,
                                 ///< where its method `domeLight` filters them; negative: as the
                                 ///< tolerance asks, 16 without one

    std::vector<std::string> aovs; ///< besides color and alpha: names of standardAov()

    std::string checkpointFile; ///< the renderer saves the film here now and then; empty: never
    double checkpointSeconds = 60.0;

    std::map<std::string, std::string> methods; ///< choice point -> method, forced by the user
};

} // namespace patina
