#include <cstdlib>

#include <gtest/gtest.h>

#include "course/pictures.h"
#include "support/expect_error.h"

namespace rex::gl_choice_test {

GlBackend chosenBy(const char* value) {
  ::setenv("REX_GL", value, 1);
  return glChoice().backend;
}

TEST(GlChoice, ComesFromTheEnvironment) {
  EXPECT_EQ(chosenBy("osmesa"), GlBackend::kOsMesa);
  EXPECT_EQ(chosenBy("egl"), GlBackend::kEgl);
  EXPECT_EQ(chosenBy("gpu"), GlBackend::kGpu);
  EXPECT_EQ(chosenBy("auto"), GlBackend::kAuto);
  EXPECT_EQ(chosenBy(""), GlBackend::kAuto);
  EXPECT_REX_ERROR(chosenBy("elg"), "OpenGL backend: found 'elg', wanted auto, egl");
  ::unsetenv("REX_GL");
  EXPECT_EQ(glChoice().backend, GlBackend::kAuto);
}

}  // namespace rex::gl_choice_test
