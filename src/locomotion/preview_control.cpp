#include "locomotion/preview_control.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::RowVector3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kMostSteps = 1e5;

void requireOptions(const PreviewOptions& options) {
  requirePositive("preview control: height", options.height);
  requirePositive("preview control: g", options.g);
  requirePositive("preview control: step", options.step);
  requirePositive("preview control: preview", options.preview);
  requirePositive("preview control: weight Qe", options.Qe);
  requirePositive("preview control: weight R", options.R);
  const double steps = std::round(options.preview / options.step);
  if (!(steps >= 1 && steps <= kMostSteps))
    throw Error({.what = "preview control: preview",
                 .found = fmt::format("{:g} steps", steps),
                 .wanted = fmt::format("1 to {:g}", kMostSteps)});
}

// The cart on a table: x_{k+1} = A x_k + B u_k, p_k = C x_k.
struct Cart {
  Matrix3d A;
  Vector3d B;
  RowVector3d C;

  explicit Cart(const PreviewOptions& options) {
    const double h = options.step;
    A << 1, h, h * h / 2, 0, 1, h, 0, 0, 1;
    B << h * h * h / 6, h * h / 2, h;
    C << 1, 0, -options.height / options.g;
  }
};

}  // namespace

PreviewGains previewGains(const PreviewOptions& options) {
  requireOptions(options);
  const Cart cart(options);
  // The system of the error of p and the changes of x, driven by changes of u: there a constant error costs
  // without end.
  Matrix4d A = Matrix4d::Zero(), Q = Matrix4d::Zero();
  A(0, 0) = 1;
  A.topRightCorner<1, 3>() = cart.C * cart.A;
  A.bottomRightCorner<3, 3>() = cart.A;
  Vector4d B;
  B << cart.C * cart.B, cart.B;
  Q(0, 0) = options.Qe;
  const RiccatiResult riccati = solveDare(A, B, Q, Eigen::MatrixXd::Constant(1, 1, options.R));
  PreviewGains gains{.status = riccati.status, .message = riccati.message};
  if (riccati.status != RiccatiStatus::kSolved) return gains;
  const Matrix4d X = riccati.X;
  gains.Gi = riccati.K(0, 0);
  gains.Gx = riccati.K.rightCols<3>();
  const double weight = options.R + B.dot(X * B);
  const Matrix4d loop = A - B * riccati.K;
  gains.Gp.resize(std::lround(options.preview / options.step));
  // What a change of the reference adds to the cost, step by step backwards in time.
  Vector4d ahead = X.col(0);
  for (double& gain : gains.Gp) {
    gain = B.dot(ahead) / weight;
    ahead = (loop.transpose() * ahead).eval();
  }
  return gains;
}

PreviewMotion followZmp(const Eigen::Ref<const Eigen::Matrix2Xd>& reference, const PreviewOptions& options) {
  const Eigen::Index count = reference.cols();
  if (count == 0)
    throw Error({.what = "preview control: reference", .found = "no columns", .wanted = "at least one"});
  for (const auto& column : reference.colwise()) requireFinite("preview control: reference", column);
  const PreviewGains gains = previewGains(options);
  PreviewMotion motion{.status = gains.status, .message = gains.message};
  if (gains.status != RiccatiStatus::kSolved) return motion;
  const Cart cart(options);
  for (Eigen::Matrix2Xd* track : {&motion.c, &motion.v, &motion.a, &motion.zmp}) track->resize(2, count);
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    // Relative to the start, so that positions far away lose no digits.
    const double start = reference(axis, 0);
    Vector3d x = Vector3d::Zero(), change = Vector3d::Zero();
    double u = 0;
    for (Eigen::Index k = 0; k < count; ++k) {
      const double p = cart.C * x, error = p - (reference(axis, k) - start);
      motion.c(axis, k) = start + x[0];
      motion.v(axis, k) = x[1];
      motion.a(axis, k) = x[2];
      motion.zmp(axis, k) = start + p;
      motion.largestError = std::max(motion.largestError, std::abs(error));
      u -= gains.Gi * error + gains.Gx * change;
      for (Eigen::Index j = 0; j < gains.Gp.size() && k + j + 1 < count; ++j)
        u += gains.Gp[j] * (reference(axis, k + j + 1) - reference(axis, k + j));
      const Vector3d next = cart.A * x + cart.B * u;
      change = next - x;
      x = next;
    }
  }
  return motion;
}

}  // namespace rex
