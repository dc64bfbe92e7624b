#include "control/pd_gains.h"

#include "control/require_internal.h"

namespace rex {

PdGains pdGains(double mass, double lambda, double xi) {
  internal::requirePositive("mass", mass);
  internal::requirePositive("wave length lambda", lambda);
  internal::requireNotNegative("damping ratio xi", xi);
  const PdGains gains{.Kp = mass / (lambda * lambda), .Kd = 2 * mass * xi / lambda};
  internal::requireFinite(gains);
  return gains;
}

}  // namespace rex
