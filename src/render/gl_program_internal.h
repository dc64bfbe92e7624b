#pragma once

#include <string>

#include <Eigen/Core>
#include <GL/glcorearb.h>

#include "render/color.h"
#include "render/gl_context.h"
#include "render/image.h"

namespace rex::internal {

/// The part of OpenGL 3.3 that rex uses: X(name without gl, type).
#define REX_GL_FUNCTIONS(X)                                                  \
  X(ActiveTexture, PFNGLACTIVETEXTUREPROC)                                   \
  X(AttachShader, PFNGLATTACHSHADERPROC)                                     \
  X(BeginQuery, PFNGLBEGINQUERYPROC)                                         \
  X(BindBuffer, PFNGLBINDBUFFERPROC)                                         \
  X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                               \
  X(BindRenderbuffer, PFNGLBINDRENDERBUFFERPROC)                             \
  X(BindTexture, PFNGLBINDTEXTUREPROC)                                       \
  X(BindVertexArray, PFNGLBINDVERTEXARRAYPROC)                               \
  X(BlendFunc, PFNGLBLENDFUNCPROC)                                           \
  X(BlitFramebuffer, PFNGLBLITFRAMEBUFFERPROC)                               \
  X(BufferData, PFNGLBUFFERDATAPROC)                                         \
  X(CheckFramebufferStatus, PFNGLCHECKFRAMEBUFFERSTATUSPROC)                 \
  X(Clear, PFNGLCLEARPROC)                                                   \
  X(CompileShader, PFNGLCOMPILESHADERPROC)                                   \
  X(CreateProgram, PFNGLCREATEPROGRAMPROC)                                   \
  X(CreateShader, PFNGLCREATESHADERPROC)                                     \
  X(CullFace, PFNGLCULLFACEPROC)                                             \
  X(DeleteBuffers, PFNGLDELETEBUFFERSPROC)                                   \
  X(DeleteShader, PFNGLDELETESHADERPROC)                                     \
  X(DeleteTextures, PFNGLDELETETEXTURESPROC)                                 \
  X(DeleteVertexArrays, PFNGLDELETEVERTEXARRAYSPROC)                         \
  X(DepthFunc, PFNGLDEPTHFUNCPROC)                                           \
  X(DepthMask, PFNGLDEPTHMASKPROC)                                           \
  X(Disable, PFNGLDISABLEPROC)                                               \
  X(DrawArrays, PFNGLDRAWARRAYSPROC)                                         \
  X(DrawBuffer, PFNGLDRAWBUFFERPROC)                                         \
  X(DrawElements, PFNGLDRAWELEMENTSPROC)                                     \
  X(Enable, PFNGLENABLEPROC)                                                 \
  X(EnableVertexAttribArray, PFNGLENABLEVERTEXATTRIBARRAYPROC)               \
  X(EndQuery, PFNGLENDQUERYPROC)                                             \
  X(FramebufferRenderbuffer, PFNGLFRAMEBUFFERRENDERBUFFERPROC)               \
  X(FramebufferTexture2D, PFNGLFRAMEBUFFERTEXTURE2DPROC)                     \
  X(GenBuffers, PFNGLGENBUFFERSPROC)                                         \
  X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                               \
  X(GenQueries, PFNGLGENQUERIESPROC)                                         \
  X(GenRenderbuffers, PFNGLGENRENDERBUFFERSPROC)                             \
  X(GenTextures, PFNGLGENTEXTURESPROC)                                       \
  X(GenVertexArrays, PFNGLGENVERTEXARRAYSPROC)                               \
  X(GenerateMipmap, PFNGLGENERATEMIPMAPPROC)                                 \
  X(GetError, PFNGLGETERRORPROC)                                             \
  X(GetIntegerv, PFNGLGETINTEGERVPROC)                                       \
  X(GetProgramInfoLog, PFNGLGETPROGRAMINFOLOGPROC)                           \
  X(GetProgramiv, PFNGLGETPROGRAMIVPROC)                                     \
  X(GetQueryObjectuiv, PFNGLGETQUERYOBJECTUIVPROC)                           \
  X(GetString, PFNGLGETSTRINGPROC)                                           \
  X(GetUniformLocation, PFNGLGETUNIFORMLOCATIONPROC)                         \
  X(LinkProgram, PFNGLLINKPROGRAMPROC)                                       \
  X(PixelStorei, PFNGLPIXELSTOREIPROC)                                       \
  X(ReadBuffer, PFNGLREADBUFFERPROC)                                         \
  X(ReadPixels, PFNGLREADPIXELSPROC)                                         \
  X(RenderbufferStorageMultisample, PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC) \
  X(ShaderSource, PFNGLSHADERSOURCEPROC)                                     \
  X(StencilFunc, PFNGLSTENCILFUNCPROC)                                       \
  X(StencilOp, PFNGLSTENCILOPPROC)                                           \
  X(TexImage2D, PFNGLTEXIMAGE2DPROC)                                         \
  X(TexParameteri, PFNGLTEXPARAMETERIPROC)                                   \
  X(Uniform1f, PFNGLUNIFORM1FPROC)                                           \
  X(Uniform1i, PFNGLUNIFORM1IPROC)                                           \
  X(Uniform3f, PFNGLUNIFORM3FPROC)                                           \
  X(Uniform4f, PFNGLUNIFORM4FPROC)                                           \
  X(UniformMatrix3fv, PFNGLUNIFORMMATRIX3FVPROC)                             \
  X(UniformMatrix4fv, PFNGLUNIFORMMATRIX4FVPROC)                             \
  X(UseProgram, PFNGLUSEPROGRAMPROC)                                         \
  X(VertexAttribPointer, PFNGLVERTEXATTRIBPOINTERPROC)                       \
  X(Viewport, PFNGLVIEWPORTPROC)

/// The OpenGL functions of one context: gl.Clear(...) is glClear(...).
struct GlFunctions {
#define REX_GL_MEMBER(name, type) type name = nullptr;
  REX_GL_FUNCTIONS(REX_GL_MEMBER)
#undef REX_GL_MEMBER
};

/// All functions of `context`. Throws Error listing the missing ones.
[[nodiscard]] GlFunctions loadGlFunctions(const GlContext& context);

/// Throws Error if OpenGL has noticed one since the last call; `doing` says what was going on.
void requireNoGlError(const GlFunctions& gl, const char* doing);

/// A linked vertex and fragment shader and its uniforms by name. Setting one needs use() first.
class GlProgram {
 public:
  GlProgram(const GlFunctions& gl, const std::string& vertexSource, const std::string& fragmentSource);

  void use() const { gl_->UseProgram(id_); }
  void set(const char* name, double value) const;
  void set(const char* name, const Eigen::Vector3d& value) const;
  void set(const char* name, const Eigen::Matrix3d& value) const;
  void set(const char* name, const Eigen::Matrix4d& value) const;
  /// As the shaders count light: sRGB undone, see shaders_internal.h.
  void set(const char* name, const Color& value) const;
  /// The texture that the sampler `name` reads: that of this unit.
  void setTexture(const char* name, int unit) const;

 private:
  GLint location(const char* name) const;

  const GlFunctions* gl_;
  GLuint id_;
};

}  // namespace rex::internal
