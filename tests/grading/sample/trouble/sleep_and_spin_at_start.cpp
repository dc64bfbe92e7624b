#include <unistd.h>

#include "exercise.h"

// Asleep for most of the time before it is ready, and busy when the time is over.
const bool started = [] {
  usleep(1400000);
  for (volatile bool goesOn = true; goesOn;) {
  }
  return true;
}();

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) { return target; }
