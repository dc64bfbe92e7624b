#include "show.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "chains.h"
#include "course/film.h"
#include "geometry/rotation.h"

using namespace rex;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kFrames = 90;
const Color kRed{0.8f, 0.15f, 0.1f}, kGreen{0.1f, 0.6f, 0.25f}, kBlue{0.1f, 0.35f, 0.75f};

// The columns of A as arrows from p, unless they are still zero.
void addArrows(Picture& picture, const Eigen::Matrix3d& A, const Eigen::Vector3d& p, double radius) {
  const Color colors[] = {kRed, kGreen, kBlue};
  for (int k = 0; k < 3; ++k)
    if (A.col(k).norm() > 0.5) picture.arrows.push_back({p, p + A.col(k), colors[k], radius});
}

Picture emptyPicture() {
  Picture picture;
  picture.ground.visible = false;
  return picture;
}

// How fast a frame turns from A to B in the time dt [rad/s].
double speedOf(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B, double dt) {
  return rotationVector(A.transpose() * B).norm() / dt;
}

}  // namespace

Chain chainOf(const Simulator& S, const std::string& body) { return chainOfRobot(S, body); }

void showTurns() {
  const Eigen::Vector3d start(-1.3, -1.25, 1.4), end(1.5, -0.75, -0.9);  // yaw, pitch, roll
  const Eigen::Matrix3d A = rotationFromRollPitchYaw(start.reverse()),
                        B = rotationFromRollPitchYaw(end.reverse());
  const Eigen::Vector4d a = quaternionFromRotation(A), b = quaternionFromRotation(B);
  Film film;
  std::vector<Eigen::Vector3d> ways[2];
  std::vector<Eigen::Matrix3d> turned[2];
  for (int k = 0; k <= kFrames; ++k) {
    const double share = static_cast<double>(k) / kFrames;
    const Eigen::Vector4d q = between(a, b, share);
    if (q.norm() < 0.5) return;
    turned[0].push_back(rotationFromQuaternion(q));
    turned[1].push_back(eulerMatrix(Convention::kYawPitchRoll, start + share * (end - start)));
    Picture picture = emptyPicture();
    for (int side = 0; side < 2; ++side) {
      const Eigen::Vector3d at(side == 0 ? -1.3 : 1.3, 0, 0);
      addArrows(picture, turned[side].back(), at, 0.035);
      ways[side].push_back(at + turned[side].back().col(0));
      if (k > 0) picture.polylines.push_back({ways[side], kRed, 3});
      picture.labels.push_back({side == 0 ? "between" : "Euler angles", at - Eigen::Vector3d(0.25, 0, 1)});
    }
    film.push_back({share * 3, std::move(picture)});
  }
  // From afar, so that both are seen from the same direction.
  Camera camera = lookAt({0, -14, 12}, {0, 0, 0.05});
  camera.verticalFov = 0.14;
  writeFilm(film, "turns", {.camera = camera, .width = 800, .height = 400});

  Figure figure{.title = "Speed of the frame on two paths between the same orientations",
                .xLabel = "share of the path [1]",
                .yLabel = "angular speed [rad/s]"};
  for (int side = 0; side < 2; ++side) {
    Series speed{.label = side == 0 ? "between" : "Euler angles"};
    for (std::size_t k = 1; k < turned[side].size(); ++k) {
      speed.x.push_back((static_cast<double>(k) - 0.5) / kFrames);
      speed.y.push_back(speedOf(turned[side][k - 1], turned[side][k], 3. / kFrames));
    }
    figure.series.push_back(std::move(speed));
  }
  plot("turns", figure);
}

void showLock() {
  Film film;
  for (int k = 0; k <= 2; ++k) {
    const Eigen::Vector3d angles(0.4, k * kPi / 4, 0);
    const Eigen::Matrix3d A = turningAxes(Convention::kYawPitchRoll, angles),
                          R = eulerMatrix(Convention::kYawPitchRoll, angles);
    if (A.col(0).norm() < 0.5 || R.col(0).norm() < 0.5) return;
    Picture picture = emptyPicture();
    // The frame is a plane that flies along its x axis; the axes of yaw and roll are drawn in both
    // directions.
    Solid plane{.color = {0.75f, 0.77f, 0.8f, 0.6f}};
    plane.shape.type = ShapeType::kBox;
    plane.shape.extent = {1.2, 0.5, 0.08};
    plane.X_WS = {R, {0, 0, 0}};
    picture.solids.push_back(plane);
    const std::pair<const char*, Color> axes[] = {{"yaw", kBlue}, {"pitch", kGreen}, {"roll", kRed}};
    for (int i = 0; i < 3; ++i) {
      const double length = i == 2 ? 0.8 : 1;  // where axes coincide, both are seen
      picture.arrows.push_back(
          {-length * A.col(i), length * A.col(i), axes[i].second, i == 2 ? 0.045 : 0.03});
      picture.labels.push_back({axes[i].first, 1.12 * length * A.col(i), axes[i].second, 1.3});
    }
    picture.captions.push_back({.text = "pitch " + std::to_string(45 * k) + " degrees", .scale = 1.3});
    film.push_back({static_cast<double>(k), std::move(picture)});
  }
  writeFilmSheet(film, {.camera = framing(film, {1, -1, 0.5}, 1), .width = 420, .height = 420},
                 std::string("lock_sheet") + ".png", 3);

  Figure figure{.title = "Where Euler angles lock",
                .xLabel = "second angle [rad]",
                .yLabel = "smallest singular value of the axes [1]"};
  for (const Convention convention : {Convention::kYawPitchRoll, Convention::k313}) {
    const bool is313 = convention == Convention::k313;
    Series rank{.label = is313 ? "3-1-3" : "yaw, pitch, roll", .dashed = is313};
    for (int k = -60; k <= 120; ++k) {
      const double angle = k * kPi / 120;
      rank.x.push_back(angle);
      rank.y.push_back(svd(turningAxes(convention, {0.4, angle, -0.3})).s[2]);
    }
    figure.series.push_back(std::move(rank));
  }
  plot("lock", figure);
}

void showEllipse() {
  Simulator S("arm3.ors");
  const Chain arm = chainOf(S, "eff");
  const Eigen::Vector3d tip(0, 0, 0.15);
  constexpr double kScale = 0.35;  // metres of the picture for a metre per second
  std::vector<Eigen::VectorXd> postures;
  for (int k = 0; k <= kFrames; ++k) {
    const double bend = 0.5 * (1 + std::cos(kPi * k / kFrames));
    postures.push_back(Eigen::Vector3d(-1.6 + 1.2 * bend, -1.9 * bend, -1.4 * bend));
  }
  Film film = makeFilm(S, postures, {});
  Figure figure{.title = "What unit velocities of the joints move the tip",
                .xLabel = "share of the motion [1]",
                .yLabel = "radius [m/s]",
                .series = {{.label = "longest radius"}, {.label = "second radius"}}};
  std::size_t k = 0;
  for (const Eigen::VectorXd& q : postures) {
    const Manipulability all = manipulability(pointJacobian(arm, q, tip));
    if (all.axes.rows() != 3 || all.radii.size() != 3 || !isRotation(all.axes * all.axes.determinant()))
      return;
    S.setJointAngles(q);
    // The arm moves in a plane, so the third radius is zero; the picture shows it as a thin disc.
    const Eigen::Vector3d radii = (kScale * all.radii).cwiseMax(0.004);
    film[std::min(k, film.size() - 1)].picture.ellipsoids.push_back(
        {{all.axes * all.axes.determinant(), S.kinematicsPos("eff", tip)}, radii});
    for (int i = 0; i < 2; ++i) {
      figure.series[static_cast<std::size_t>(i)].x.push_back(static_cast<double>(k) / kFrames);
      figure.series[static_cast<std::size_t>(i)].y.push_back(all.radii[i]);
    }
    ++k;
  }
  writeFilm(film, "ellipse", {.camera = framing(film, {1, -0.15, 0.1}, 1), .width = 400, .height = 400});
  plot("ellipse", figure);
}
