#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

// The code behind Eigen's products and decompositions of matrices of dynamic size is compiled once. Each of
// the files eigen_*.cpp instantiates one of these groups. A source file that sees these declarations calls
// it; any other compiles its own, which takes seconds. Members of classes that are themselves templates must
// be listed one by one.
#ifndef REX_LU_INSTANCE
#define REX_LU_INSTANCE extern template
#endif
#ifndef REX_QR_INSTANCE
#define REX_QR_INSTANCE extern template
#endif
#ifndef REX_SVD_INSTANCE
#define REX_SVD_INSTANCE extern template
#endif
#ifndef REX_SCHUR_INSTANCE
#define REX_SCHUR_INSTANCE extern template
#endif
#ifndef REX_PRODUCT_INSTANCE
#define REX_PRODUCT_INSTANCE extern template
#endif

namespace Eigen {
namespace internal {

// Products of whole matrices are specialised at the point where Eigen looks at their sizes and chooses a
// blocked product, one with a vector, or one coefficient by coefficient. Each would take half a second to
// compile, and students wait for that: without these, solutions compile a fifth longer.
using Transposed = Transpose<const MatrixXd>;
using TransposedValue = Transpose<MatrixXd>;
using RowMatrix = Matrix<double, Dynamic, Dynamic, RowMajor>;
using TwoFactors = Product<MatrixXd, MatrixXd>;
using FirstTransposed = Product<Transposed, MatrixXd>;
using ThreeFactors = Product<TwoFactors, Transposed>;
#define REX_MATRIX_PRODUCTS(PRODUCT)           \
  PRODUCT(MatrixXd, MatrixXd, MatrixXd)        \
  PRODUCT(MatrixXd, Transposed, MatrixXd)      \
  PRODUCT(MatrixXd, TransposedValue, MatrixXd) \
  PRODUCT(MatrixXd, MatrixXd, Transposed)      \
  PRODUCT(MatrixXd, TwoFactors, MatrixXd)      \
  PRODUCT(MatrixXd, TwoFactors, Transposed)    \
  PRODUCT(RowMatrix, TwoFactors, Transposed)   \
  PRODUCT(MatrixXd, FirstTransposed, MatrixXd) \
  PRODUCT(MatrixXd, ThreeFactors, MatrixXd)
#define REX_DECLARE(Result, Left, Right)                                                                     \
  template <>                                                                                                \
  template <>                                                                                                \
  void generic_product_impl<Left, Right, DenseShape, DenseShape>::evalTo(Result&, const Left&,               \
                                                                         const Right&);                      \
  template <>                                                                                                \
  template <>                                                                                                \
  void generic_product_impl<Left, Right, DenseShape, DenseShape>::addTo(Result&, const Left&, const Right&); \
  template <>                                                                                                \
  template <>                                                                                                \
  void generic_product_impl<Left, Right, DenseShape, DenseShape>::subTo(Result&, const Left&, const Right&);
REX_MATRIX_PRODUCTS(REX_DECLARE)
#undef REX_DECLARE

// Products with vectors.
#define REX_VECTOR_PRODUCTS(PRODUCT) \
  PRODUCT(MatrixXd)                  \
  PRODUCT(Transposed)                \
  PRODUCT(TransposedValue)
#define REX_DECLARE(Left)                                                                        \
  template <>                                                                                    \
  template <>                                                                                    \
  void generic_product_impl<Left, VectorXd, DenseShape, DenseShape, GemvProduct>::scaleAndAddTo( \
      VectorXd&, const Left&, const VectorXd&, const double&);
REX_VECTOR_PRODUCTS(REX_DECLARE)
#undef REX_DECLARE

}  // namespace internal

// Members that are defined within their class would be compiled wherever they are called: specialised
// instead.
template <>
template <>
void HouseholderSequence<MatrixXd, VectorXd, OnTheLeft>::evalTo(MatrixXd&) const;
template <>
template <>
void PartialPivLU<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
template <>
template <>
void PartialPivLU<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;

REX_LU_INSTANCE class LLT<MatrixXd>;
REX_LU_INSTANCE LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
REX_LU_INSTANCE class LDLT<MatrixXd>;
REX_LU_INSTANCE LDLT<MatrixXd>& LDLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
REX_LU_INSTANCE class PartialPivLU<MatrixXd>;
REX_LU_INSTANCE class FullPivLU<MatrixXd>;
REX_LU_INSTANCE void LLT<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
REX_LU_INSTANCE void LLT<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
REX_LU_INSTANCE void LDLT<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
REX_LU_INSTANCE void LDLT<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;

REX_QR_INSTANCE class HouseholderQR<MatrixXd>;
REX_QR_INSTANCE class ColPivHouseholderQR<MatrixXd>;
REX_QR_INSTANCE class CompleteOrthogonalDecomposition<MatrixXd>;
REX_QR_INSTANCE void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
REX_QR_INSTANCE void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
REX_QR_INSTANCE void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;

REX_SVD_INSTANCE class JacobiSVD<MatrixXd>;
REX_SVD_INSTANCE class SelfAdjointEigenSolver<MatrixXd>;
REX_SVD_INSTANCE SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(
    const EigenBase<MatrixXd>&, int);
REX_SVD_INSTANCE SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(
    const EigenBase<Ref<const MatrixXd>>&, int);

REX_SCHUR_INSTANCE class EigenSolver<MatrixXd>;
REX_SCHUR_INSTANCE EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
REX_SCHUR_INSTANCE class RealSchur<MatrixXd>;
REX_SCHUR_INSTANCE RealSchur<MatrixXd>& RealSchur<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);

namespace internal {

REX_LU_INSTANCE double rcond_estimate_helper(double, const PartialPivLU<MatrixXd>&);

using Mapper = blas_data_mapper<double, Index, ColMajor>;
using Columns = const_blas_data_mapper<double, Index, ColMajor>;
using Rows = const_blas_data_mapper<double, Index, RowMajor>;
using Kernel = gebp_traits<double, double>;

REX_PRODUCT_INSTANCE struct gebp_kernel<double, double, Index, Mapper, Kernel::mr, Kernel::nr, false, false>;
REX_PRODUCT_INSTANCE struct gemm_pack_lhs<double, Index, Columns, Kernel::mr, Kernel::LhsProgress,
                                          Kernel::LhsPacket4Packing, ColMajor>;
REX_PRODUCT_INSTANCE struct gemm_pack_lhs<double, Index, Rows, Kernel::mr, Kernel::LhsProgress,
                                          Kernel::LhsPacket4Packing, RowMajor>;
REX_PRODUCT_INSTANCE struct gemm_pack_rhs<double, Index, Columns, Kernel::nr, ColMajor>;
REX_PRODUCT_INSTANCE struct gemm_pack_rhs<double, Index, Rows, Kernel::nr, RowMajor>;
// Matrix-vector products, for vectors with and without gaps between their entries.
REX_PRODUCT_INSTANCE struct general_matrix_vector_product<Index, double, Columns, ColMajor, false, double,
                                                          Columns, false>;
REX_PRODUCT_INSTANCE struct general_matrix_vector_product<Index, double, Columns, ColMajor, false, double,
                                                          Rows, false>;
REX_PRODUCT_INSTANCE struct general_matrix_vector_product<Index, double, Rows, RowMajor, false, double,
                                                          Columns, false>;
REX_PRODUCT_INSTANCE struct general_matrix_vector_product<Index, double, Rows, RowMajor, false, double, Rows,
                                                          false>;
REX_PRODUCT_INSTANCE struct general_matrix_vector_product<Index, double, Rows, RowMajor, false, double,
                                                          Columns, false, 1>;
REX_PRODUCT_INSTANCE struct general_matrix_vector_product<Index, double, Rows, RowMajor, false, double, Rows,
                                                          false, 1>;

REX_PRODUCT_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, Lower, false, ColMajor,
                                                    ColMajor, 1>;
REX_PRODUCT_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor,
                                                    ColMajor, 1>;
REX_PRODUCT_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, Lower, false, RowMajor,
                                                    ColMajor, 1>;
REX_PRODUCT_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, RowMajor,
                                                    ColMajor, 1>;
REX_PRODUCT_INSTANCE struct triangular_solve_matrix<double, Index, OnTheRight, Lower, false, ColMajor,
                                                    ColMajor, 1>;
REX_PRODUCT_INSTANCE struct triangular_solve_matrix<double, Index, OnTheRight, Upper, false, RowMajor,
                                                    ColMajor, 1>;
REX_PRODUCT_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor,
                                                    ColMajor, 1>;
REX_PRODUCT_INSTANCE struct triangular_solve_matrix<double, Index, OnTheLeft, UnitUpper, false, RowMajor,
                                                    ColMajor, 1>;

}  // namespace internal
}  // namespace Eigen
