// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/scene/rasterScene.h"

namespace patina {

/// What a pass draws, in order, as a list that the driver takes in few calls: what needs the same
/// bindings is one call.
class RasterDrawList {
public:
    /// Adds what is visible of a surface.
    void add(const RasterDraw& draw, const RasterSurface& surface, const RasterVisible& visible);
    size_t size() const { return _commands.size(); }
    bool empty() const { return _commands.empty(); }

    /// Brings the list to the device, once all is added.
    /// @param shades programs read records of draws, see shaders/raster/draws.glsl
    void upload(bool shades);
    /// Draws [first, last) with the program in use. Between calls nobody else may change the
    /// bindings of the vertex array, of indirect draws, and of storage 2, 6 and 12.
    /// @param shades the program has the stages of surface.vert.glsl and surface.frag.glsl
    void draw(GLuint vertexArray, size_t first, size_t last, bool shades);

private:
    struct Command { ///< as OpenGL reads it
        GLuint count, instances, firstIndex;
        GLint firstVertex;
        GLuint firstInstance;
    };
    struct Record { ///< as draws.glsl reads it
        glm::ivec4 info{0}, rows{0};
    };
    std::vector<Command> _commands;
    std::vector<Record> _records;
    std::vector<const RasterChunk*> _chunks;
    const RasterChunk* _bound = nullptr; ///< the last one drawn, with its bindings
    bool _boundShades = false;
    size_t _firstRecord = 0; ///< of those that are bound
    GlBuffer _commandBuffer, _recordBuffer;
};

} // namespace patina
