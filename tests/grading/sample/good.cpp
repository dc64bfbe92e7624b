#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd&, const Eigen::Vector3d& target) { return target; }
