// Cholesky and LU decompositions.
#define REX_LU_INSTANCE template
#include "base/eigen_instances.h"

namespace Eigen {

// The same memory as a Map, a type of result for which nothing is specialised.
template <>
template <>
void PartialPivLU<MatrixXd>::_solve_impl(const MatrixXd& b, MatrixXd& x) const {
  Map<MatrixXd> same(x.data(), x.rows(), x.cols());
  _solve_impl(b, same);
}
template <>
template <>
void PartialPivLU<MatrixXd>::_solve_impl(const VectorXd& b, VectorXd& x) const {
  Map<VectorXd> same(x.data(), x.size());
  _solve_impl(b, same);
}

}  // namespace Eigen
