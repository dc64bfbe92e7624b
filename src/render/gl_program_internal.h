#pragma once

#include <string>

#include <Eigen/Core>

#include "render/color.h"
#include "render/gl_functions_internal.h"

namespace rex::internal {

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
