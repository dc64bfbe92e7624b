#pragma once

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "control/controllability.h"
#include "control/responses.h"
#include "control/riccati.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "plants.h"
#include "stability_checks.h"

// Part 6: what a sensor sees.

inline void unseenFits(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& A,
                       const Eigen::MatrixXd& C) {
  check.input("a plant and its sensor", {{"A", A}, {"C", C}});
  const Eigen::Index n = A.rows();
  const auto hiddenFrom = [&](const Eigen::MatrixXd& dynamics) -> Eigen::MatrixXd {
    return rex::observability({.A = dynamics, .B = Eigen::MatrixXd::Zero(n, 1), .C = C}, 1e-9).unreachable;
  };
  const Eigen::MatrixXd wanted = hiddenFrom(A), ofTransposed = hiddenFrom(A.transpose());
  const Eigen::MatrixXd N = student.unseen(A, C);
  const auto columns = static_cast<double>(wanted.cols()), size = static_cast<double>(n),
             got = static_cast<double>(N.cols());
  const char* isTransposed = "Is A transposed? A plant with A^T and C^T reaches what y shows of A.";
  const char* isSeen = "Are these the states that y shows? Wanted are the others.";
  {
    const double smallest = rex::svd(rex::observabilityMatrix({.A = A, .B = C.transpose(), .C = C})).s[n - 1];
    const bool isRounding = columns > 0 && smallest > 0 && N.cols() == 0;
    const auto zeros =
        check.ask("Which singular values count as zero? Those below 1e-9 of the largest.", isRounding);
    const auto seen = check.ask(isSeen, got == size - columns);
    const auto once =
        check.ask("Is it what y does not show at once? Its derivatives C A x, C A^2 x ... show more.",
                  got == size - rankOf(C));
    const auto transposed = check.ask(isTransposed, !isRounding && N.cols() == ofTransposed.cols());
    check.near("number of columns of unseen", got, columns, 0);
  }
  check.shape("unseen", N, n, wanted.cols());
  if (wanted.cols() == 0) return;
  check.near("N^T N for the N of unseen", N.transpose() * N,
             Eigen::MatrixXd::Identity(wanted.cols(), wanted.cols()), 1e-9);
  const Eigen::MatrixXd hidden = wanted * wanted.transpose(), projection = N * N.transpose();
  const auto isNear = [&](const Eigen::MatrixXd& other) {
    return (projection - other).cwiseAbs().maxCoeff() < 1e-5;
  };
  const auto transposed = check.ask(isTransposed, isNear(ofTransposed * ofTransposed.transpose()));
  const auto seen = check.ask(isSeen, isNear(Eigen::MatrixXd::Identity(n, n) - hidden));
  check.near("N N^T for the N of unseen, the projection onto its columns", projection, hidden, 1e-5);
}

/// A sensor that shows `rank` of n dimensions, in coordinates that do not show which; clear enough for
/// methods that square the singular values.
inline Plant partlySeen(rex::Rng& rng, Eigen::Index n, Eigen::Index rank, Eigen::Index p) {
  for (;;) {
    const Plant dual = partlyReached(rng, n, rank, p);
    const Eigen::VectorXd sizes = rex::svd(rex::controllabilityMatrix({.A = dual.A, .B = dual.B})).s;
    if (sizes[rank - 1] > 1e-3 * sizes[0]) return dual;
  }
}

/// The regulation whose dual is the task: A^T, C^T, W and V take the places of A, B, Q and R. L is compared
/// first; what shows how exact it is needs no Riccati equation: S is the covariance of the error with this L,
/// and no other L makes it smaller if S C^T = L V.
inline void observerFits(rex::grading::Check& check, Student& student, const Regulation& dual) {
  const Eigen::MatrixXd A = dual.plant.A.transpose(), C = dual.plant.B.transpose();
  const Noise noise{dual.costs.Q, dual.costs.R};
  const Eigen::MatrixXd wanted = dual.optimal.K.transpose();
  check.input("a plant, its sensor and noise", {{"A", A}, {"C", C}, {"W", noise.W}, {"V", noise.V}});
  const Eigen::MatrixXd L = student.observerGain(A, C, noise);
  // A wrong K of optimalGain gives the same L.
  const auto sign =
      check.suspect("Is the sign that of K = -R^-1 B^T P? The error moves with A - L C.", -wanted);
  const auto noV = check.suspect("Is V left out? L = S C^T V^-1.", dual.optimal.X * C.transpose());
  const auto timesV = check.suspect("Is V in the place of its inverse? L = S C^T V^-1.",
                                    dual.optimal.X * C.transpose() * noise.V);
  const double size = 1 + wanted.norm();
  check.near("L of observerGain", L, wanted, 1e-3 * size);
  const Eigen::MatrixXd LC = L * C, LVL = L * noise.V * L.transpose();
  const Eigen::MatrixXd S = rex::solveLyapunov((A - LC).transpose(), noise.W + LVL);
  check.near("S C^T - L V for the L of observerGain and the covariance S of its error",
             S * C.transpose() - L * noise.V, Eigen::MatrixXd::Zero(L.rows(), L.cols()),
             1e-6 * size * (1 + noise.V.norm()));
}

/// A plant, a wrong model of it, and an observer with its controller; none of them has to be good.
struct Observed {
  Plant real, model;
  Eigen::MatrixXd C, K, L;
};

inline Observed randomObserved(rex::Rng& rng) {
  const Eigen::Index n = 2 + rng.index(3), m = 1 + rng.index(2), p = 1 + rng.index(2);
  const Plant model = randomPlant(rng, n, m);
  const Plant real{model.A + .3 * randomMatrix(rng, n, n), model.B + .3 * randomMatrix(rng, n, m)};
  return {real, model, randomMatrix(rng, p, n), randomMatrix(rng, m, n), randomMatrix(rng, n, p)};
}

/// Column by column: how x and x^ move from the states in which one of their numbers is one.
inline Eigen::MatrixXd loopOf(const Observed& task) {
  const auto& [real, model, C, K, L] = task;
  const Eigen::Index n = real.A.rows();
  Eigen::MatrixXd loop(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const Eigen::VectorXd both = Eigen::VectorXd::Unit(2 * n, i), x = both.head(n), believed = both.tail(n);
    const Eigen::VectorXd u = K * believed, surprise = C * x - C * believed;
    loop.col(i) << real.A * x + real.B * u, model.A * believed + model.B * u + L * surprise;
  }
  return loop;
}

inline void observedLoopFits(rex::grading::Check& check, Student& student, const Observed& task) {
  const auto& [real, model, C, K, L] = task;
  check.input("a plant, a model of it, and an observer", {{"A", real.A},
                                                          {"B", real.B},
                                                          {"A of the model", model.A},
                                                          {"B of the model", model.B},
                                                          {"C", C},
                                                          {"K", K},
                                                          {"L", L}});
  const Eigen::MatrixXd wanted = loopOf(task);
  check.near("observedLoop", student.observedLoop(real, model, C, K, L), wanted, 1e-10 * (1 + wanted.norm()));
}

/// Doyle's plant of 1978, whose observer believes in a force that is a little different.
inline Observed doyle() {
  const Plant model{(Eigen::Matrix2d() << 1, 1, 0, 1).finished(), Eigen::Vector2d(0, 1)};
  return {{model.A, 1.01 * model.B},
          model,
          Eigen::RowVector2d(1, 0),
          Eigen::RowVector2d(-10, -10),
          Eigen::Vector2d(10, 10)};
}

/// A response in the complex plane, up to 3 from zero.
inline std::vector<Eigen::Vector2d> pointsOf(const Eigen::MatrixXd& G) {
  std::vector<Eigen::Vector2d> points;
  for (const auto& value : G.colwise())
    if (value.norm() < 3) points.emplace_back(value);
  return points;
}

inline void responseFits(rex::grading::Check& check, Student& student, const Plant& plant,
                         const Eigen::MatrixXd& C, const Eigen::VectorXd& frequencies) {
  check.input("a plant and its sensor",
              {{"A", plant.A}, {"B", plant.B}, {"C", C}, {"frequencies", frequencies}});
  const rex::FrequencyResponse found =
      rex::frequencyResponse({.A = plant.A, .B = plant.B, .C = C}, 0, 0,
                             std::vector<double>(frequencies.begin(), frequencies.end()));
  Eigen::MatrixXd wanted(2, frequencies.size());
  for (Eigen::Index k = 0; k < frequencies.size(); ++k) {
    const std::complex<double> value = found.values[static_cast<std::size_t>(k)];
    wanted.col(k) << value.real(), value.imag();
  }
  const Eigen::MatrixXd got = student.responseAt(plant, C, frequencies);
  check.shape("responseAt", got, 2, frequencies.size());
  const auto shown = check.show([&] {
    rex::Figure figure{
        .title = "The response in the complex plane", .xLabel = "real part", .yLabel = "imaginary part"};
    figure.series = {rex::through(pointsOf(got), rex::grading::gotCurve("got")),
                     rex::through(pointsOf(wanted), rex::grading::wantedCurve("wanted"))};
    for (rex::Series& one : figure.series) one.style = rex::SeriesStyle::kLinesPoints;
    return rex::grading::Evidence{.figures = {figure}};
  });
  for (Eigen::Index k = 0; k < got.cols(); ++k) {
    const double w = frequencies[k];
    const Eigen::Vector2d value = wanted.col(k);
    check.near(fmt::format("real and imaginary part of responseAt at w = {:g} rad/s", w), got.col(k), value,
               1e-6 * value.norm() + 1e-13 * C.norm() * plant.B.norm());
  }
}

/// A plant with one control and one measurement, none of whose eigenvalues is near the imaginary axis, nor
/// near the real numbers w.
inline void randomResponseFits(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  Eigen::VectorXd frequencies = rng.uniformVector(6, -1, 1.5);
  std::sort(frequencies.begin(), frequencies.end());
  frequencies = frequencies.unaryExpr([](double power) { return std::pow(10, power); });
  const auto isClear = [&](const Eigen::MatrixXd& A) {
    for (const std::complex<double>& pole : rex::eigenvalues(A))
      for (const double w : frequencies)
        if (std::abs(pole.real()) < .1 || std::abs(pole - w) < 1e-3) return false;
    return true;
  };
  const Eigen::Index n = 1 + rng.index(4);
  for (;;) {
    const Plant plant = randomPlant(rng, n, 1);
    if (!isClear(plant.A)) continue;
    return responseFits(check, student, plant, randomMatrix(rng, 1, n), frequencies);
  }
}
