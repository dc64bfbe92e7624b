#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

/// Skips the test where EGL is not installed; where it is, everything that fails is a failure.
#define REX_NEEDS_EGL()                                          \
  if (::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL) == nullptr) \
  GTEST_SKIP() << "needs OpenGL without a window: install Debian packages libegl1 and libgl1-mesa-dri"
