// Chapter 6: Gaussians and particles as beliefs. Prior (blue) times likelihood (orange) is the posterior
// (green); particles of the prior get weights, shown as size. Sliders set both; with few particles in the
// overlap, few count.
// Slides: 6:28, 6:30, 6:31
// Formula: N(x|a, A) N(x|b, B) ~ N(x|c, C) with C = (A⁻¹ + B⁻¹)⁻¹, c = C (A⁻¹ a + B⁻¹ b)
// Try: Prior times likelihood is the posterior. Narrow the likelihood: few particles keep weight.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "estimation/gaussian.h"
#include "estimation/particle_filter.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("gaussians");
  view.lookFrom({0, -0.25, 1});
  Rng rng(1);
  const Gaussian unit{.mean = Eigen::Vector2d::Zero(), .covariance = Eigen::Matrix2d::Identity()};
  const Eigen::MatrixXd draws = sampledParticles(unit, 400, rng).states;
  for (int t = 0; t < 240 || view.isWatched(); ++t) {
    const double far = view.slider("likelihood moves by [m]", 0, 5, 3),
                 wide = view.slider("width of the likelihood [m]", 0.2, 2, 0.6);
    const double a = view.slider("prior along x [m]", 0.3, 3, 1.8),
                 b = view.slider("prior along y [m]", 0.3, 3, 0.9);
    const double turn = view.slider("turn of the likelihood [rad]", -1.6, 1.6, 0.7);
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(turn).toRotationMatrix();
    const Eigen::Matrix2d noise =
        R * Eigen::Vector2d(4 * wide * wide, wide * wide).asDiagonal() * R.transpose();
    const Gaussian prior{.mean = Eigen::Vector2d::Zero(),
                         .covariance = Eigen::Vector2d(a * a, b * b).asDiagonal()};
    const Gaussian seen{.mean = Eigen::Vector2d(far * std::cos(t / 38.1972), far * std::sin(t / 38.1972) / 2),
                        .covariance = noise};
    const Gaussian posterior = multiplied(prior, seen).gaussian;

    Picture picture{.ground = {.visible = false}};
    const auto draw = [&](const Gaussian& one, Color color, const std::string& name, double z) {
      Eigen::Matrix3d flat = 1e-4 * Eigen::Matrix3d::Identity();
      flat.topLeftCorner<2, 2>() = one.covariance;
      const Eigen::Vector3d mean(one.mean[0], one.mean[1], z);
      color.a = 0.3f;
      picture.ellipsoids.push_back(covarianceEllipsoid(mean, flat, 2, color));
      picture.labels.push_back({.text = name, .p_WQ = mean + Eigen::Vector3d(0, 0, 0.1), .scale = 1.5});
    };
    draw(prior, kEstimateColor, "prior", 0);
    draw(seen, kDeadReckoningColor, "likelihood", 0.05);
    draw(posterior, kLandmarkColor, "posterior", 0.1);
    Eigen::VectorXd weights(draws.cols());
    std::vector<PointSet> sizes(5);
    for (int i = 0; i < draws.cols(); ++i)
      weights[i] = std::exp(-squaredMahalanobis(seen, Eigen::Vector2d(a * draws(0, i), b * draws(1, i))) / 2);
    for (int i = 0; i < draws.cols(); ++i)
      sizes[static_cast<std::size_t>(std::min(4., 5 * weights[i]))].points.push_back(
          {a * draws(0, i), b * draws(1, i), 0.15});
    for (int k = 0; k < 5; ++k)
      if (sizes[k].color = kTruthColor, sizes[k].size = 3 + 2.5 * k; !sizes[k].points.empty())
        picture.pointSets.push_back(sizes[k]);
    picture.polylines.push_back(
        {.points = {{-6, -4, 0}, {6, -4, 0}, {6, 4, 0}, {-6, 4, 0}, {-6, -4, 0}}, .color = kTruthColor});
    view.plot("particles that count", t / 30., weights.sum() * weights.sum() / weights.squaredNorm());
    view.plot("posterior's area / prior's", t / 30.,
              std::sqrt(posterior.covariance.determinant() / prior.covariance.determinant()));
    view.show(picture);
  }
}
