// QR decompositions.
#define REX_QR_INSTANCE template
#include "base/eigen_instances.h"

namespace Eigen {

// The same memory as a Map, a type of result for which nothing is specialised.
template <>
template <>
void HouseholderSequence<MatrixXd, VectorXd, OnTheLeft>::evalTo(MatrixXd& out) const {
  out.resize(rows(), rows());
  Map<MatrixXd> same(out.data(), out.rows(), out.cols());
  evalTo(same);
}

}  // namespace Eigen
