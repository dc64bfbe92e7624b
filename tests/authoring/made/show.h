#pragma once

#include "exercise.h"

/// result.png: the values, step by step. result.html: a frame that moves along the path (metres).
void showResult(const std::vector<double>& values, const std::vector<Eigen::Vector3d>& path);
