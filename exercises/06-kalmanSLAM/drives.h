#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "course/car_figure.h"
#include "course/car_pictures.h"
#include "course/car_simulator.h"
#include "estimation/gaussian.h"
#include "estimation/gaussian_model.h"
#include "exercise.h"

// What main() lets the car do, and lines and ellipses for its pictures.

using Poses = std::vector<Eigen::Vector3d>;

/// A drive as it was: controls[t] leads from states[t] to states[t + 1]; there the landmarks in seen[t] are
/// seen.
struct Recorded {
  rex::CarOptions options;
  Eigen::Matrix2Xd landmarks;
  std::vector<Eigen::Vector2d> controls;
  Poses states;
  std::vector<std::vector<Sighting>> seen;
};

inline rex::CarOptions optionsOf(const CarSetup& car) {
  rex::CarOptions options;
  options.tau = car.tau;
  options.wheelbase = car.wheelbase;
  options.dynamicsNoise = car.dynamicsNoise;
  options.observationNoise = car.observationNoise;
  options.bearingNoise = car.bearingNoise;
  options.rangeBearing = car.rangeBearing;
  return options;
}

/// What the library does for main(), which alone may ask it.
struct Library {
  /// A drive of so many steps; landmarks farther away than `range` are not seen.
  std::function<Recorded(std::uint64_t seed, const CarSetup& car, const Eigen::Matrix2Xd& landmarks,
                         int steps, const Eigen::Vector2d& u, double range)>
      drive;
  std::function<std::vector<rex::Gaussian>(const std::vector<rex::Gaussian>& filtered,
                                           const std::vector<rex::LinearModel>& transitions)>
      smooth;
  /// The states that Kalman SLAM estimates.
  std::function<Poses(const Recorded& drive)> slam;
};

inline constexpr double kAnywhere = 1e3;  ///< a range

/// All that is seen in step t, for a drive that sees all landmarks in each.
inline Eigen::VectorXd stacked(const Recorded& drive, std::size_t t) {
  Eigen::VectorXd y(drive.landmarks.size());
  for (const Sighting& one : drive.seen[t]) y.segment(2 * one.landmark, 2) = one.y;
  return y;
}

/// Landmarks left and right of the circle on which u = (v, 0.2) leads.
inline Eigen::Matrix2Xd places(int count) {
  Eigen::Matrix2Xd landmarks(2, count);
  const double radius = 2 / std::tan(0.2);
  for (int i = 0; i < count; ++i) {
    const double angle = 6.2832 * (i + 0.35) / count - 1.57, r = radius + (i % 2 == 0 ? 4.5 : -3.5);
    landmarks.col(i) << r * std::cos(angle), radius + r * std::sin(angle);
  }
  return landmarks;
}

inline rex::Way wayOf(const std::string& name, const Poses& poses, const rex::Color& color,
                      bool dashed = false) {
  rex::Way way{name, Eigen::Matrix2Xd(2, static_cast<Eigen::Index>(poses.size())), color, dashed};
  for (std::size_t t = 0; t < poses.size(); ++t)
    way.points.col(static_cast<Eigen::Index>(t)) = poses[t].head(2);
  return way;
}

inline Poses meansOf(const std::vector<Belief>& beliefs) {
  Poses poses;
  for (const Belief& belief : beliefs) poses.emplace_back(belief.mean.head(3));
  return poses;
}

/// Of two numbers of a belief, from number i on.
inline rex::PlanarGaussian planar(const Belief& belief, Eigen::Index i) {
  return {belief.mean.segment(i, 2), belief.covariance.block(i, i, 2, 2)};
}

inline void addEllipses(rex::Figure& figure, const std::string& label, const std::vector<Belief>& beliefs,
                        std::size_t every, const rex::Color& color) {
  for (std::size_t t = every; t < beliefs.size(); t += every) {
    const rex::PlanarGaussian xy = planar(beliefs[t], 0);
    figure.ellipses.push_back({t == every ? label : "", xy.mean, xy.covariance, 2, color});
  }
}

inline rex::Figure overTime(const std::string& title, const std::string& yLabel) {
  rex::Figure figure{.title = title, .xLabel = "time [s]", .yLabel = yLabel};
  figure.width = 900;
  figure.height = 460;
  return figure;
}

inline rex::Series curve(const std::string& label, const std::vector<double>& y, const rex::Color& color,
                         double size = 1.5, bool dashed = false) {
  rex::Series series{.label = label};
  series.y = y;
  series.size = size;
  series.dashed = dashed;
  series.color = color;
  return series;
}

/// Two standard deviations of number i of each belief, to both sides.
inline rex::Band deviationBand(const std::string& label, const std::vector<Belief>& beliefs, Eigen::Index i,
                               const rex::Color& color) {
  rex::Band band{.label = label};
  for (const Belief& belief : beliefs) {
    band.high.push_back(2 * std::sqrt(belief.covariance(i, i)));
    band.low.push_back(-band.high.back());
  }
  band.color = color;
  return band;
}

inline std::vector<double> errorsOf(const std::vector<Belief>& beliefs, const Poses& states, Eigen::Index i) {
  std::vector<double> errors;
  for (std::size_t t = 0; t < beliefs.size(); ++t) errors.push_back(beliefs[t].mean[i] - states[t][i]);
  return errors;
}

/// A joint belief on its way: after each step, and which landmark is which in it.
struct Mapping {
  std::vector<Belief> joints{{Eigen::Vector3d::Zero(), 1e-6 * Eigen::Matrix3d::Identity()}};
  std::vector<int> names;
};

inline rex::CarView viewAt(const Recorded& drive, const Mapping& mapping, std::size_t t) {
  const Belief& joint = mapping.joints[t];
  rex::CarView view;
  view.car = drive.states[t];
  view.estimate = joint.mean.head(3);
  view.landmarks = drive.landmarks;
  view.poseBeliefs = {planar(joint, 0)};
  for (Eigen::Index i = 3; i < joint.mean.size(); i += 2) view.landmarkBeliefs.push_back(planar(joint, i));
  Poses truth(drive.states.begin(), drive.states.begin() + static_cast<std::ptrdiff_t>(t) + 1);
  const Poses all = meansOf(mapping.joints);
  view.ways = {wayOf("true way", truth, rex::kTruthColor),
               wayOf("estimate", {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(t) + 1},
                     rex::kEstimateColor)};
  return view;
}

/// How uncertain each landmark is, from its first sighting on [m].
inline rex::Figure deviationsOf(const Mapping& mapping) {
  rex::Figure figure =
      overTime("Standard deviation of each landmark, from its first sighting on", "deviation [m]");
  figure.legend = rex::Legend::kNone;
  const Eigen::Index n = mapping.joints.back().mean.size();
  for (Eigen::Index i = 3; i < n; i += 2) {
    rex::Series series{.size = 2};
    for (std::size_t t = 0; t < mapping.joints.size(); ++t) {
      const Eigen::MatrixXd& S = mapping.joints[t].covariance;
      if (S.rows() <= i) continue;
      series.x.push_back(static_cast<double>(t));
      series.y.push_back(std::sqrt(0.5 * (S(i, i) + S(i + 1, i + 1))));
    }
    figure.series.push_back(series);
  }
  return figure;
}

inline rex::Figure correlationsOf(const Belief& joint) {
  const Eigen::Index n = joint.mean.size();
  rex::HeatMap map{.xRange = {0, static_cast<double>(n)},
                   .yRange = {0, static_cast<double>(n)},
                   .values = joint.covariance};
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      map.values(i, k) /= std::sqrt(joint.covariance(i, i) * joint.covariance(k, k));
  rex::Figure figure{.title = "Correlations of car and landmarks at the end",
                     .xLabel = "number in the state [1]",
                     .yLabel = "number in the state [1]",
                     .colorLabel = "correlation [1]",
                     .equalAxes = true,
                     .colorRange = rex::AxisRange{-1, 1}};
  figure.heatMap = map;
  figure.width = figure.height = 640;
  return figure;
}

/// The library's smoother, on the same beliefs.
inline std::vector<Belief> libraryHindsight(const Library& library, const CarSetup& car,
                                            const Recorded& drive, const std::vector<Belief>& run) {
  std::vector<rex::Gaussian> beliefs;
  std::vector<rex::LinearModel> steps;
  for (const Belief& belief : run) beliefs.push_back({belief.mean, belief.covariance});
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    const Eigen::MatrixXd A = stepByState(car, run[t].mean, drive.controls[t]);
    const Eigen::VectorXd next = stepped(car, run[t].mean, drive.controls[t]);
    steps.push_back({A, next - A * run[t].mean, stepNoise(car)});
  }
  std::vector<Belief> smooth;
  for (const rex::Gaussian& belief : library.smooth(beliefs, steps))
    smooth.push_back({belief.mean, belief.covariance});
  return smooth;
}

/// Kalman SLAM of a drive whose landmarks have names.
inline Mapping mapped(const CarSetup& car, const Recorded& drive) {
  Mapping mapping;
  for (std::size_t t = 0; t < drive.controls.size(); ++t) {
    Belief joint = jointPredicted(car, mapping.joints.back(), drive.controls[t]);
    for (const Sighting& seen : drive.seen[t]) {
      const auto known = std::find(mapping.names.begin(), mapping.names.end(), seen.landmark);
      if (known == mapping.names.end()) {
        joint = withLandmark(car, joint, seen.y);
        mapping.names.push_back(seen.landmark);
      } else {
        joint = jointCorrected(car, joint, static_cast<int>(known - mapping.names.begin()), seen.y);
      }
    }
    mapping.joints.push_back(joint);
  }
  return mapping;
}

/// As many particles again, in proportion to their weights.
inline std::vector<MapParticle> drawn(const std::vector<MapParticle>& particles, rex::Rng& rng) {
  const double share = 1. / static_cast<double>(particles.size());
  std::vector<MapParticle> survivors;
  double sum = 0, next = rng.uniform() * share;
  for (const MapParticle& particle : particles)
    for (sum += particle.weight; next < sum && survivors.size() < particles.size(); next += share)
      survivors.push_back(particle);
  while (survivors.size() < particles.size()) survivors.push_back(particles.back());
  for (MapParticle& particle : survivors) particle.weight = share;
  return survivors;
}

/// The last states and the maps of all particles.
inline rex::Figure particleFigure(const Recorded& drive, const std::vector<MapParticle>& particles) {
  rex::CarView view;
  view.caption = "FastSLAM: 100 particles, each with its map";
  view.car = drive.states.back();
  view.landmarks = drive.landmarks;
  view.ways = {wayOf("true way", drive.states, rex::kTruthColor)};
  view.particles.resize(3, static_cast<Eigen::Index>(particles.size()));
  rex::Series maps{.label = "landmarks in their maps", .style = rex::SeriesStyle::kPoints};
  maps.marker = rex::Marker::kDot;
  maps.size = 0.6;
  maps.color = rex::kDeadReckoningColor;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    view.particles.col(static_cast<Eigen::Index>(k)) = particles[k].x;
    for (const Belief& landmark : particles[k].map) {
      maps.x.push_back(landmark.mean[0]);
      maps.y.push_back(landmark.mean[1]);
    }
  }
  rex::Figure figure = rex::figureOf(view);
  if (!maps.x.empty()) figure.series.push_back(maps);
  return figure;
}
