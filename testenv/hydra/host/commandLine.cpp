// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/host/commandLine.h"

#include "testenv/hydra/host/editScript.h"

#include <pxr/base/tf/stringUtils.h>

#include <functional>
#include <map>
#include <stdexcept>
#include <tuple>

namespace patina {

const char* const usage =
    "usage: hydraHost STAGE [IMAGE.exr] [options]\n"
    "Renders a stage through Hydra without windows or graphics APIs.\n"
    "  --renderer ID        plugin (HdPatinaRendererPlugin)\n"
    "  --sceneIndex         UsdImaging's scene indices instead of UsdImagingDelegate\n"
    "  --camera PATH        camera prim\n"
    "  --size WxH           pixels (64x64)\n"
    "  --frame CODE         time code (default values)\n"
    "  --refine LEVEL       level of refinement, 0 to 8\n"
    "  --purposes A,B       drawn purposes (default,render)\n"
    "  --aov NAME[=FORMAT]  output, repeatable (color); formats like float32vec4, unorm8vec4\n"
    "  --set KEY=VALUE      render setting, repeatable\n"
    "  --dump FILE          the delegate's scene as text\n"
    "  --json FILE          times, statistics and picks ('-': standard output)\n"
    "  --pick X,Y           decodes the ids of a pixel, repeatable\n"
    "  --pickAll            decodes all ids that are seen\n"
    "  --edits FILE         edits while rendering: one a line, see editScript.h\n"
    "  --repeats N          moves the camera N times and makes the image again\n"
    "  --limit SECONDS      gives up then (600)\n"
    "  --serve              alone: renders what standard input asks for, see main.cpp\n";

namespace {

std::pair<int, int> twoNumbers(const std::string& text, char between) {
    const size_t at = text.find(between);
    if (at == std::string::npos) throw std::runtime_error("'" + text + "' is not two numbers");
    return {std::stoi(text.substr(0, at)), std::stoi(text.substr(at + 1))};
}

std::pair<std::string, std::string> split(const std::string& text) {
    const size_t at = text.find('=');
    if (at == std::string::npos) return {text, std::string()};
    return {text.substr(0, at), text.substr(at + 1)};
}

using Setter = std::function<void(CommandLine&, const std::string&)>;

const std::map<std::string, Setter>& valued() {
    static const std::map<std::string, Setter> table = {
        {"--renderer", [](CommandLine& c, const std::string& v) { c.host.renderer = v; }},
        {"--camera", [](CommandLine& c, const std::string& v) { c.host.camera = SdfPath(v); }},
        {"--size",
         [](CommandLine& c, const std::string& v) {
             std::tie(c.host.width, c.host.height) = twoNumbers(v, 'x');
         }},
        {"--frame", [](CommandLine& c, const std::string& v) { c.host.time = std::stod(v); }},
        {"--refine",
         [](CommandLine& c, const std::string& v) { c.host.refineLevel = std::stoi(v); }},
        {"--purposes",
         [](CommandLine& c, const std::string& v) { c.host.purposes = TfStringTokenize(v, ","); }},
        {"--set",
         [](CommandLine& c, const std::string& v) {
             const auto [key, value] = split(v);
             c.host.settings[TfToken(key)] = settingOf(value);
         }},
        {"--dump", [](CommandLine& c, const std::string& v) { c.dump = v; }},
        {"--json", [](CommandLine& c, const std::string& v) { c.json = v; }},
        {"--pick",
         [](CommandLine& c, const std::string& v) { c.picks.push_back(twoNumbers(v, ',')); }},
        {"--edits", [](CommandLine& c, const std::string& v) { c.edits = v; }},
        {"--repeats", [](CommandLine& c, const std::string& v) { c.repeats = std::stoi(v); }},
        {"--limit", [](CommandLine& c, const std::string& v) { c.limit = std::stod(v); }},
    };
    return table;
}

} // namespace

CommandLine parseCommandLine(const std::vector<std::string>& words) {
    CommandLine line;
    std::vector<HostAov> aovs;
    std::vector<std::string> files;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& flag = words[i];
        const auto found = valued().find(flag);
        if (flag == "--help") {
            line.help = true;
        } else if (flag == "--sceneIndex") {
            line.host.sceneIndex = true;
        } else if (flag == "--pickAll") {
            line.pickAll = true;
        } else if (flag == "--aov" || found != valued().end()) {
            if (++i == words.size()) throw std::runtime_error(flag + " needs a value");
            const std::string& value = words[i];
            if (flag == "--aov") {
                const auto [name, format] = split(value);
                aovs.push_back({name, format.empty() ? HdFormatInvalid : formatOf(format)});
                continue;
            }
            try {
                found->second(line, value);
            } catch (const std::logic_error&) { // of the standard library's number parsers
                throw std::runtime_error(flag + ": '" + value + "' is no number");
            }
        } else if (TfStringStartsWith(flag, "--")) {
            throw std::runtime_error("there is no option " + flag);
        } else {
            files.push_back(flag);
        }
    }
    if (!aovs.empty()) line.host.aovs = aovs;
    if (files.size() > 2 || (files.empty() && !line.help))
        throw std::runtime_error("a stage and at most one image are needed");
    if (!files.empty()) line.stage = files[0];
    if (files.size() == 2) line.image = files[1];
    return line;
}

} // namespace patina
