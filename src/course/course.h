#pragma once

// All a student needs: `#include "course/course.h"`. Declarations only, so that a main.cpp compiles fast.
// Eigen/Geometry is here for a.cross(b): without it that compiles and then fails to link. Of Eigen's products
// and decompositions there are declarations of what the library has compiled.
#include <Eigen/Geometry>

#include "base/derivative_check.h"
#include "base/eigen_instances.h"
#include "base/error.h"
#include "base/rng.h"
#include "course/linear_algebra.h"
#include "course/pictures.h"
#include "course/plot.h"
#include "course/print.h"
#include "course/recording.h"
#include "course/replay.h"
#include "course/simulator.h"
#include "geometry/pose.h"
#include "geometry/shape.h"
