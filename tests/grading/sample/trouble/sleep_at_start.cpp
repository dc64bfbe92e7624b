#include <unistd.h>

#include "exercise.h"

const unsigned awake = sleep(1000);

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) { return target; }
