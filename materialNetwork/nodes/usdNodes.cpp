// SPDX-License-Identifier: Apache-2.0
// UsdUVTexture of the UsdPreviewSurface specification.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/usd.glsl"
#include "materialNetwork/nodes/imageSetup.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

/// "useMetadata", the default, without metadata in the file means black, as the specification says;
/// MaterialX spells repeat "periodic", and its "constant" ends at the fallback.
/// @param own becomes whether the file is asked
TextureWrap wrapMode(PatternSetup& setup, const char* input, bool& own) {
    const std::string mode = setup.text(input);
    own = mode == "useMetadata" || mode.empty();
    if (mode == "repeat" || mode == "periodic") return TextureWrap::Repeat;
    if (mode == "clamp" || mode == "constant") return TextureWrap::Clamp;
    if (mode == "mirror") return TextureWrap::Mirror;
    if (mode != "black" && !own) setup.warn(input, messages::wrapModeUnknown(mode));
    return TextureWrap::Black;
}

void prepareUvTexture(PatternSetup& setup, PatternData& data) {
    const Value* file = setup.constant("file");
    if (!file || file->text.empty()) {
        setup.warn("file", messages::noFileFallback);
        return;
    }
    TextureRequest request;
    request.file = file->text;
    request.colorSpace = setup.text("sourceColorSpace");
    // The colour space of the asset itself is the more specific statement.
    if ((request.colorSpace.empty() || request.colorSpace == "auto") && !file->colorSpace.empty())
        request.colorSpace = file->colorSpace;
    if (request.colorSpace.empty()) request.colorSpace = "auto";
    request.wrapS = wrapMode(setup, "wrapS", request.ownWrapS);
    request.wrapT = wrapMode(setup, "wrapT", request.ownWrapT);
    data.mode = imageEnds(setup, "wrapS", "wrapT");
    request.input = "inputs:file";
    const int handle = setup.openTexture(request);
    if (setup.textureValid(handle) || !setup.authored("fallback")) data.textures[0] = handle;
}

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows usdNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
