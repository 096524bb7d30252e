// SPDX-License-Identifier: Apache-2.0
// MaterialX image nodes.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/texture.glsl"
#include "materialNetwork/nodes/imageSetup.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

TextureWrap addressMode(PatternSetup& setup, const char* input) {
    const std::string mode = setup.text(input);
    if (mode == "constant" || mode == "clamp") return TextureWrap::Clamp;
    if (mode == "mirror") return TextureWrap::Mirror;
    if (mode != "periodic" && !mode.empty()) setup.warn(input, messages::addressModeUnknown(mode));
    return TextureWrap::Repeat;
}

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

int openImage(PatternSetup& setup, const char* input) {
    TextureRequest request;
    const Value* file = setup.constant(input);
    if (!file) {
        setup.warn(input, messages::fileNameVaries);
        return -1;
    }
    if (file->text.empty()) {
        setup.warn(input, messages::noFileDefault);
        return -1;
    }
    request.file = file->text;
    request.colorSpace = file->colorSpace.empty() ? "raw" : file->colorSpace;
    request.wrapS = addressMode(setup, "uaddressmode");
    request.wrapT = addressMode(setup, "vaddressmode");
    request.nearest = setup.text("filtertype") == "closest";
    request.input = input;
    if (!setup.text("layer").empty() || !setup.text("framerange").empty())
        setup.warn(input, messages::imageLayersNotRead);
    const int handle = setup.openTexture(request);
    // Without an authored default the source's own sign of a missing texture shows.
    return setup.textureValid(handle) || !setup.authored("default") ? handle : -1;
}

int imageEnds(PatternSetup& setup, const char* s, const char* t) {
    const std::string file = setup.text("file");
    if (file.find("<UDIM>") != std::string::npos || file.find("<UVTILE>") != std::string::npos)
        return 0;
    return (setup.text(s) == "constant" ? sh::IMAGE_ENDS_S : 0) |
           (setup.text(t) == "constant" ? sh::IMAGE_ENDS_T : 0);
}

void prepareImage(PatternSetup& setup, PatternData& data) {
    data.mode = imageEnds(setup, "uaddressmode", "vaddressmode");
    data.textures[0] = openImage(setup, "file");
}

NodeRows textureNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
