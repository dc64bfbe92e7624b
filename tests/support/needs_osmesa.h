#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

/// Skips the test where OSMesa is not installed; where it is, everything that fails is a failure.
#define REX_NEEDS_OSMESA()                                          \
  if (::dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL) == nullptr) \
  GTEST_SKIP() << "needs OpenGL without a window: install Debian package libosmesa6"
