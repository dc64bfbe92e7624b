#pragma once

#include <array>
#include <cassert>

#include "render/gl_functions_internal.h"

namespace rex::internal {

/// Tells whether any of what is drawn under its eyes reaches the picture.
class Visibility {
 public:
  explicit Visibility(const GlFunctions& gl);

  /// Forgets the picture before.
  void start() { used_ = 0; }
  /// Calls `draw` and notes whether the depth test lets a sample of it pass. Not nested; at most three times
  /// after start().
  template <typename Draw>
  void watch(const Draw& draw) {
    assert(used_ < queries_.size());
    gl_->BeginQuery(GL_ANY_SAMPLES_PASSED, queries_[used_++]);
    draw();
    gl_->EndQuery(GL_ANY_SAMPLES_PASSED);
  }
  /// Whether any sample passed since start().
  [[nodiscard]] bool anySeen() const;

 private:
  const GlFunctions* gl_;
  std::array<GLuint, 3> queries_{};
  std::size_t used_ = 0;
};

}  // namespace rex::internal
