// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/commands.h"

#include "hdDelegate/film/atomicFile.h"
#include "hdDelegate/scene/sceneDump.h"

#include <pxr/base/tf/diagnostic.h>

#include <fstream>
#include <stdexcept>

namespace patina {

namespace {

const char* const dumpSceneName = "patina:dumpScene";

std::string textArgument(const HdCommandArgs& args, const char* name) {
    const auto found = args.find(name);
    if (found == args.end() || !found->second.IsHolding<std::string>()) return std::string();
    return found->second.UncheckedGet<std::string>();
}

} // namespace

HdCommandDescriptors commandDescriptors() {
    return {HdCommandDescriptor(TfToken(dumpSceneName),
                                "Writes the scene as text, as the tests compare it",
                                {HdCommandArgDescriptor(TfToken("file"), VtValue(std::string()))})};
}

bool invokeCommand(HdPatinaDelegateState& state, const TfToken& command,
                   const HdCommandArgs& args) {
    if (command != dumpSceneName) {
        TF_WARN("there is no command %s", command.GetText());
        return false;
    }
    const std::string file = textArgument(args, "file");
    state.param.commit();
    try {
        AtomicFile target(file);
        std::ofstream out(target.temporaryPath());
        out << dumpScene(*state.param.scene()->snapshot());
        out.close();
        if (!out) throw std::runtime_error("cannot write '" + file + "'");
        target.commit();
        return true;
    } catch (const std::exception& e) {
        TF_WARN("%s: %s", dumpSceneName, e.what());
        return false;
    }
}

} // namespace patina
