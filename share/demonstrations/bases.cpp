// Chapter 7: System equations of mobile bases. Five bases get the same command, speeds ahead and to the left
// and a turning rate, and each follows what it can; grey is what was asked for. A quadrotor, seen from the
// side, must tilt before it moves; LQR keeps its height. Dots are runs with the noise of the model, green
// ellipses what a Kalman filter predicts. Drive them with the sliders.
// Slides: 7:5, 7:6
// Formula: x' = f(x, u); a car: (v cos θ, v sin θ, v tan φ / L); a quadrotor: x'' = -F sin θ / m
// Try: Five bases follow the same command as far as they can. The samples bend around the ellipse of a
// Kalman filter. With "speed ahead" 0 and "speed to the left" 1, only the omnidirectional base follows.
// Change the sign of "speed ahead": the quadrotor tilts first.
#include "control/regulators.h"
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "estimation/kalman_filter.h"
#include "estimation/motion_model.h"
#include "render/picture.h"
#include "systems/mobile_bases.h"
#include "systems/planar_quadrotor.h"

using namespace rex;

constexpr double kStep = 1 / 30.;

// A quadrotor whose control is the speed ahead: LQR follows it and keeps the height. How far it has flown
// does not matter to the others of its six numbers.
MotionModel flown(const PlanarQuadrotor& quadrotor, double height) {
  const MotionModel free = motionModel(quadrotor);
  const Eigen::Vector2d hover = hoverThrusts(quadrotor);
  const StepJacobians at = stepJacobians(free, Eigen::VectorXd::Zero(6), hover, kStep);
  const Eigen::VectorXd costs{{4, 1, 4, 1, 0.1}};
  const Eigen::MatrixXd K = lqr({.A = at.A.bottomRightCorner(5, 5), .B = at.B.bottomRows(5), .step = kStep},
                                costs.asDiagonal().toDenseMatrix(), Eigen::Matrix2d::Identity())
                                .K;
  const auto thrusts = [=](const VectorArg& x, const VectorArg& u) -> Eigen::VectorXd {
    Eigen::VectorXd error = x.tail(5);
    error[0] -= height, error[2] -= u[0];
    return hover - K * error;
  };
  return {.states = 6,
          .controls = 1,
          .f = [=](const VectorArg& x, const VectorArg& u, double dt) -> Eigen::VectorXd {
            return free.f(x, thrusts(x, u), dt);
          },
          .noise = [=](const VectorArg& x, const VectorArg& u, double dt) -> Eigen::MatrixXd {
            return free.noise(x, thrusts(x, u), dt);
          }};
}

struct Base {
  const char* name;
  double x, y;  // where it starts
  Gaussian belief{};
  Eigen::MatrixXd runs{};
  Eigen::Vector3d asked{};
  Polyline way{}, askedWay{};
};

int main() {
  LiveView view("bases");
  view.lookFrom({0, -0.3, 1});
  Base bases[] = {{"differential drive", 0, 4.5}, {"omnidirectional", 5, 4.5},
                  {"slipping unicycle", 10, 4.5}, {"car", 1.5, 0},
                  {"car with trailer", 8, 0},     {"quadrotor", 12, 0}};
  const BaseTwist all{3, [](const VectorArg& u) { return Eigen::Vector3d(u); },
                      [](const VectorArg&) { return Eigen::Matrix3d::Identity(); }};
  const MotionModel obeying = planarMotion(all);
  constexpr double kRadius = 0.2, kHalf = 0.4;  // of wheels, and from them to the centre
  Rng rng(1);
  int clock = 0;
  for (int t = 0; t < 300 || view.isWatched(); ++t, ++clock) {
    const double ahead = view.slider("speed ahead [m/s]", -1, 1, 1),
                 left = view.slider("speed to the left [m/s]", -1, 1, 0.2),
                 turn = view.slider("turning rate [rad/s]", -1, 1, 0.35),
                 slip = view.slider("slip of the unicycle", 0, 0.5, 0.2);
    const BaseNoise noise{.travel = view.slider("noise of the controls", 0, 0.4, 0.2)};
    if (view.button("from the start") || clock == 150) clock = 0;
    const auto wheelAt = [&](double degrees) {
      const double a = degrees * M_PI / 180;
      return (kHalf * turn - std::sin(a) * ahead + std::cos(a) * left) / kRadius;
    };
    const double steering = ahead == 0 ? 0 : std::clamp(std::atan(turn / ahead), -0.7, 0.7);
    const std::pair<MotionModel, Eigen::VectorXd> moves[] = {
        {motionModel(DifferentialDrive{kRadius, 2 * kHalf}, noise),
         Eigen::Vector2d(ahead - kHalf * turn, ahead + kHalf * turn) / kRadius},
        {motionModel(OmnidirectionalBase{kRadius, kHalf}, noise),
         Eigen::Vector3d(wheelAt(60), wheelAt(180), wheelAt(300))},
        {motionModel(SlippingUnicycle{slip, slip}, noise), Eigen::Vector2d(ahead, turn)},
        {motionModel(Car{1}, noise), Eigen::Vector2d(ahead, steering)},
        {motionModel(CarWithTrailer{{1}, 1}, noise), Eigen::Vector2d(ahead, steering)},
        {flown({.inertia = 0.02, .arm = 0.4, .gust = noise.travel, .tumble = noise.travel}, bases[5].y),
         Eigen::VectorXd::Constant(1, ahead)}};
    Picture picture{.ground = {.cell = 1}};
    for (int k = 0; k < 6; ++k) {
      Base& base = bases[k];
      const auto& [model, u] = moves[k];
      if (clock == 0) {
        Eigen::VectorXd x = Eigen::VectorXd::Zero(model.states);
        x.head<2>() << base.x, base.y;
        base.belief = {x, Eigen::MatrixXd::Zero(model.states, model.states)};
        base.runs = x.replicate(1, 120);
        base.asked = x.head<3>();
        base.way = {.color = kEstimateColor}, base.askedWay = {.color = {0.6f, 0.6f, 0.62f}, .width = 4};
      } else {
        base.belief = extendedPredict(base.belief, transitionModel(model, base.belief.mean, u, kStep));
        for (auto run : base.runs.colwise()) run = moved(model, run, u, kStep, rng);
        base.asked =
            meanAfter(obeying, base.asked,
                      k == 5 ? Eigen::Vector3d(ahead, 0, 0) : Eigen::Vector3d(ahead, left, turn), kStep);
      }
      const Eigen::VectorXd& x = base.belief.mean;
      if (clock % 5 == 0) {
        base.way.points.emplace_back(x[0], x[1], 0.03);
        base.askedWay.points.emplace_back(base.asked[0], base.asked[1], 0.02);
      }
      picture.polylines.insert(picture.polylines.end(), {base.way, base.askedWay});
      PointSet cloud{.color = kDeadReckoningColor, .size = 3};
      for (const auto& run : base.runs.colwise()) cloud.points.emplace_back(run[0], run[1], 0.05);
      picture.pointSets.push_back(cloud);
      Eigen::Matrix3d flat = 1e-4 * Eigen::Matrix3d::Identity();
      flat.topLeftCorner<2, 2>() += base.belief.covariance.topLeftCorner<2, 2>();
      picture.ellipsoids.push_back(covarianceEllipsoid({x[0], x[1], 0.04}, flat, 2, {0, 0.62f, 0.45f, 0.5f}));
      // A box of that size around (at, aside) in the frame of the base, which is turned by an angle.
      const auto box = [&](double heading, double at, double aside, double angle, Eigen::Vector3d size,
                           Color color) {
        const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
        picture.solids.push_back({{.type = ShapeType::kBox, .extent = size},
                                  translation(x[0], x[1], 0.2) * rotation(heading, up) *
                                      translation(at, aside, 0) * rotation(angle, up),
                                  color,
                                  base.name});
      };
      const auto wheel = [&](double at, double aside, double angle) {
        box(x[2], at, aside, angle, {0.4, 0.12, 0.4}, kTruthColor);
      };
      const Color pale{0.45f, 0.68f, 0.83f, 0.6f};
      if (k == 5)
        for (const double at : {-0.4, 0.4}) box(x[2], at, 0.15, 0, {0.4, 0.05, 0.4}, kTruthColor);
      else if (k == 1)
        for (const double a : {60., 180., 300.})
          wheel(kHalf * std::cos(a * M_PI / 180), kHalf * std::sin(a * M_PI / 180),
                a * M_PI / 180 + M_PI / 2);
      else
        wheel(0, kHalf, 0), wheel(0, -kHalf, 0);
      if (k == 3 || k == 4) wheel(1, kHalf, u[1]), wheel(1, -kHalf, u[1]);
      if (k == 5)
        box(x[2], 0, 0, 0, {1, 0.15, 0.3}, pale);
      else
        box(x[2], k > 2 ? 0.5 : 0.1, 0, 0, {k > 2 ? 1.6 : 0.8, 0.6, 0.3}, pale);
      if (k == 4) box(x[3], -0.9, 0, 0, {1, 0.7, 0.3}, pale);
      picture.labels.push_back({.text = base.name, .p_WQ = {base.x - 0.8, base.y - 0.8, 0}, .scale = 1.2});
      const Eigen::MatrixXd off = base.runs.topRows(2).colwise() - base.runs.topRows(2).rowwise().mean();
      if (k == 0 || k == 1 || k == 3)
        view.plot(std::string("spread [m]: ") + base.name, t / 30., off.norm() / std::sqrt(120.));
    }
    view.show(picture);
  }
}
