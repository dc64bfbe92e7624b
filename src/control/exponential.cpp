#include <unsupported/Eigen/MatrixFunctions>

#include "control/exponential_internal.h"

namespace rex::internal {

Eigen::MatrixXd exponential(const Eigen::MatrixXd& M) { return M.exp(); }

}  // namespace rex::internal
