// Products, and solutions of triangular systems.
#define REX_PRODUCT_INSTANCE template
#include "base/eigen_instances.h"

namespace Eigen::internal {

// Eigen's own product: the same memory as a Map, a type of result for which nothing is specialised.
#define REX_DEFINE(Result, Left, Right)                                                              \
  template <>                                                                                        \
  template <>                                                                                        \
  void generic_product_impl<Left, Right, DenseShape, DenseShape>::evalTo(Result& out, const Left& a, \
                                                                         const Right& b) {           \
    Map<Result> same(out.data(), out.rows(), out.cols());                                            \
    evalTo(same, a, b);                                                                              \
  }                                                                                                  \
  template <>                                                                                        \
  template <>                                                                                        \
  void generic_product_impl<Left, Right, DenseShape, DenseShape>::addTo(Result& out, const Left& a,  \
                                                                        const Right& b) {            \
    Map<Result> same(out.data(), out.rows(), out.cols());                                            \
    addTo(same, a, b);                                                                               \
  }                                                                                                  \
  template <>                                                                                        \
  template <>                                                                                        \
  void generic_product_impl<Left, Right, DenseShape, DenseShape>::subTo(Result& out, const Left& a,  \
                                                                        const Right& b) {            \
    Map<Result> same(out.data(), out.rows(), out.cols());                                            \
    subTo(same, a, b);                                                                               \
  }
REX_MATRIX_PRODUCTS(REX_DEFINE)
#undef REX_DEFINE

#define REX_DEFINE(Left)                                                                         \
  template <>                                                                                    \
  template <>                                                                                    \
  void generic_product_impl<Left, VectorXd, DenseShape, DenseShape, GemvProduct>::scaleAndAddTo( \
      VectorXd& out, const Left& a, const VectorXd& b, const double& factor) {                   \
    Map<VectorXd> same(out.data(), out.size());                                                  \
    scaleAndAddTo(same, a, b, factor);                                                           \
  }
REX_VECTOR_PRODUCTS(REX_DEFINE)

}  // namespace Eigen::internal
