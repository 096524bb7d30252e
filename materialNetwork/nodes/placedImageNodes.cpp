// SPDX-License-Identifier: Apache-2.0
// Image nodes that bring their own placement: glTF's, latitude-longitude maps, three planes.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/placedImage.glsl"
#include "materialNetwork/nodes/imageSetup.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

void prepareTriplanar(PatternSetup& setup, PatternData& data) {
    const char* const files[] = {"filex", "filey", "filez"};
    for (int i = 0; i < 3; ++i)
        data.textures[i] = openImage(setup, files[i]);
}

#define PATINA_NODE_ROWS
#include PATINA_NODE_FUNCTIONS

} // namespace

NodeRows placedImageNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
