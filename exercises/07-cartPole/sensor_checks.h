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

inline Eigen::MatrixXd numberAsMatrix(double number) { return Eigen::MatrixXd::Constant(1, 1, number); }

inline void unseenFits(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& A,
                       const Eigen::MatrixXd& C) {
  check.input("a plant and its sensor", {{"A", A}, {"C", C}});
  const Eigen::Index n = A.rows();
  const auto hiddenFrom = [&](const Eigen::MatrixXd& dynamics) -> Eigen::MatrixXd {
    return rex::observability({.A = dynamics, .B = Eigen::MatrixXd::Zero(n, 1), .C = C}, 1e-9).unreachable;
  };
  const Eigen::MatrixXd wanted = hiddenFrom(A), ofTransposed = hiddenFrom(A.transpose());
  const Eigen::MatrixXd N = student.unseen(A, C);
  const double columns = static_cast<double>(wanted.cols()), size = static_cast<double>(n);
  const char* isTransposed = "Is A transposed? A plant with A^T and C^T reaches what y shows of A.";
  const char* isSeen = "Are these the states that y shows? Wanted are the others.";
  {
    const double smallest = rex::svd(rex::observabilityMatrix({.A = A, .B = C.transpose(), .C = C})).s[n - 1];
    const bool isRounding = columns > 0 && smallest > 0 && N.cols() == 0;
    const auto zeros =
        check.ask("Which singular values count as zero? Those below 1e-9 of the largest.", isRounding);
    const auto seen = check.suspect(isSeen, numberAsMatrix(size - columns));
    const auto once =
        check.suspect("Is it what y does not show at once? Its derivatives C A x, C A^2 x ... show more.",
                      numberAsMatrix(size - rankOf(C)));
    const auto transposed = check.suspect(
        isTransposed, numberAsMatrix(isRounding ? -1. : static_cast<double>(ofTransposed.cols())));
    check.near("number of columns of unseen", static_cast<double>(N.cols()), columns, 0);
  }
  check.shape("unseen", N, n, wanted.cols());
  if (wanted.cols() == 0) return;
  check.near("N^T N for the N of unseen", N.transpose() * N,
             Eigen::MatrixXd::Identity(wanted.cols(), wanted.cols()), 1e-9);
  const Eigen::MatrixXd hidden = wanted * wanted.transpose();
  const auto transposed = check.suspect(isTransposed, ofTransposed * ofTransposed.transpose());
  const auto seen = check.suspect(isSeen, Eigen::MatrixXd::Identity(n, n) - hidden);
  check.near("N N^T for the N of unseen, the projection onto its columns", N * N.transpose(), hidden, 1e-5);
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
  const double size = 1 + wanted.norm();
  const auto sign =
      check.suspect("Is the sign that of K = -R^-1 B^T P? The error moves with A - L C.", -wanted);
  const auto noV = check.suspect("Is V left out? L = S C^T V^-1.", dual.optimal.X * C.transpose());
  const auto timesV = check.suspect("Is V in the place of its inverse? L = S C^T V^-1.",
                                    dual.optimal.X * C.transpose() * noise.V);
  const rex::RiccatiResult same = rex::solveCare(A, dual.plant.B, noise.W, noise.V);
  const auto notDual = check.suspect(
      "Is A that of the plant? The dual plant has A^T.",
      same.status == rex::RiccatiStatus::kSolved ? Eigen::MatrixXd(same.K.transpose()) : Eigen::MatrixXd());
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
  const Eigen::Index n = real.A.rows();
  check.input("a plant, a model of it, and an observer", {{"A", real.A},
                                                          {"B", real.B},
                                                          {"A of the model", model.A},
                                                          {"B of the model", model.B},
                                                          {"C", C},
                                                          {"K", K},
                                                          {"L", L}});
  const auto with = [&](const Plant& plant, const Plant& believed, double ofK, double ofL) {
    return loopOf({plant, believed, C, ofK * K, ofL * L});
  };
  const Eigen::MatrixXd wanted = loopOf(task);
  const auto sign = check.suspect("Is the sign of the correction wrong? The observer adds L (y - C x^).",
                                  with(real, model, 1, -1));
  const auto minus =
      check.suspect("Is the sign that of u = -K x? Here it is u = K x^.", with(real, model, -1, 1));
  const auto deaf = check.suspect("Does the observer not know u? Its model moves with B u, too.",
                                  with(real, {model.A, 0 * model.B}, 1, 1));
  const auto knowing =
      check.suspect("Does the observer know the plant? It only has the model.", with(real, real, 1, 1));
  const auto believing = check.suspect("Does the plant move as the model does?", with(model, model, 1, 1));
  const auto exchanged = check.suspect("Are the plant and its model exchanged?", with(model, real, 1, 1));
  Eigen::MatrixXd change = Eigen::MatrixXd::Identity(2 * n, 2 * n);
  change.bottomRightCorner(n, n) *= -1;
  change.bottomLeftCorner(n, n).setIdentity();  // (x, x - x^), and its own inverse
  const auto errors =
      check.suspect("Is it the matrix of (x, x - x^)? Wanted is that of (x, x^).", change * wanted * change);
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
  const auto responseWith = [&](const Eigen::VectorXd& at) {
    const rex::FrequencyResponse found = rex::frequencyResponse({.A = plant.A, .B = plant.B, .C = C}, 0, 0,
                                                                std::vector<double>(at.begin(), at.end()));
    Eigen::MatrixXd G(2, at.size());
    for (Eigen::Index k = 0; k < at.size(); ++k) {
      const std::complex<double> value = found.values[static_cast<std::size_t>(k)];
      G.col(k) << value.real(), value.imag();
    }
    return G;
  };
  const Eigen::MatrixXd wanted = responseWith(frequencies),
                        inHertz = responseWith(2 * std::numbers::pi * frequencies);
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
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(plant.A.rows(), plant.A.rows());
  for (Eigen::Index k = 0; k < got.cols(); ++k) {
    const double w = frequencies[k];
    const Eigen::Vector2d value = wanted.col(k);
    const auto hertz =
        check.suspect("Are the frequencies taken as Hz? They are in rad/s.", Eigen::Vector2d(inHertz.col(k)));
    const auto conjugate = check.suspect("Is it G(-i w)? Which sign has the imaginary part?",
                                         Eigen::Vector2d(value[0], -value[1]));
    const auto sign = check.suspect("Is the sign that of C (A - i w)^-1 B?", -value);
    const auto polar = check.suspect("Are these magnitude and phase? Wanted are real and imaginary part.",
                                     Eigen::Vector2d(value.norm(), std::atan2(value[1], value[0])));
    const auto real = check.ask("Is it C (w - A)^-1 B, without i?", [&] {
      const double direct = (C * rex::solveMatrix(w * identity - plant.A, plant.B))(0, 0);
      return std::abs(got(0, k) - direct) < 1e-6 * (1 + std::abs(direct));
    }());
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
