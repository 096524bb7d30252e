// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glFunctions.h"

#include <array>
#include <cstddef>
#include <string>

namespace patina {

/// Keeps the fences of llvmpipe alive for as long as its threads use them.
///
/// llvmpipe makes a fence for each batch of what is drawn into one framebuffer. Its threads signal
/// it under a mutex that is a part of the fence. The context's thread looks without that mutex
/// whether all have signalled, and frees the fence before the next batch: the last thread may
/// still be about to unlock it, and then writes into memory that has become somebody else's (seen
/// with Mesa 22.3.6; its newer sources read the same).
///
/// A sync object holds the fence of the last batch. The driver has 64 batches at most at work, and
/// its threads take them in turn, each when all are done with the one before. So no thread holds a
/// fence that 65 batches or more have followed. Draws that show nothing make no batch: more are
/// kept.
///
/// The driver ends a batch by itself when its textures exceed 64 MB, or its triangles and their
/// lists 36 MB (Mesa 22.3). So each draw is a batch of its own, and has mostTriangles() at most.
class HeldFences {
public:
    /// Whether the driver of a context is one that needs it.
    /// @param renderer GL_RENDERER
    static bool neededBy(const std::string& renderer);
    /// Has the functions of `gl` take sync objects, in contexts that need it. Called once they are
    /// loaded.
    static void install();

    /// Triangles that a draw of the current context may have; without a limit where it needs none.
    /// With the 32 vectors that a vertex shader may write, a triangle takes up to 1.8 KB, so all
    /// take 29 MB of the 36. The lists of triangles by tile have the rest: a triangle that covers
    /// very many tiles takes more of it.
    static size_t mostTriangles();

    HeldFences() = default;
    HeldFences(const HeldFences&) = delete;
    HeldFences& operator=(const HeldFences&) = delete;

    /// Says which ones are of the context that is current on this thread; null where it needs none.
    /// Call with null before another context becomes current: that ends a batch.
    /// @returns those before
    static HeldFences* makeCurrent(HeldFences* fences);

    // What is drawn next, and into which framebuffer: ends the batch where that is another one.
    void bound(GLuint framebuffer) { _bound = framebuffer; }
    void draws() { drawsInto(_bound); }
    void drawsInto(GLuint framebuffer);
    void clears(GLuint framebuffer);
    /// Ends the batch, if one has begun. Call before all that may end it.
    void hold();
    /// Lets go of all; waits until the driver's threads are done with them.
    void release();

private:
    std::array<GLsync, 256> _held{}; ///< a ring
    size_t _next = 0;
    GLuint _bound = 0, _framebuffer = 0;
    bool _pending = false; ///< something was drawn into _framebuffer since the last hold()
    bool _drawn = false;   ///< not only cleared
};

} // namespace patina
