#include "course/cart_pole.h"

namespace rex {

CartPole::CartPole(std::uint64_t seed, const CartPoleOptions& options) : options_(options), rng_(seed) {
  Rng draws = rng_;
  // A step whose result is discarded throws if an option is out of range.
  (void)options.dynamics.noisyStep(x, 0, options.tau, options.noise, draws);
}

}  // namespace rex
