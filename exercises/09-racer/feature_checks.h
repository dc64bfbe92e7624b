#pragma once

#include <utility>

#include <fmt/format.h>

#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "learning/sensor_history.h"
#include "racer_checks.h"

// Part 4: features, against the library's.

inline rex::SensorHistory noHistory(double tau) {
  return rex::SensorHistory({.sensors = 4,
                             .timeStep = tau,
                             .constant = true,
                             .derivatives = true,
                             .averages = {.5, .9},
                             .pastActions = 2});
}

/// Features that belong together.
struct Block {
  const char* name;
  int begin, count;
};

inline rex::grading::Evidence featuresOf(const Block& block, const Eigen::VectorXd& got,
                                         const Eigen::VectorXd& wanted) {
  rex::Series mine = rex::grading::gotCurve("got"), right = rex::grading::wantedCurve("wanted");
  for (int i = block.begin; i < block.begin + block.count; ++i)
    for (const auto& [series, from] : {std::pair{&mine, &got}, {&right, &wanted}}) {
      series->add(i, (*from)[i]);
    }
  for (const auto& [series, marker] : {std::pair{&mine, rex::Marker::kDot}, {&right, rex::Marker::kCircle}}) {
    series->style = rex::SeriesStyle::kPoints;
    series->marker = marker;
    series->size = 2;
  }
  return {.figures = {{.title = block.name,
                       .xLabel = "number of the feature",
                       .yLabel = "value",
                       .series = {mine, right}}}};
}

inline void blockFits(rex::grading::Check& check, const Block& block, const Eigen::VectorXd& got,
                      const Eigen::VectorXd& wanted) {
  const auto part = [&](const Eigen::VectorXd& all) -> Eigen::VectorXd {
    return all.segment(block.begin, block.count);
  };
  const auto shown = check.show([&] { return featuresOf(block, got, wanted); });
  check.near(block.name, part(got), part(wanted), 1e-10 * (1 + wanted.cwiseAbs().maxCoeff()));
}

inline void featuresFit(rex::grading::Check& check, Student& student, double tau, int readings) {
  rex::SensorHistory history = noHistory(tau);
  Eigen::VectorXd before;
  double u = check.rng().normal();
  for (int t = 0; t < readings; ++t) {
    const Eigen::Vector4d y = check.rng().normalVector(4);
    check.input(fmt::format("reading {} of {}", t + 1, readings),
                {{"y", y}, {"before", before}, {"u", u}, {"tau", tau}});
    const Eigen::VectorXd wanted = history.observe(y), got = student.featuresAt(y, before, u, tau);
    check.shape("result of featuresAt", got, kFeatures, 1);
    for (const Block& block : {Block{"feature 0 of featuresAt (1)", 0, 1},
                               {"features 1 - 4 of featuresAt (y)", 1, 4},
                               {"features 5 - 8 of featuresAt (rate of y)", 5, 4},
                               {"features 9 - 12 of featuresAt (average of y, a = .5)", 9, 4},
                               {"features 13 - 16 of featuresAt (average of the rate, a = .5)", 13, 4},
                               {"features 17 - 20 of featuresAt (average of y, a = .9)", 17, 4},
                               {"features 21 - 24 of featuresAt (average of the rate, a = .9)", 21, 4},
                               {"features 25 and 26 of featuresAt (last controls)", 25, 2}})
      blockFits(check, block, got, wanted);
    before = wanted;
    u = check.rng().normal();
    history.act(u);
  }
}
