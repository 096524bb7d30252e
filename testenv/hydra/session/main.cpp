// SPDX-License-Identifier: Apache-2.0
// viewportSession: edits a stage as users of a viewport do, comes back to where it began again and
// again, and prints how much memory is in use there.

#include "testenv/hydra/edits/baseStage.h"
#include "testenv/hydra/host/clock.h"
#include "testenv/hydra/host/editScript.h"
#include "testenv/hydra/session/memory.h"
#include "testenv/hydra/session/viewportEdits.h"

#include <pxr/base/tf/stringUtils.h>
#include <pxr/usd/usd/errors.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <list>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace patina;

namespace {

const char* const usage =
    "usage: viewportSession FOLDER [options]\n"
    "Edits a stage in Hydra while it renders. A cycle makes every kind of edit once, in random "
    "order,\n"
    "and takes all of them back. After each, prints a line of JSON: seconds since the start, edits "
    "so\n"
    "far, bytes on the heap and resident bytes. FOLDER is for textures.\n"
    "  --seconds N      ends after the cycle in which they are over (60)\n"
    "  --cycles N       ends after so many cycles, if that is sooner\n"
    "  --seed N         another order and other values (1)\n"
    "  --only A,B       these kinds of edits alone\n"
    "  --forget BYTES   leaves so many behind with each edit, to see that it shows\n"
    "  --sceneIndex     UsdImaging's scene indices instead of UsdImagingDelegate\n"
    "  --set KEY=VALUE  render setting, repeatable\n";

struct CommandLine {
    std::string folder;
    double seconds = 60.0;
    int cycles = 1 << 30;
    uint32_t seed = 1;
    std::set<std::string> only;
    size_t forget = 0; ///< bytes
    HostOptions host;
};

CommandLine parse(int argc, char** argv) {
    CommandLine line;
    line.host.width = 64;
    line.host.height = 48;
    line.host.camera = SdfPath("/World/cameras/main");
    // All that edits change.
    for (const char* setting :
         {"samples=4", "maxDepth=4", "enableShadows=true", "enableSceneMaterials=true"}) {
        const std::string text = setting;
        const size_t equal = text.find('=');
        line.host.settings[TfToken(text.substr(0, equal))] = settingOf(text.substr(equal + 1));
    }
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--sceneIndex") {
            line.host.sceneIndex = true;
            continue;
        }
        if (!TfStringStartsWith(word, "--")) {
            line.folder = word;
            continue;
        }
        if (++i == argc) throw std::runtime_error(word + " needs a value\n" + usage);
        const std::string value = argv[i];
        const size_t equal = value.find('=');
        if (word == "--seconds")
            line.seconds = std::stod(value);
        else if (word == "--cycles")
            line.cycles = std::stoi(value);
        else if (word == "--seed")
            line.seed = uint32_t(std::stoul(value));
        else if (word == "--forget")
            line.forget = size_t(std::stoul(value));
        else if (word == "--only")
            for (const std::string& name : TfStringTokenize(value, ","))
                line.only.insert(name);
        else if (word == "--set" && equal != std::string::npos)
            line.host.settings[TfToken(value.substr(0, equal))] =
                settingOf(value.substr(equal + 1));
        else
            throw std::runtime_error("viewportSession does not understand " + word + " " + value +
                                     "\n" + usage);
    }
    if (line.folder.empty()) throw std::runtime_error(usage);
    return line;
}

class Session {
public:
    explicit Session(const CommandLine& line)
        : _line(line), _stage(makeBaseStage()), _random(line.seed) {
        writeTextures(line.folder);
        for (const Edit& edit : sessionEdits())
            if (line.only.empty() || line.only.count(edit.name)) _edits.push_back(edit);
        if (_edits.empty()) throw std::runtime_error("there is no such edit");
        _stage->SetEditTarget(_stage->GetSessionLayer());
        _host.emplace(_stage, line.host);
    }

    /// Every edit once, and back. @throws std::runtime_error when the image does not converge
    void cycle() {
        for (size_t i = _edits.size() - 1; i > 0; --i)
            std::swap(_edits[i], _edits[size_t(_random.index(i + 1))]);
        for (const Edit& edit : _edits) {
            guarded([&] {
                edit.apply(_stage, *_host, _random);
                look();
            });
            if (_line.forget > 0) _forgotten.emplace_back(_line.forget, '\1');
            ++_count;
        }
        guarded([&] { startOver(_stage, *_host, _line.host); });
        if (!_host->render()) throw std::runtime_error("the image does not converge");
    }

    int count() const { return _count; }
    int lost() const { return _lost; }

private:
    /// Half of the edits follow at once, as in a drag; others wait for passes, or for all of them.
    void look() {
        const float patience = _random.real(0.0f, 1.0f);
        _host->execute();
        if (patience < 0.5f) return;
        if (patience > 0.8f) {
            if (!_host->render()) throw std::runtime_error("the image does not converge");
            return;
        }
        for (int i = 1 + _random.index(6); i > 0; --i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            _host->execute();
        }
    }

    /// A stage that OpenUSD follows no more is opened in a new host, as users do.
    template <class Step> void guarded(const Step& step) {
        try {
            step();
        } catch (const UsdExpiredPrimAccessError&) {
            if (!_host->isLost()) return; // an edit before took the prim away
            ++_lost;
            _host.reset();
            _stage->GetSessionLayer()->Clear();
            _host.emplace(_stage, _line.host);
        }
    }

    const CommandLine& _line;
    UsdStageRefPtr _stage;
    Random _random;
    std::vector<Edit> _edits;
    std::optional<Host> _host;
    std::list<std::vector<char>> _forgotten;
    int _count = 0, _lost = 0;
};

void run(const CommandLine& line) {
    Session session(line);
    Clock clock;
    double seconds = 0.0;
    for (int i = 0; i < line.cycles && seconds < line.seconds; ++i) {
        session.cycle();
        seconds += clock.lap();
        const MemoryUse use = memoryUse();
        std::printf("{\"seconds\": %.3f, \"edits\": %d, \"lost\": %d, \"heap\": %.0f, "
                    "\"resident\": %.0f}\n",
                    seconds, session.count(), session.lost(), use.heap, use.resident);
        std::fflush(stdout);
    }
}

} // namespace

int main(int argc, char** argv) {
    try {
        run(parse(argc, argv));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "viewportSession: %s\n", error.what());
        return 1;
    }
}
