#pragma once

#include <gtest/gtest.h>

#include "base/process.h"

/// Skips a test that draws where gnuplot is missing.
#define REX_NEEDS_GNUPLOT() \
  if (!::rex::runProcess({"gnuplot", "--version"}).ok()) GTEST_SKIP() << "install gnuplot-nox"

namespace rex {

/// How far a figure may be from the stored one, see imageDifference(). Gnuplot 5.4 of Debian 12 drew those;
/// others place text some tenths of a pixel elsewhere: with 6.0 of Debian 13, 3.0 % of the pixels of a small
/// figure differ much, and 2.2 steps on average.
struct FigureTolerance {
  double largeShare = 0.005, mean = 0.5;
};
inline FigureTolerance figureTolerance() {
  const bool isSame = runProcess({"gnuplot", "--version"}).output.starts_with("gnuplot 5.4");
  return isSame ? FigureTolerance{} : FigureTolerance{.largeShare = 0.04, .mean = 3};
}

}  // namespace rex
