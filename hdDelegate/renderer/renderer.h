// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/settings.h"
#include "materialNetwork/plan/methodPlan.h"

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace patina {

/// Statistics of a render. Times in seconds.
struct RenderProgress {
    double fraction = 0.0;    ///< 0..1 of the expected work
    int samplesDone = 0;      ///< full passes over the image, in samples per pixel
    double samplesMean = 0.0; ///< samples of a pixel, mean over the image
    double noise = -1.0;      ///< relative error by noise so far; below 0: nobody has looked
    double noiseWanted = 0.0; ///< that ends the render; 0: none
    double secondsRendering = 0.0;
    double secondsLeft = 0.0; ///< estimate
    bool converged = false;   ///< all samples taken, tolerance or time limit reached
    bool failed = false;
    std::string error;         ///< one line, when failed
    bool deviceFailed = false; ///< it was the device or its driver: another back end may do it
    bool temporary = false;    ///< what failed may work when it is tried again: memory ran out
    bool mayWait = false;      ///< a listener that is told this may wait until its image is seen
    std::string backend;       ///< what the film's samples were made by: embree, raster
    /// Numbers by name:
    /// - "rays", "paths", "secondsBuild" (of this start), "trianglesStored", "instances", "bytes"
    ///   (of meshes and acceleration structures);
    /// - "textureBytes" in memory; if some textures are read by tiles, also "textureTileBytes",
    ///   "textureTilePeakBytes", "textureTileCapacity" and "textureTilesMade" of those;
    /// - counts since the renderer was made, which show the cost of edits: "surfacesBuilt",
    ///   "surfacesTessellated" (the others were only moved), "groupsBuilt" (acceleration
    ///   structures), "programsBuilt", "lightsBuilt", "primsLookedAt" (visited to see whether they
    ///   have to be built);
    /// - while programs are compiled, "materialsReady" and "materialsWanted", with secondsLeft of
    ///   that, and "materialsDrawn": programs drawn with for the first time, for which software
    ///   OpenGL compiles once more.
    std::map<std::string, double> statistics;
    /// Threads' seconds by path of the material that was hit ("": displayColor; "camera": until a
    /// path hits something), see embree/materialClock.h. Empty unless settings ask for it.
    std::map<std::string, double> materialSeconds;
    std::map<std::string, MethodPlan> plans; ///< of materials in use, by path ("": displayColor);
                                             ///< without choices when there is no tolerance
    std::vector<PlannedMethod>
        sceneChoices; ///< those of the scene as a whole: ScenePlan::choices()
};

/// Told about a film at rest: no thread works on it while the call lasts.
using FilmListener = std::function<void(const Film&, const RenderProgress&)>;

/// Renders a scene into a film, progressively and in the background. All functions return at once
/// unless they say otherwise, and may be called from any thread.
class Renderer {
public:
    virtual ~Renderer() = default; ///< stops first

    /// Starts rendering the scene's newest state, seen by a camera. A running render is stopped
    /// first. Everything that no edit touched since the last start is kept.
    /// @param film is resized to the settings. If it has a `resumeToken`, its samples are kept and
    ///        continued: the host sets the token if scene, camera and settings are those of the
    ///        render that took them.
    virtual void start(std::shared_ptr<Scene> scene, const std::string& camera,
                       const RenderSettings& settings, std::shared_ptr<Film> film) = 0;
    virtual void stop() = 0; ///< blocks until no thread works on the film (milliseconds)
    virtual void pause() = 0;
    virtual void resume() = 0;
    virtual bool isRunning() const = 0;
    virtual void wait() = 0; ///< blocks until converged, failed or stopped
    virtual RenderProgress progress() const = 0;

    /// Hears of new samples on the render thread: after the first pass, then at ends of passes but
    /// not more often than every 30 ms, and always at the end, with `converged` or `failed` set in
    /// what it is given, before progress() says so. A stopped render ends without a call. The
    /// listener must not call the renderer. Set it while nothing runs; empty: nobody listens.
    virtual void setListener(FilmListener listener) = 0;
    /// Whether nobody reads the film but the listener, while it is called: images of interactive
    /// renders may stay on a device then (Film::source()). Set it while nothing runs.
    virtual void letImagesStay(bool) {}
};

/// Makes the path tracer ("embree"); null for any other name. For the others see makeBackend().
std::unique_ptr<Renderer> makeRenderer(const std::string& backend);

} // namespace patina
