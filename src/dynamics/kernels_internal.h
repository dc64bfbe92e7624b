#pragma once

#include "dynamics/link_kernel_internal.h"
#include "scene/link.h"

namespace rex::internal {

/// Forward dynamics in plain numbers, for models without joints that mimic: given are forces, results are
/// accelerations.
struct ForwardDynamicsKernel {
  /// Returns kRegular, or the place of a link whose coordinate meets no inertia. Results of that state are
  /// not written then, nor of those after it; those of states before it in a block may be.
  using Solve = int (*)(const DynamicsTask& task);
  static constexpr int kRegular = -1;
  /// An inertia below this share of Link::largestInertia is none: rounding leaves some 1e-16 of a chain that
  /// has none, and a thousand times as much leaves three digits of the acceleration.
  static constexpr double kLeastShare = 1e-13;

  Solve one;                              ///< of one state
  Solve block;                            ///< of DynamicsTask::kBlock states
  int numbersPerLink, numbersPerFreedom;  ///< of memory, per lane; the world counts as a link

  template <int kLanes>
  static ForwardDynamicsKernel compiled();
};

/// Inverse dynamics in plain numbers: given are accelerations, results are forces.
struct InverseDynamicsKernel {
  using Solve = void (*)(const DynamicsTask& task);
  Solve one;                              ///< of one state
  Solve block;                            ///< of DynamicsTask::kBlock states
  int numbersPerLink, numbersPerFreedom;  ///< of memory, per lane; the world counts as a link

  template <int kLanes>
  static InverseDynamicsKernel compiled();
};

/// The mass matrix of one posture in plain numbers, both halves: entry (i, k) at M[i + stride k].
struct MassMatrixKernel {
  using Compute = void (*)(const Link* links, int linkCount, const double* q, void* memory, double* M,
                           long stride, int nv);
  Compute one;
  int numbersPerLink, numbersPerFreedom;  ///< of memory; see roomFor()

  template <int kLanes>
  static MassMatrixKernel compiled();
};

/// The derivatives of inverse dynamics at one state in plain numbers: results are those by q, v and a, each
/// nv x nv by columns.
struct DerivativesKernel {
  void (*one)(const DynamicsTask& task);
  int numbersPerLink, numbersPerFreedom;  ///< of memory; see roomFor()
  /// Overwrites B by the solution of L^T L X = B, n rows of `stride` numbers, a multiple of four. Only the
  /// lower half of the n columns of L is read. Zeros cost nothing, and L of a tree has many.
  void (*solve)(const double* L, double* B, int n, int stride);

  template <int kLanes>
  static DerivativesKernel compiled();
};

}  // namespace rex::internal
