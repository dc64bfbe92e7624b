// Chapter 2: Rotations and gimbal lock. Left: three sliders turn a plane by yaw, pitch and roll; rings show
// the axes of the three. With a pitch of a quarter turn two of them coincide, and one direction is lost:
// gimbal lock. Right: two planes fly from a first orientation to that of the sliders and back, by quaternions
// and by Euler angles.
// Slides: 2:8
// Formula: R = Rz(yaw) Ry(pitch) Rx(roll)
// Try: On the left, a plane and the rings of its Euler angles; on the right, two planes that turn to its
// orientation and back, by quaternions and by Euler angles. Set "pitch" to a quarter turn, 1.57: two rings
// coincide, and "independence of the axes" drops to zero. By Euler angles the plane makes detours at
// varying speed.
#include <cmath>
#include <numbers>
#include <vector>

#include "course/course.h"
#include "course/live_view.h"
#include "geometry/rotation.h"
#include "render/picture.h"

using namespace rex;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
const Color kAxisColors[] = {{0.1f, 0.35f, 0.75f}, {0.1f, 0.6f, 0.25f}, {0.8f, 0.15f, 0.1f}};

void addPlane(Picture& picture, const Eigen::Matrix3d& R, const Vector3d& at, const Color& color) {
  for (const Vector3d& size :
       {Vector3d(1.2, 0.16, 0.12), Vector3d(0.3, 1.1, 0.04), Vector3d(0.2, 0.05, 0.3)}) {
    const bool isFin = size.z() > 0.2;
    picture.solids.push_back({.color = color});
    picture.solids.back().shape.extent = size;
    picture.solids.back().X_WS = {R, at + R * (isFin ? Vector3d(-0.5, 0, 0.18) : Vector3d(0, 0, 0))};
  }
}

// A ring around an axis, and the axis.
void addAxis(Picture& picture, const Vector3d& axis, double radius, const Color& color) {
  const Eigen::Matrix3d R = rotationBetween(Vector3d::UnitZ(), axis);
  Polyline ring{.color = color, .width = 4};
  for (int k = 0; k <= 60; ++k)
    ring.points.push_back(R * Vector3d(radius * std::cos(k * kPi / 30), radius * std::sin(k * kPi / 30), 0));
  picture.polylines.push_back(ring);
  picture.arrows.push_back({-radius * axis, 1.2 * radius * axis, color, 0.025});
}

int main() {
  LiveView view("rotations");
  view.lookFrom({0.5, -1, 0.5});
  const Vector3d start(-1.3, -1.25, 1.4);  // yaw, pitch, roll
  std::vector<Vector3d> ways[2];
  Eigen::Matrix3d before[2];
  Vector3d aim = start;
  for (int t = 0; t < 240 || view.isWatched(); ++t) {
    const Vector3d angles(view.slider("yaw [rad]", -3, 3, 0.8),
                          view.slider("pitch [rad]", -kPi / 2, kPi / 2, 1.2),
                          view.slider("roll [rad]", -3, 3, -0.6));
    const Eigen::Matrix3d R = rotationFromRollPitchYaw(angles.reverse());
    Picture picture{.ground = {.visible = false}};
    addPlane(picture, R, {0, 0, 0}, {0.75f, 0.77f, 0.8f});
    Eigen::Matrix3d axes;
    axes << Vector3d::UnitZ(), expSO3({0, 0, angles[0]}).col(1), R.col(0);
    for (int i = 0; i < 3; ++i) addAxis(picture, axes.col(i), 1.3 - 0.15 * i, kAxisColors[i]);
    const double independent = svd(axes).s[2];
    picture.captions.push_back({.text = independent < 0.05
                                            ? "gimbal lock: blue and red turn about the same line"
                                            : "blue: yaw, green: pitch, red: roll"});

    // There and back in eight seconds.
    const double share = 1 - std::abs(1 - std::fmod(t / 120., 2));
    const Quaternion a = quaternionFromRotation(rotationFromRollPitchYaw(start.reverse()));
    const Vector3d turn = logSO3(rotationFromQuaternion(a).transpose() * R);
    const Eigen::Matrix3d now[] = {rotationFromQuaternion(a) * expSO3(share * turn),
                                   rotationFromRollPitchYaw((start + share * (angles - start)).reverse())};
    if (aim != angles) ways[0].clear(), ways[1].clear();
    aim = angles;
    for (int side = 0; side < 2; ++side) {
      const Vector3d at(3, 0, side == 0 ? 1 : -1.2);
      addPlane(picture, now[side], at, side == 0 ? Color{0.1f, 0.45f, 0.7f} : Color{0.84f, 0.37f, 0});
      ways[side].push_back(at + now[side].col(0));
      if (ways[side].size() > 240) ways[side].erase(ways[side].begin());
      if (ways[side].size() > 1) picture.polylines.push_back({ways[side], kAxisColors[2], 3});
      picture.labels.push_back({side == 0 ? "quaternions" : "Euler angles", at + Vector3d(0.9, 0, 0)});
      if (t > 0)
        view.plot(side == 0 ? "speed by quaternions [rad/s]" : "speed by Euler angles [rad/s]", t / 30.,
                  30 * logSO3(before[side].transpose() * now[side]).norm());
      before[side] = now[side];
    }
    view.plot("independence of the axes [1]", t / 30., independent);
    view.show(picture);
  }
}
