#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace rex {

/// Seeded random numbers with the same sequence on every machine and compiler: xoshiro256** (Blackman and
/// Vigna, 2018) seeded by splitmix64, and distributions of our own, because those of the standard library
/// differ between implementations. A value type: a copy continues the same sequence.
class Rng {
 public:
  explicit Rng(std::uint64_t seed = 0);

  /// The next 64 random bits.
  std::uint64_t next();
  /// Uniform in [0, 1), on a grid of 2^-53.
  double uniform();
  /// Uniform in [low, high). Throws Error unless low <= high and both are finite.
  double uniform(double low, double high);
  /// Uniform in {0, ..., count - 1}, without bias. Throws Error unless count > 0.
  int index(int count);
  /// Standard normal, by the polar method (Marsaglia).
  double normal();
  /// `size` independent standard normals. Throws Error if the size is negative.
  Eigen::VectorXd normalVector(int size);
  /// `size` independent uniforms in [low, high). Throws as uniform(low, high) and normalVector().
  Eigen::VectorXd uniformVector(int size, double low, double high);
  /// An independent generator for a named part of an experiment: the same (state, stream) gives the same
  /// child.
  Rng split(std::uint64_t stream) const;

  const std::array<std::uint64_t, 4>& state() const { return state_; }
  /// Resumes a sequence from state(). Throws Error if all four words are zero.
  static Rng fromState(const std::array<std::uint64_t, 4>& state);

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace rex
