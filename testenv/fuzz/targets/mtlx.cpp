// SPDX-License-Identifier: Apache-2.0
// Any bytes as a MaterialX document; the materials that it holds become programs and GLSL text.
#include "materialNetwork/mtlx/document.h"
#include "testenv/fuzz/targets/targets.h"
#include "testenv/fuzz/targets/useMaterial.h"

bool fuzzMtlx(const uint8_t* data, size_t size) {
    using namespace patina;
    MtlxDocument document;
    Diagnostics diagnostics;
    const std::string text(reinterpret_cast<const char*>(data), size);
    // Of a folder that does not exist, so that includes and textures are never there.
    if (!parseMtlx(text, "/nonexistent/fuzz/input.mtlx", true, document, diagnostics)) return false;
    size_t used = 0;
    for (const Network& network : document.materials)
        if (++used <= 2 && network.nodes.size() <= 200) useMaterial(network, text);
    return true;
}
