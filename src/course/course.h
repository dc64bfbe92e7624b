#pragma once

// Everything a student needs: `#include "course/course.h"`. It holds declarations only, so that a main.cpp
// compiles fast. Eigen/Geometry is included for a.cross(b), which would otherwise compile but fail to link.
// Eigen's products and decompositions are declared where the library has already compiled them.
#include <Eigen/Geometry>

#include "base/derivative_check.h"
#include "base/eigen_instances.h"
#include "base/error.h"
#include "base/rng.h"
#include "course/film.h"
#include "course/linear_algebra.h"
#include "course/pictures.h"
#include "course/print.h"
#include "course/recording.h"
#include "course/simulator.h"
#include "geometry/pose.h"
#include "geometry/shape.h"
