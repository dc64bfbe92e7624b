#include "control/pd_gains.h"

#include "control/require_internal.h"

namespace rex {

PdGains pdGains(double mass, double lambda, double xi) {
  requirePositive("mass", mass);
  requirePositive("wave length lambda", lambda);
  requireNotNegative("damping ratio xi", xi);
  const PdGains gains{.Kp = mass / (lambda * lambda), .Kd = 2 * mass * xi / lambda};
  internal::requireFinite(gains);
  return gains;
}

}  // namespace rex
