// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/imageFile.h"
#include "hdDelegate/hydra/imageForm.h"
#include "hdDelegate/hydra/settings.h"
#include "hdDelegate/renderer/hostDevice.h"
#include "hdDelegate/renderer/renderer.h"

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace patina {

/// Finished pixels of a film at one moment.
struct HdPatinaFrame {
    std::vector<HdPatinaPixels> images; ///< in the forms of start()
    bool last = false;                  ///< nothing better will come: converged or failed
    std::string error;                  ///< of a render that failed
    Metadata mattes;                    ///< of the last one: of Cryptomatte, as files have it
};

/// One renderer with its film, on behalf of one render pass; a change of the back end replaces the
/// renderer and tries again what could not be started. The renderer hands over a frame
/// whenever its film is at rest; hosts take it from there on a thread of their own.
class HdPatinaSession {
public:
    explicit HdPatinaSession(std::shared_ptr<Scene> scene);
    ~HdPatinaSession();

    /// Starts over. Frames of earlier renders are forgotten.
    /// @param forms that frames shall hold the film in
    /// @param device of the host, where images may stay on it
    void start(const std::string& camera, const HdPatinaSettings& settings,
               const std::vector<HdPatinaImageForm>& forms,
               const std::shared_ptr<HostDevice>& device = nullptr);
    /// The newest frame that was not taken yet, or null.
    std::shared_ptr<HdPatinaFrame> take();
    /// Lets the next frame use the memory of an image.
    void giveBack(HdPatinaPixels&& image);

    void stop(); ///< blocks until no thread renders
    /// Stops, and lets go of the host's device: its display may be closed soon.
    void leaveDevice();
    void restart();
    void pause();
    void resume();
    bool isRunning() const;
    RenderProgress progress() const;
    /// Called when a host's buffers have been given an image.
    void countShown(bool onDevice) {
        ++_shown;
        if (onDevice) ++_shownOnDevice;
    }
    int imagesShown() const { return _shown; } ///< since start()
    int imagesOnDevice() const { return _shownOnDevice; }
    /// The names of the ids in the last frame that was taken.
    Metadata mattes() const;
    const std::shared_ptr<Film>& film() const { return _film; }

private:
    std::shared_ptr<Renderer> renderer() const;
    bool denoiseCopy(const Film& film, Film& clean);
    void present(const Film& film, const RenderProgress& progress, uint64_t serial);

    std::shared_ptr<Scene> _scene;
    std::shared_ptr<Film> _film;
    std::shared_ptr<Renderer> _renderer; ///< null until something is rendered
    std::string _backend;                ///< of the renderer
    std::shared_ptr<HostDevice> _device; ///< that it was made for
    std::string _camera;
    HdPatinaSettings _settings;
    std::vector<HdPatinaImageForm> _forms;

    mutable std::mutex _mutex;
    std::condition_variable _taken;
    uint64_t _serial = 0; ///< frames of older renders are dropped
    std::shared_ptr<HdPatinaFrame> _frame;
    std::vector<HdPatinaPixels> _spare; ///< images whose memory is used again
    std::atomic<int> _shown{0}, _shownOnDevice{0};
    Metadata _mattes;
    bool _paused = false, _stopping = false;
};

} // namespace patina
