#include "render/visibility_internal.h"

namespace rex::internal {

Visibility::Visibility(const GlFunctions& gl) : gl_(&gl) {
  gl.GenQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

bool Visibility::anySeen() const {
  bool seen = false;
  for (std::size_t i = 0; i < used_; ++i) {
    GLuint samples = 0;
    gl_->GetQueryObjectuiv(queries_[i], GL_QUERY_RESULT, &samples);
    seen |= samples > 0;
  }
  return seen;
}

}  // namespace rex::internal
