#include "base/rng.h"

#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

std::uint64_t splitmix64(std::uint64_t& x) {
  x += 0x9e3779b97f4a7c15u;
  std::uint64_t z = x;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

void requireSize(int size) {
  if (size < 0)
    throw Error({.what = "random vector", .found = fmt::format("size {}", size), .wanted = "0 or more"});
}

}  // namespace

Rng::Rng(std::uint64_t seed) {
  for (std::uint64_t& word : state_) word = splitmix64(seed);
}

Rng Rng::fromState(const std::array<std::uint64_t, 4>& state) {
  if ((state[0] | state[1] | state[2] | state[3]) == 0) {
    throw Error({.what = "random generator state", .found = "all zeros", .wanted = "at least one bit set"});
  }
  Rng rng;
  rng.state_ = state;
  return rng;
}

std::uint64_t Rng::next() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t t = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= t;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Rng::uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

double Rng::uniform(double low, double high) {
  if (!(low <= high) || !std::isfinite(low) || !std::isfinite(high)) {
    throw Error({.what = "uniform random number",
                 .found = fmt::format("the range [{}, {})", low, high),
                 .wanted = "finite bounds, low <= high"});
  }
  return low + (high - low) * uniform();
}

int Rng::index(int count) {
  if (count <= 0) {
    throw Error({.what = "random index", .found = fmt::format("count {}", count), .wanted = "count > 0"});
  }
  // Values below 2^64 mod count would make the first remainders more likely: draw again.
  const auto n = static_cast<std::uint64_t>(count);
  const std::uint64_t reject = (0 - n) % n;
  std::uint64_t bits = next();
  while (bits < reject) bits = next();
  return static_cast<int>(bits % n);
}

double Rng::normal() {
  for (;;) {
    const double u = 2 * uniform() - 1;
    const double v = 2 * uniform() - 1;
    const double s = u * u + v * v;
    if (s > 0 && s < 1) return u * std::sqrt(-2 * std::log(s) / s);
  }
}

Eigen::VectorXd Rng::normalVector(int size) {
  requireSize(size);
  Eigen::VectorXd values(size);
  for (double& value : values) value = normal();
  return values;
}

Eigen::VectorXd Rng::uniformVector(int size, double low, double high) {
  requireSize(size);
  Eigen::VectorXd values(size);
  for (double& value : values) value = uniform(low, high);
  return values;
}

Rng Rng::split(std::uint64_t stream) const {
  std::uint64_t mix = state_[0] ^ std::rotl(state_[3], 17);
  mix = splitmix64(mix) ^ stream;
  return Rng(splitmix64(mix));
}

}  // namespace rex
