#pragma once

#include "legacy/array.h"

namespace rex::legacy {

/// Draws into the working folder: gnuplot.png, then gnuplot-2.png and so on. A vector is a curve over its
/// index, a matrix of two columns the second over the first, of more columns a curve for each over the row.
/// Throws Error for an empty array and for numbers that are not finite.
void gnuplot(const arr& x);

}  // namespace rex::legacy
