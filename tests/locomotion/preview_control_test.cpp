#include <cmath>

#include <Eigen/QR>

#include "base/rng.h"
#include "locomotion/walking_pattern.h"
#include "support/expect_error.h"

namespace rex::preview_control_test {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// They take g = 9.8.
TEST(PreviewGains, AreTheKnownOnes) {
  const PreviewGains gains = previewGains({.g = 9.8});
  ASSERT_EQ(gains.status, RiccatiStatus::kSolved) << gains.message;
  EXPECT_NEAR(gains.Gi, 618.556392, 5e-7);
  EXPECT_NEAR(gains.Gx[0], 72738.06965, 5e-6);
  EXPECT_NEAR(gains.Gx[1], 21565.61408, 5e-6);
  EXPECT_NEAR(gains.Gx[2], 177.0885579, 5e-8);
  ASSERT_EQ(gains.Gp.size(), 320);
  EXPECT_DOUBLE_EQ(gains.Gp[0], gains.Gi);
}

// At rest anywhere nothing shall happen: what the state asks for, the preview gives back.
TEST(PreviewGains, BalanceAConstantReference) {
  const PreviewGains gains = previewGains({.preview = 8});
  EXPECT_NEAR(gains.Gp.sum(), gains.Gx[0], 1e-6 * gains.Gx[0]);
}

// The same problem as one dense least squares problem in all changes of the jerk.
VectorXd denseZmp(const VectorXd& reference, const PreviewOptions& options) {
  const Index count = reference.size();
  const double h = options.step;
  MatrixXd toZmp = MatrixXd::Zero(count, count);  // from changes of u to p
  for (Index j = 0; j < count; ++j) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (Index k = j; k < count; ++k) {
      toZmp(k, j) = x[0] - options.height / options.g * x[2];
      x = Eigen::Vector3d(x[0] + h * x[1] + h * h / 2 * x[2] + h * h * h / 6, x[1] + h * x[2] + h * h / 2,
                          x[2] + h);
    }
  }
  MatrixXd weighted(2 * count, count);
  weighted << std::sqrt(options.Qe) * toZmp, std::sqrt(options.R) * MatrixXd::Identity(count, count);
  VectorXd wanted = VectorXd::Zero(2 * count);
  wanted.head(count) = std::sqrt(options.Qe) * (reference.array() - reference[0]);
  const VectorXd changes = weighted.householderQr().solve(wanted);
  return (toZmp * changes).array() + reference[0];
}

TEST(FollowZmp, IsTheOptimumOfTheDenseProblem) {
  const PreviewOptions options{.step = .02, .preview = 6, .R = 1e-5};
  const Index count = 450;
  Matrix2Xd reference(2, count);
  for (Index k = 0; k < count; ++k)
    reference.col(k) << .3 * std::floor(static_cast<double>(k) / 40), k / 25 % 2 == 0 ? -.1 : .1;
  reference.rightCols(250).colwise() = Eigen::Vector2d(reference(0, 199), 0);
  const PreviewMotion motion = followZmp(reference, options);
  ASSERT_EQ(motion.status, RiccatiStatus::kSolved);
  for (Index axis = 0; axis < 2; ++axis) {
    const VectorXd dense = denseZmp(reference.row(axis).transpose(), options);
    // The dense problem ends, so its last seconds differ.
    EXPECT_LT((motion.zmp.row(axis).transpose() - dense).head(250).cwiseAbs().maxCoeff(), 1e-6) << axis;
    EXPECT_GT((reference.row(axis).transpose() - dense).head(250).cwiseAbs().maxCoeff(), 1e-3) << axis;
  }
}

TEST(FollowZmp, MovesByItsOwnAccelerations) {
  Matrix2Xd reference = Matrix2Xd::Zero(2, 800);
  reference.block(0, 300, 2, 500).setConstant(.2);
  reference.array() += 7;
  const PreviewOptions options;
  const PreviewMotion motion = followZmp(reference, options);
  ASSERT_EQ(motion.status, RiccatiStatus::kSolved);
  const double h = options.step;
  for (Index k = 0; k + 1 < 800; ++k) {
    const Eigen::Vector2d jerk = (motion.a.col(k + 1) - motion.a.col(k)) / h;
    EXPECT_LT((motion.v.col(k) + h * motion.a.col(k) + h * h / 2 * jerk - motion.v.col(k + 1)).norm(), 1e-12);
    EXPECT_LT((motion.c.col(k) - options.height / options.g * motion.a.col(k) - motion.zmp.col(k)).norm(),
              1e-12);
  }
  EXPECT_LT((motion.c.col(0) - reference.col(0)).norm(), 1e-15);
  EXPECT_LT((motion.c.col(799) - reference.col(799)).norm(), 1e-4);
  EXPECT_LT(motion.v.col(799).norm(), 1e-4);
  EXPECT_NEAR(motion.largestError, (motion.zmp - reference).cwiseAbs().maxCoeff(), 1e-14);
  // The centre of mass moves before the reference does: without preview it could not.
  EXPECT_GT(motion.c(0, 299), 7.02);
  const PreviewMotion blind = followZmp(reference, {.preview = .005});
  EXPECT_GT(blind.largestError, 1.1 * motion.largestError);
}

TEST(PreviewControl, NamesWhatIsWrong) {
  EXPECT_REX_ERROR(previewGains({.height = -1}),
                   "preview control: height: found -1, wanted a positive, finite number");
  EXPECT_REX_ERROR(previewGains({.g = 0}), "preview control: g: found 0");
  EXPECT_REX_ERROR(previewGains({.step = NAN}), "preview control: step: found nan");
  EXPECT_REX_ERROR(previewGains({.preview = 0}), "preview control: preview: found 0");
  EXPECT_REX_ERROR(previewGains({.Qe = 0}), "preview control: weight Qe: found 0");
  EXPECT_REX_ERROR(previewGains({.R = 0}), "preview control: weight R: found 0");
  EXPECT_REX_ERROR(previewGains({.preview = 1e-3}),
                   "preview control: preview: found 0 steps, wanted 1 to 100000");
  EXPECT_REX_ERROR(followZmp(Matrix2Xd(2, 0), {}), "preview control: reference: found no columns");
  EXPECT_REX_ERROR(followZmp(Matrix2Xd::Constant(2, 3, NAN), {}), "preview control: reference: number 0");
}

}  // namespace rex::preview_control_test
