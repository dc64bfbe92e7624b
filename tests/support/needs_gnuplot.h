#pragma once

#include <gtest/gtest.h>

#include "base/process.h"

/// Skips a test that draws where gnuplot is missing.
#define REX_NEEDS_GNUPLOT() \
  if (!::rex::runProcess({"gnuplot", "--version"}).ok()) GTEST_SKIP() << "install gnuplot-nox"
