// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <GL/glcorearb.h>

#include <string>

namespace patina {

// The functions of OpenGL 4.5 core that the rasterizer calls; no other are loaded.
#define PATINA_GL_FUNCTIONS(X)                                                                     \
    X(AttachShader, ATTACHSHADER)                                                                  \
    X(BindBuffer, BINDBUFFER)                                                                      \
    X(BindBufferBase, BINDBUFFERBASE)                                                              \
    X(BindBufferRange, BINDBUFFERRANGE)                                                            \
    X(BindFramebuffer, BINDFRAMEBUFFER)                                                            \
    X(BindTextureUnit, BINDTEXTUREUNIT)                                                            \
    X(BindVertexArray, BINDVERTEXARRAY)                                                            \
    X(BlendFunc, BLENDFUNC)                                                                        \
    X(CheckNamedFramebufferStatus, CHECKNAMEDFRAMEBUFFERSTATUS)                                    \
    X(ClearNamedFramebufferfv, CLEARNAMEDFRAMEBUFFERFV)                                            \
    X(ClearNamedFramebufferiv, CLEARNAMEDFRAMEBUFFERIV)                                            \
    X(ColorMask, COLORMASK)                                                                        \
    X(CompileShader, COMPILESHADER)                                                                \
    X(CreateBuffers, CREATEBUFFERS)                                                                \
    X(CreateFramebuffers, CREATEFRAMEBUFFERS)                                                      \
    X(CreateProgram, CREATEPROGRAM)                                                                \
    X(CreateQueries, CREATEQUERIES)                                                                \
    X(CreateShader, CREATESHADER)                                                                  \
    X(CreateTextures, CREATETEXTURES)                                                              \
    X(CreateVertexArrays, CREATEVERTEXARRAYS)                                                      \
    X(DeleteBuffers, DELETEBUFFERS)                                                                \
    X(DeleteFramebuffers, DELETEFRAMEBUFFERS)                                                      \
    X(DeleteProgram, DELETEPROGRAM)                                                                \
    X(DeleteQueries, DELETEQUERIES)                                                                \
    X(DeleteShader, DELETESHADER)                                                                  \
    X(DeleteSync, DELETESYNC)                                                                      \
    X(DeleteTextures, DELETETEXTURES)                                                              \
    X(DeleteVertexArrays, DELETEVERTEXARRAYS)                                                      \
    X(DepthFunc, DEPTHFUNC)                                                                        \
    X(DepthMask, DEPTHMASK)                                                                        \
    X(Disable, DISABLE)                                                                            \
    X(DispatchCompute, DISPATCHCOMPUTE)                                                            \
    X(DrawArrays, DRAWARRAYS)                                                                      \
    X(DrawArraysInstanced, DRAWARRAYSINSTANCED)                                                    \
    X(Enable, ENABLE)                                                                              \
    X(EnableVertexArrayAttrib, ENABLEVERTEXARRAYATTRIB)                                            \
    X(FenceSync, FENCESYNC)                                                                        \
    X(Finish, FINISH)                                                                              \
    X(Flush, FLUSH)                                                                                \
    X(CopyImageSubData, COPYIMAGESUBDATA)                                                          \
    X(GetError, GETERROR)                                                                          \
    X(GetGraphicsResetStatus, GETGRAPHICSRESETSTATUS)                                              \
    X(GetInteger64v, GETINTEGER64V)                                                                \
    X(GetIntegerv, GETINTEGERV)                                                                    \
    X(GetNamedBufferSubData, GETNAMEDBUFFERSUBDATA)                                                \
    X(GetProgramBinary, GETPROGRAMBINARY)                                                          \
    X(GetProgramInfoLog, GETPROGRAMINFOLOG)                                                        \
    X(GetProgramiv, GETPROGRAMIV)                                                                  \
    X(GetQueryObjectui64v, GETQUERYOBJECTUI64V)                                                    \
    X(GetShaderInfoLog, GETSHADERINFOLOG)                                                          \
    X(GetShaderiv, GETSHADERIV)                                                                    \
    X(GetString, GETSTRING)                                                                        \
    X(GetStringi, GETSTRINGI)                                                                      \
    X(GetTextureSubImage, GETTEXTURESUBIMAGE)                                                      \
    X(GetUniformLocation, GETUNIFORMLOCATION)                                                      \
    X(LinkProgram, LINKPROGRAM)                                                                    \
    X(MapNamedBufferRange, MAPNAMEDBUFFERRANGE)                                                    \
    X(MemoryBarrier, MEMORYBARRIER)                                                                \
    X(MultiDrawElementsIndirect, MULTIDRAWELEMENTSINDIRECT)                                        \
    X(NamedBufferStorage, NAMEDBUFFERSTORAGE)                                                      \
    X(NamedBufferSubData, NAMEDBUFFERSUBDATA)                                                      \
    X(NamedFramebufferDrawBuffers, NAMEDFRAMEBUFFERDRAWBUFFERS)                                    \
    X(NamedFramebufferTexture, NAMEDFRAMEBUFFERTEXTURE)                                            \
    X(NamedFramebufferTextureLayer, NAMEDFRAMEBUFFERTEXTURELAYER)                                  \
    X(PixelStorei, PIXELSTOREI)                                                                    \
    X(ProgramBinary, PROGRAMBINARY)                                                                \
    X(ProgramParameteri, PROGRAMPARAMETERI)                                                        \
    X(QueryCounter, QUERYCOUNTER)                                                                  \
    X(ReadPixels, READPIXELS)                                                                      \
    X(Scissor, SCISSOR)                                                                            \
    X(ShaderSource, SHADERSOURCE)                                                                  \
    X(TextureParameteri, TEXTUREPARAMETERI)                                                        \
    X(TextureStorage2D, TEXTURESTORAGE2D)                                                          \
    X(TextureStorage3D, TEXTURESTORAGE3D)                                                          \
    X(TextureSubImage2D, TEXTURESUBIMAGE2D)                                                        \
    X(TextureSubImage3D, TEXTURESUBIMAGE3D)                                                        \
    X(Uniform1i, UNIFORM1I)                                                                        \
    X(Uniform2f, UNIFORM2F)                                                                        \
    X(Uniform3f, UNIFORM3F)                                                                        \
    X(Uniform4f, UNIFORM4F)                                                                        \
    X(Uniform4i, UNIFORM4I)                                                                        \
    X(UniformMatrix4fv, UNIFORMMATRIX4FV)                                                          \
    X(UnmapNamedBuffer, UNMAPNAMEDBUFFER)                                                          \
    X(UseProgram, USEPROGRAM)                                                                      \
    X(VertexArrayAttribBinding, VERTEXARRAYATTRIBBINDING)                                          \
    X(VertexArrayAttribFormat, VERTEXARRAYATTRIBFORMAT)                                            \
    X(VertexArrayAttribIFormat, VERTEXARRAYATTRIBIFORMAT)                                          \
    X(VertexArrayBindingDivisor, VERTEXARRAYBINDINGDIVISOR)                                        \
    X(VertexArrayElementBuffer, VERTEXARRAYELEMENTBUFFER)                                          \
    X(VertexArrayVertexBuffer, VERTEXARRAYVERTEXBUFFER)                                            \
    X(Viewport, VIEWPORT)                                                                          \
    X(WaitSync, WAITSYNC)

struct GlFunctions {
#define PATINA_GL_DECLARE(name, NAME) PFNGL##NAME##PROC name = nullptr;
    PATINA_GL_FUNCTIONS(PATINA_GL_DECLARE)
#undef PATINA_GL_DECLARE
    /// Vertex shaders know which draw of a call they run for (ARB_shader_draw_parameters).
    bool tellsDraws = false;
};

/// OpenGL as EGL gives it; filled by the first GlContext. Call only while a context is current.
extern GlFunctions gl;

/// Fills `gl`. @returns false with a one-line error that names the first missing function
bool loadGlFunctions(std::string& error);

} // namespace patina
