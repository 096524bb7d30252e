// SPDX-License-Identifier: Apache-2.0
// engineHost: renders a stage with UsdImagingGLEngine, as usdrecord and usdview do, and measures
// how long images take: any renderer, in the same host, without windows.

#include "testenv/hydra/engine/engine.h"
#include "testenv/hydra/host/clock.h"

#include <pxr/base/js/json.h>
#include <pxr/base/tf/stringUtils.h>
#include <pxr/usd/usd/attribute.h>
#include <pxr/usd/usdGeom/xformable.h>

#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <stdexcept>

using namespace patina;

namespace {

const char* const usage =
    "usage: engineHost STAGE [IMAGE] [options]\n"
    "Renders a stage with UsdImagingGLEngine and prints seconds and peak memory as JSON: \"open\" "
    "the stage,\n"
    "\"first\" image (the renderer's start in it), \"moved\" after each move of the camera, "
    "\"edited\" after each edit;\n"
    "\"processor\" is what each move took of all cores, with the driver's share;\n"
    "\"seen\" are the seconds until a buffer held the first of the images that led to each, "
    "which may be coarse;\n"
    "\"statistics\" are numbers of the renderer's own, \"device\" is what OpenGL draws on.\n"
    "  --renderer ID             plugin (HdPatinaRendererPlugin)\n"
    "  --camera PATH             camera prim\n"
    "  --size WxH                pixels (64x64)\n"
    "  --aov NAME                what is drawn (color)\n"
    "  --context NAME            egl, without windows, or glx, of an X server (egl)\n"
    "  --image NAME              resource: the texture that a host shows, where there is one, or "
    "mapped (resource)\n"
    "  --set KEY=VALUE           render setting, repeatable; a number, true or false, or text\n"
    "  --edit PATH.INPUT=NUMBERS value of an input, of which each edit takes another share\n"
    "  --repeats N               moves, and edits (0)\n"
    "  --select PATH             draws the last image once more, with a prim selected\n"
    "  --times N                 so often (1)\n";

double numberOf(const std::string& text) {
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0')
        throw std::runtime_error("'" + text + "' is no number");
    return number;
}

struct CommandLine {
    std::string stage, image, edit, selected;
    EngineOptions engine;
    int repeats = 0, times = 1;
};

CommandLine parse(int argc, char** argv) {
    CommandLine line;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (!TfStringStartsWith(word, "--")) {
            (line.stage.empty() ? line.stage : line.image) = word;
            continue;
        }
        if (++i == argc) throw std::runtime_error(word + " needs a value\n" + usage);
        const std::string value = argv[i];
        if (word == "--renderer")
            line.engine.renderer = value;
        else if (word == "--camera")
            line.engine.camera = SdfPath(value);
        else if (word == "--aov")
            line.engine.aov = value;
        else if (word == "--context" && (value == "egl" || value == "glx"))
            line.engine.glx = value == "glx";
        else if (word == "--image" && (value == "resource" || value == "mapped"))
            line.engine.mapped = value == "mapped";
        else if (word == "--set")
            line.engine.settings.push_back(value);
        else if (word == "--edit")
            line.edit = value;
        else if (word == "--repeats")
            line.repeats = int(numberOf(value));
        else if (word == "--select")
            line.selected = value;
        else if (word == "--times")
            line.times = int(numberOf(value));
        else if (word != "--size" ||
                 std::sscanf(value.c_str(), "%dx%d", &line.engine.width, &line.engine.height) != 2)
            throw std::runtime_error("engineHost does not understand " + word + " " + value + "\n" +
                                     usage);
    }
    if (line.stage.empty()) throw std::runtime_error(usage);
    return line;
}

/// One input of a prim, and the numbers that its edits begin with.
class InputEdit {
public:
    InputEdit(const UsdStageRefPtr& stage, const std::string& text) {
        const size_t equal = text.find('=');
        const size_t dot = text.rfind('.', equal);
        if (equal == std::string::npos || dot == std::string::npos)
            throw std::runtime_error("--edit needs PATH.INPUT=NUMBERS, not " + text);
        const UsdPrim prim = stage->GetPrimAtPath(SdfPath(text.substr(0, dot)));
        if (prim)
            _attribute =
                prim.GetAttribute(TfToken("inputs:" + text.substr(dot + 1, equal - dot - 1)));
        if (!_attribute) throw std::runtime_error("there is no input " + text.substr(0, equal));
        for (const std::string& number : TfStringTokenize(text.substr(equal + 1), ","))
            _numbers.push_back(numberOf(number));
    }

    void apply(double share) {
        VtValue value;
        if (_numbers.size() == 1)
            value = float(_numbers[0] * share);
        else if (_numbers.size() == 3)
            value = GfVec3f(float(_numbers[0] * share), float(_numbers[1] * share),
                            float(_numbers[2] * share));
        else
            throw std::runtime_error("an edit has one number or three");
        if (!_attribute.Set(value))
            throw std::runtime_error(_attribute.GetPath().GetString() + " takes no such value");
    }

private:
    UsdAttribute _attribute;
    std::vector<double> _numbers;
};

/// Of all threads of the process so far.
double processorSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

void run(const CommandLine& line) {
    Clock clock;
    JsObject seconds;
    const UsdStageRefPtr stage = UsdStage::Open(line.stage);
    if (!stage) throw std::runtime_error(line.stage + " cannot be opened");
    const UsdGeomXformable camera(stage->GetPrimAtPath(line.engine.camera));
    if (!camera) throw std::runtime_error("there is no camera " + line.engine.camera.GetString());
    stage->SetEditTarget(stage->GetSessionLayer());
    const UsdGeomXformOp move =
        camera.AddTranslateOp(UsdGeomXformOp::PrecisionDouble, TfToken("move"));
    move.Set(GfVec3d(0.0));
    seconds["open"] = JsValue(clock.lap());

    Engine engine(stage, line.engine);
    const double firstSeen = engine.render();
    seconds["first"] = JsValue(clock.lap());
    JsArray moved, edited, movedSeen, editedSeen, processor;
    std::unique_ptr<InputEdit> edit;
    if (!line.edit.empty()) edit = std::make_unique<InputEdit>(stage, line.edit);
    for (int i = 1; i <= line.repeats; ++i) {
        clock.lap();
        const double before = processorSeconds();
        move.Set(GfVec3d(0.01 * i, 0.0, 0.0));
        movedSeen.push_back(JsValue(engine.render()));
        moved.push_back(JsValue(clock.lap()));
        processor.push_back(JsValue(processorSeconds() - before));
        if (!edit) continue;
        edit->apply(0.5 + 0.5 * i / line.repeats);
        editedSeen.push_back(JsValue(engine.render()));
        edited.push_back(JsValue(clock.lap()));
    }
    if (!line.selected.empty()) engine.select(SdfPath(line.selected), line.times);
    if (!line.image.empty()) engine.write(line.image);
    seconds["moved"] = JsValue(moved);
    seconds["edited"] = JsValue(edited);
    const JsObject seen = {{"first", JsValue(firstSeen)},
                           {"moved", JsValue(movedSeen)},
                           {"edited", JsValue(editedSeen)}};
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    JsObject statistics; // of the last image
    for (const auto& [name, value] : engine.statistics())
        if (value.IsHolding<double>()) statistics[name] = JsValue(value.UncheckedGet<double>());
    const JsObject report = {{"seconds", JsValue(seconds)},
                             {"seen", JsValue(seen)},
                             {"processor", JsValue(processor)},
                             {"statistics", JsValue(statistics)},
                             {"device", JsValue(engine.device())},
                             {"peakMemory", JsValue(double(used.ru_maxrss) * 1024.0)}};
    std::cout << JsWriteToString(JsValue(report)) << std::endl;
}

} // namespace

int main(int argc, char** argv) {
    try {
        run(parse(argc, argv));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "engineHost: %s\n", error.what());
        return 1;
    }
}
