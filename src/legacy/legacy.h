#pragma once

// For programs in the style of older course material, such as the listings of the course script: arr, ~, ARR,
// Simulator calls that fill their first argument, SearchCMA, gnuplot, rnd, MT::wait. They compile unchanged
// and run without a display. New programs include course/course.h.
#include <cmath>
#include <iostream>

#include "legacy/array.h"
#include "legacy/parameters.h"
#include "legacy/plot.h"
#include "legacy/random.h"
#include "legacy/search_cma.h"
#include "legacy/simulator.h"
#include "legacy/toy_systems.h"

/// The small helpers of older course material.
namespace MT {

/// Would wait for a key, or for some seconds; nobody watches, so both return at once.
inline void wait() {}
inline void wait(double) {}
inline double sqr(double x) { return x * x; }
inline double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

}  // namespace MT

// What such programs expect to find without a prefix.
using std::cout;
using std::endl;
using namespace rex::legacy;  // NOLINT: the purpose of this header
