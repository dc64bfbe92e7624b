#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include <Eigen/LU>
#include <fmt/format.h>

#include "camera_pictures.h"
#include "course/vision_simulator.h"
#include "estimation/camera_calibration.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "graph_mistakes.h"
#include "interface.h"

// Part 7: cameras, what they see, and what is required of P. Multiples of P are the same camera, so nothing
// here compares the numbers of two matrices.

/// What a camera sees, and the camera.
struct CameraView {
  Projection P;  ///< the true one, times any number
  Eigen::Vector3d position;
  Eigen::Matrix3Xd points;
  Eigen::Matrix2Xd pixels;
};

/// Where P maps points; not finite where the depth is zero.
inline Eigen::Matrix2Xd pixelsBy(const Projection& P, const Eigen::Matrix3Xd& points) {
  Eigen::Matrix2Xd pixels(2, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    pixels.col(i) = (P * points.col(i).homogeneous()).hnormalized();
  return pixels;
}

inline Eigen::MatrixXd noiseOf(rex::Rng& rng, int count, double deviation) {
  Eigen::MatrixXd noise(2, count);
  for (int i = 0; i < count; ++i) noise.col(i) = deviation * rng.normalVector(2);
  return noise;
}

inline double anyFactor(rex::Rng& rng) {
  return (rng.index(2) == 0 ? 1 : -1) * std::pow(10, rng.uniform(-3, 3));
}

/// What the simulator's camera sees, in a world whose axes are others each time.
inline CameraView simulatedView(rex::Rng& rng, int count, double deviation) {
  rex::VisionSimulator simulator(static_cast<std::uint64_t>(rng.index(1 << 30)));
  const rex::Pose X_VW{.R = rex::rotation(rng.uniform(-3, 3), rng.normalVector(3).normalized()).R,
                       .p = rng.uniformVector(3, -3, 3)};
  CameraView view{{}, X_VW * simulator.getCameraPose().p, {}, {}};
  const Eigen::Matrix3d M = anyFactor(rng) * simulator.getProjection().leftCols<3>() * X_VW.R.transpose();
  view.P << M, -M * view.position;
  const Eigen::Matrix3Xd points = simulator.getRandomWorldPoints(count).topRows(3);
  view.points = (X_VW.R * points).colwise() + X_VW.p;
  view.pixels = pixelsBy(view.P, view.points) + noiseOf(rng, count, deviation);
  return view;
}

/// A camera with pixels that are neither square nor quite rectangular, anywhere around a cube of 2 m whose
/// centre is `away` metres from the origin.
inline CameraView anyView(rex::Rng& rng, int count, double deviation, double away) {
  const auto direction = [&]() -> Eigen::Vector3d { return rng.normalVector(3).normalized(); };
  const Eigen::Vector3d centre = away * direction(), back = direction();
  Eigen::Matrix3d R, K;
  R.col(2) = back;
  R.col(0) = back.cross(direction()).normalized();
  R.col(1) = back.cross(Eigen::Vector3d(R.col(0)));
  const double focal = rng.uniform(400, 1200);
  K << focal, rng.uniform(-10, 10), -rng.uniform(200, 400), 0, focal * rng.uniform(.8, 1.2),
      -rng.uniform(150, 300), 0, 0, -1;
  CameraView view{{}, centre + rng.uniform(3, 5) * back, {}, {}};
  const Eigen::Matrix3d M = anyFactor(rng) * K * R.transpose();
  view.P << M, -M * view.position;
  view.points = (rng.uniformVector(3 * count, -1, 1).reshaped(3, count)).colwise() + centre;
  view.pixels = pixelsBy(view.P, view.points) + noiseOf(rng, count, deviation);
  return view;
}

inline double leastRms(const CameraView& view) { return rex::calibratedCamera(view.points, view.pixels).rms; }

inline double rmsBy(const Projection& P, const CameraView& view) {
  return (pixelsBy(P, view.points) - view.pixels).norm() / std::sqrt(static_cast<double>(view.pixels.cols()));
}

inline void describeView(rex::grading::Check& check, const std::string& what, const CameraView& view) {
  check.input(fmt::format("{} points, {}", view.points.cols(), what),
              {{"points", view.points}, {"pixels", view.pixels}});
}

inline rex::grading::Evidence reprojectionSeen(const CameraView& view, const Projection& P) {
  const Eigen::Matrix2Xd by = pixelsBy(P, view.points);
  if (!by.allFinite()) return {};
  return {.figures = {reprojection("Points as they were seen, and by P", view.pixels, by - view.pixels, 1)}};
}

/// The same camera with its twelve numbers in another order.
inline Projection byColumns(const Projection& P) {
  Projection other;
  for (int k = 0; k < 12; ++k) other(k % 3, k / 3) = P(k / 4, k % 4);
  return other;
}

inline void projectsExactly(rex::grading::Check& check, Student& student, const CameraView& view) {
  describeView(check, "no noise", view);
  const Projection P = student.projectionFromPoints(view.points, view.pixels);
  check.shape("P of projectionFromPoints", P, 3, 4);
  const auto shown = check.show([&] { return reprojectionSeen(view, P); });
  const Projection swapped = Eigen::Vector3d(1, 1, -1).asDiagonal() * view.P;
  check.near("pixels of the points by P of projectionFromPoints", pixelsBy(P, view.points), view.pixels, 1e-3,
             {{"Are the twelve numbers written column by column? The equations have them row by row.",
               pixelsBy(byColumns(view.P), view.points)},
              {"Does the last row of P have the wrong sign? Look at the signs of your equations.",
               pixelsBy(swapped, view.points)}},
             "pixels");
}

inline void projectsNearly(rex::grading::Check& check, Student& student, const CameraView& view) {
  describeView(check, "pixels with noise of 1", view);
  const Projection P = student.projectionFromPoints(view.points, view.pixels);
  check.shape("P of projectionFromPoints", P, 3, 4);
  const auto shown = check.show([&] { return reprojectionSeen(view, P); });
  const auto few = check.ask("Does P depend on all points, or on a few of them?", true);
  check.atMost("root mean square error of P of projectionFromPoints", rmsBy(P, view), 1.3 * leastRms(view),
               "pixels");
}

inline void standsThere(rex::grading::Check& check, Student& student, const CameraView& view) {
  check.input("the P of a camera", {{"P", view.P}});
  const Eigen::Matrix3d M = view.P.leftCols<3>();
  const Eigen::Vector3d got = student.cameraPosition(view.P);
  check.near("position of cameraPosition", got, view.position, 1e-6 * view.position.norm(),
             {{"Is it the direction in which the camera looks?", M.row(2).transpose()}}, "m");
}

inline void errsInPixels(rex::grading::Check& check, Student& student, const CameraView& view) {
  check.input("6 points", {{"P", view.P}, {"points", view.points}, {"pixels", view.pixels}});
  const Eigen::Matrix2Xd got = student.reprojectionErrors(view.P, view.points, view.pixels),
                         wanted = pixelsBy(view.P, view.points) - view.pixels;
  Projection still = view.P;
  still.col(3).setZero();
  check.near("errors of reprojectionErrors", got, wanted, 1e-6,
             {{"Is the last column of P left out?", pixelsBy(still, view.points) - view.pixels}}, "pixels");
}

/// The camera turned, moved and with another lens: errors of tens of pixels.
inline Projection roughly(rex::Rng& rng, const CameraView& view) {
  const Eigen::Vector3d centre = view.points.rowwise().mean(),
                        turn = .03 * Eigen::Vector3d(rng.normalVector(3).normalized()),
                        shift = rng.uniformVector(3, -.05, .05);
  const Eigen::Matrix3d R = rex::rotation(turn.norm(), turn.normalized()).R;
  Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
  X.topLeftCorner<3, 3>() = R;
  X.topRightCorner<3, 1>() = centre + shift - R * centre;
  Eigen::Matrix3d lens = Eigen::Matrix3d::Identity();
  lens.diagonal().head<2>() = rng.uniformVector(2, .95, 1.05);
  lens.topRightCorner<2, 1>() = rng.uniformVector(2, -10, 10);
  return lens * view.P * X;
}

inline std::string questionAboutSteps(const CameraView& view, const Projection& given, double got) {
  const double start = rmsBy(given, view);
  if (std::abs(got - start) < 1e-9 * start) return "Is P returned as it was given?";
  const double linear = rex::calibratedCamera(view.points, view.pixels).initialRms;
  if (std::abs(got - linear) < 1e-9 * linear)
    return "Is it the P of the linear equations? What they minimise are not errors in pixels.";
  if (got > start) return "Do the steps lead downhill? In the end the errors are larger than at the start.";
  return "Are steps repeated, each with new derivatives? And do these contain the depth, which changes with "
         "P?";
}

inline void refines(rex::grading::Check& check, Student& student, const CameraView& view) {
  const Projection given = roughly(check.rng(), view);
  describeView(check, "pixels with noise of 1, and a guess of P that is pixels off", view);
  const Projection P = student.refined(given, view.points, view.pixels);
  check.shape("P of refined", P, 3, 4);
  const auto shown = check.show([&] { return reprojectionSeen(view, P); });
  const auto n = static_cast<double>(view.points.cols());
  const double least = leastRms(view), rms = rmsBy(P, view);
  const std::string question = questionAboutSteps(view, given, rms);
  const auto asked = check.ask(question, true);
  check.atMost("sum of squared errors by P of refined", n * rms * rms, n * least * least * (1 + 1e-5),
               "pixels^2");
}
