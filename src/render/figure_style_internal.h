#pragma once

namespace rex::internal {

/// The gnuplot commands of share/gnuplot/style.gp, which the build puts into the library.
[[nodiscard]] const char* figureStyle();

}  // namespace rex::internal
