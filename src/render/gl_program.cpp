#include <algorithm>
#include <array>
#include <cassert>

#include <fmt/format.h>

#include "base/error.h"
#include "render/gl_program_internal.h"

namespace rex::internal {

GlFunctions loadGlFunctions(const GlContext& context) {
  GlFunctions gl;
  std::string missing;
#define REX_GL_LOAD(name, type)                               \
  gl.name = reinterpret_cast<type>(context.proc("gl" #name)); \
  if (gl.name == nullptr) missing += missing.empty() ? "gl" #name : ", gl" #name;
  REX_GL_FUNCTIONS(REX_GL_LOAD)
#undef REX_GL_LOAD
  if (!missing.empty())
    throw Error(
        {.what = "OpenGL by " + context.describe(), .found = "no " + missing, .wanted = "OpenGL 3.3 core"});
  return gl;
}

void requireNoGlError(const GlFunctions& gl, const char* doing) {
  const GLenum code = gl.GetError();
  if (code == GL_NO_ERROR) return;
  throw Error({.what = fmt::format("OpenGL failed while {}", doing),
               .found = code == GL_OUT_OF_MEMORY ? "too little memory" : fmt::format("error {:#x}", code)});
}

namespace {

void attachShader(const GlFunctions& gl, GLuint program, GLenum kind, const std::string& source) {
  const GLuint shader = gl.CreateShader(kind);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  gl.AttachShader(program, shader);
  gl.DeleteShader(shader);
}

}  // namespace

GlProgram::GlProgram(const GlFunctions& gl, const std::string& vertexSource,
                     const std::string& fragmentSource)
    : gl_(&gl), id_(gl.CreateProgram()) {
  attachShader(gl, id_, GL_VERTEX_SHADER, vertexSource);
  attachShader(gl, id_, GL_FRAGMENT_SHADER, fragmentSource);
  gl.LinkProgram(id_);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  std::array<char, 1024> log{};
  gl.GetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw Error({.what = "OpenGL rejects a shader of rex", .found = log.data()});
}

void GlProgram::set(const char* name, double value) const {
  gl_->Uniform1f(location(name), static_cast<float>(value));
}

void GlProgram::set(const char* name, const Eigen::Vector3d& value) const {
  const Eigen::Vector3f v = value.cast<float>();
  gl_->Uniform3f(location(name), v.x(), v.y(), v.z());
}

void GlProgram::set(const char* name, const Eigen::Matrix3d& value) const {
  const Eigen::Matrix3f m = value.cast<float>();
  gl_->UniformMatrix3fv(location(name), 1, GL_FALSE, m.data());
}

void GlProgram::set(const char* name, const Eigen::Matrix4d& value) const {
  const Eigen::Matrix4f m = value.cast<float>();
  gl_->UniformMatrix4fv(location(name), 1, GL_FALSE, m.data());
}

void GlProgram::set(const char* name, const Color& c) const {
  const auto light = [](float x) { return std::clamp(x, 0.f, 1.f) * std::clamp(x, 0.f, 1.f); };
  gl_->Uniform4f(location(name), light(c.r), light(c.g), light(c.b), std::clamp(c.a, 0.f, 1.f));
}

void GlProgram::setTexture(const char* name, int unit) const { gl_->Uniform1i(location(name), unit); }

GLint GlProgram::location(const char* name) const {
  const GLint where = gl_->GetUniformLocation(id_, name);
  assert(where >= 0);
  return where;
}

}  // namespace rex::internal
