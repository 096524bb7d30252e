// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/host/editScript.h"

#include <pxr/base/tf/stringUtils.h>
#include <pxr/usd/sdf/layer.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace patina {

namespace {

struct Step {
    Host& host;
    const UsdStageRefPtr& stage;
    std::istringstream& words;

    template <class T> T next() const {
        T value{};
        if (!(words >> value)) throw std::runtime_error("a value is missing");
        return value;
    }
};

void replaceSession(const Step& step) {
    const std::string file = step.next<std::string>();
    const SdfLayerRefPtr layer = SdfLayer::FindOrOpen(file);
    if (!layer) throw std::runtime_error(file + " cannot be opened");
    step.stage->GetSessionLayer()->TransferContent(layer);
}

void bindAovs(const Step& step) {
    std::vector<HostAov> aovs;
    for (const std::string& name : TfStringTokenize(step.next<std::string>(), ","))
        aovs.push_back({name, HdFormatInvalid});
    step.host.setAovs(aovs);
}

void repaint(const Step& step) {
    for (int left = step.next<int>(); left > 0; --left)
        step.host.execute();
}

void writeFrames(const Step& step) {
    using Clock = std::chrono::steady_clock;
    const std::string prefix = step.next<std::string>();
    const auto end = Clock::now() + std::chrono::minutes(10);
    std::vector<float> before;
    int count = 0;
    for (bool whole = false; !whole;) {
        if (Clock::now() > end) throw std::runtime_error("the image does not converge");
        step.host.execute();
        whole = step.host.isConverged();
        HostImage image = step.host.read("color");
        if (image.values != before)
            writeExr(prefix + TfStringPrintf("%04d.exr", count++), step.host.readAll());
        before.swap(image.values);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

const std::map<std::string, std::function<void(const Step&)>>& steps() {
    static const std::map<std::string, std::function<void(const Step&)>> table = {
        {"session", replaceSession},
        {"size",
         [](const Step& s) {
             const int width = s.next<int>();
             s.host.setSize(width, s.next<int>());
         }},
        {"camera", [](const Step& s) { s.host.setCamera(SdfPath(s.next<std::string>())); }},
        {"frame", [](const Step& s) { s.host.setTime(s.next<double>()); }},
        {"refine", [](const Step& s) { s.host.setRefineLevel(s.next<int>()); }},
        {"purposes",
         [](const Step& s) { s.host.setPurposes(TfStringTokenize(s.next<std::string>(), ",")); }},
        {"aovs", bindAovs},
        {"set",
         [](const Step& s) {
             const std::string key = s.next<std::string>();
             s.host.setSetting(key, settingOf(s.next<std::string>()));
         }},
        {"pause", [](const Step& s) { s.host.delegate()->Pause(); }},
        {"resume", [](const Step& s) { s.host.delegate()->Resume(); }},
        {"stop", [](const Step& s) { s.host.delegate()->Stop(); }},
        {"restart", [](const Step& s) { s.host.delegate()->Restart(); }},
        {"execute", repaint},
        {"render",
         [](const Step& s) {
             if (!s.host.render()) throw std::runtime_error("the image does not converge");
         }},
        {"frames", writeFrames},
        {"write", [](const Step& s) { writeExr(s.next<std::string>(), s.host.readAll()); }},
    };
    return table;
}

} // namespace

void runEditScript(Host& host, const UsdStageRefPtr& stage, const std::string& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(file + " cannot be read");
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        std::istringstream words(line.substr(0, line.find('#')));
        std::string name;
        if (!(words >> name)) continue;
        const auto found = steps().find(name);
        try {
            if (found == steps().end()) throw std::runtime_error("there is no edit " + name);
            found->second({host, stage, words});
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(file + ":" + std::to_string(number) + ": " + error.what());
        }
    }
}

VtValue settingOf(const std::string& text) {
    if (text == "true") return VtValue(true);
    if (text == "false") return VtValue(false);
    try {
        size_t used = 0;
        const int whole = std::stoi(text, &used);
        if (used == text.size()) return VtValue(whole);
        const float real = std::stof(text, &used);
        if (used == text.size()) return VtValue(real);
    } catch (const std::logic_error&) { // no number
    }
    return VtValue(text);
}

} // namespace patina
