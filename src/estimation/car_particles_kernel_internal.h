#pragma once

namespace rex::internal {

/// A step of a car in its own frame, and the deviations of its noise.
struct CarStep {
  double distance, turn;  ///< metres, radians
  double deviations[3];
};

/// A landmark, where it was seen, and the upper half of the inverse covariance of that.
struct Sighting {
  double landmark[2], seen[2];
  double information[3];
};

/// What car_particles_kernel.cpp computes with 1, 2 or 4 lanes. States are x, y, heading of one particle
/// after the other, `stride` numbers apart.
struct CarParticlesKernel {
  /// normals: `count` for x, then for y, then for the heading.
  void (*move)(const CarStep& step, const double* normals, double* states, long stride, long count);
  /// Subtracts half the squared errors of the sightings from the logarithms of the weights.
  void (*weigh)(const Sighting* sightings, long sighted, const double* states, long stride, long count,
                double* logWeights);

  template <int kLanes>
  static CarParticlesKernel compiled();
};

}  // namespace rex::internal
