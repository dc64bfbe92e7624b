#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>

#include "control/regulators.h"
#include "control/value_grid.h"
#include "grading/check.h"
#include "interface.h"
#include "lyapunov_checks.h"

// Parts 1, 3, 5 and 6: the pendulum. Each mistake beside a wanted value is one that students make.

constexpr double kPi = std::numbers::pi;

/// A motor that lifts the mass up to a third of the way.
inline Pendulum randomPendulum(rex::Rng& rng) {
  Pendulum p{.mass = rng.uniform(.3, 2),
             .length = rng.uniform(.4, 1.5),
             .friction = rng.uniform(.05, .3),
             .g = rng.uniform(4, 12)};
  p.strongest = rng.uniform(.25, .35) * p.mass * p.g * p.length;
  return p;
}

inline Eigen::Matrix<double, 1, 5> numbersOf(const Pendulum& p) {
  return {p.mass, p.length, p.friction, p.g, p.strongest};
}

/// A small grid with random values.
struct Table {
  Decision decision{};
  Eigen::MatrixXd V{};
};
inline Table randomTable(rex::Rng& rng) {
  Decision decision{.pendulum = randomPendulum(rng),
                    .grid = {6 + rng.index(6), 5 + rng.index(5), rng.uniform(4, 9)},
                    .tau = rng.uniform(.05, .2),
                    .effort = rng.uniform(.02, .3),
                    .discount = rng.uniform(.6, .95),
                    .torques = 3 + 2 * rng.index(3)};
  const Eigen::VectorXd V = rng.uniformVector(decision.grid.angles * decision.grid.rates, 0, 3);
  return {decision, V.reshaped(decision.grid.angles, decision.grid.rates)};
}

/// V at x as a sum over all nodes: each counts by a hat that is 1 there and 0 at its neighbours.
inline double hatSum(const Grid& grid, const Eigen::MatrixXd& V, const Eigen::Vector2d& x) {
  const double turn = 2 * kPi / grid.angles, apart = 2 * grid.fastest / (grid.rates - 1);
  Eigen::VectorXd a(grid.angles), b(grid.rates);
  for (int i = 0; i < a.size(); ++i)
    a[i] = std::max(0., 1 - std::abs(std::remainder(x[0] + kPi - i * turn, 2 * kPi)) / turn);
  for (int j = 0; j < b.size(); ++j)
    b[j] = std::max(
        0., 1 - std::abs(std::max(-grid.fastest, std::min(x[1], grid.fastest)) + grid.fastest - j * apart) /
                    apart);
  return a.dot(V * b);
}

/// A state inside a cell, between the last angle and the first, beyond the fastest rate, or turns away.
enum class Place { kInside, kLast, kBeyond, kTurned };
inline void interpolates(rex::grading::Check& check, Student& student, Place place) {
  const bool isLast = place == Place::kLast, isBeyond = place == Place::kBeyond,
             isTurned = place == Place::kTurned;
  rex::Rng& rng = check.rng();
  const auto& [decision, V] = randomTable(rng);
  const Grid grid = decision.grid;
  const double turn = 2 * kPi / grid.angles, apart = 2 * grid.fastest / (grid.rates - 1);
  const int i = isLast ? grid.angles - 1 : rng.index(grid.angles - 1), j = rng.index(grid.rates - 1);
  Eigen::Vector2d x((i + rng.uniform(.1, .9)) * turn - kPi, (j + rng.uniform(.1, .9)) * apart - grid.fastest);
  if (isBeyond) x[1] = (rng.index(2) == 0 ? 1.3 : -1.4) * grid.fastest;
  const Eigen::Vector2d inside = x;
  if (isTurned) x[0] += 2 * kPi * (rng.index(2) == 0 ? 1 : -2);
  check.input(
      "values at nodes",
      {{"angles", grid.angles}, {"rates", grid.rates}, {"fastest", grid.fastest}, {"V", V}, {"x", x}});
  const auto wanted = hatSum(grid, V, x);
  const auto beyond =
      check.ask("Is the rate beyond the fastest? V is there what it is at the border.", isBeyond);
  const auto last = check.ask("Is the angle between the last node and the first?", isLast);
  const auto turns = check.ask("Have whole turns been added to the angle?", isTurned);
  const Eigen::Vector2d nearest(std::round((inside[0] + kPi) / turn) * turn - kPi,
                                std::round((x[1] + grid.fastest) / apart) * apart - grid.fastest);
  check.near(
      "V of valueAt", student.valueAt(grid, V, x), wanted, 1e-9,
      {{"Is it the value at the nearest node? Between nodes V is bilinear.", hatSum(grid, V, nearest)},
       {"Is it the value at the node below? Between nodes V is bilinear.", V(i, j)},
       {"Are the angles counted from 0? The first node is at -pi.", hatSum(grid, V, {x[0] + kPi, x[1]})},
       {"Is the first node missing, which follows the last?",
        isLast ? hatSum(grid, V, {i * turn - kPi, x[1]}) : wanted},
       {"Is only the angle interpolated?", hatSum(grid, V, {x[0], j * apart - grid.fastest})},
       {"Is only the rate interpolated?", hatSum(grid, V, {i * turn - kPi, x[1]})},
       {"Are the shares of the cell exchanged? The nearer node counts more.",
        hatSum(grid, V,
               {(2 * i + 1) * turn - 2 * kPi - inside[0], (2 * j + 1) * apart - 2 * grid.fastest - x[1]})}});
}

/// What a torque leads to, from its cost per second and the value after the step.
using Rule = std::function<double(double cost, double after)>;

inline Rule bellman(const Decision& d) {
  return [tau = d.tau, gamma = d.discount](double cost, double after) { return tau * cost + gamma * after; };
}

inline double torqueOf(const Decision& d, int k) {
  return (2 * k - d.torques + 1) * d.pendulum.strongest / (d.torques - 1);
}

enum class Step { kRight, kEuler, kNone };
inline Eigen::VectorXd totals(const Table& table, const Eigen::Vector2d& x, const Rule& rule,
                              Step step = Step::kRight) {
  const auto& [d, V] = table;
  Eigen::VectorXd all(d.torques);
  for (int k = 0; k < d.torques; ++k) {
    const double u = torqueOf(d, k);
    Eigen::Vector2d to = x;
    if (step == Step::kRight) to = nextOf(d.pendulum, x, u, d.tau);
    if (step == Step::kEuler) to += d.tau * rateOf(d.pendulum, x, u);
    all[k] = rule(costOf(x, u, d.effort), hatSum(d.grid, V, to));
  }
  return all;
}

/// A number for each node, whose rates begin at `slowest` and whose angles are `turn` apart.
inline Eigen::MatrixXd atNodes(const Grid& grid, double turn, double slowest,
                               const std::function<double(const Eigen::Vector2d& x, int i, int j)>& number) {
  Eigen::MatrixXd all(grid.angles, grid.rates);
  for (int i = 0; i < all.rows(); ++i)
    for (int j = 0; j < all.cols(); ++j)
      all(i, j) = number({i * turn - kPi, slowest + j * (grid.fastest - slowest) / (grid.rates - 1)}, i, j);
  return all;
}

inline void describe(rex::grading::Check& check, const Decision& d, const Eigen::MatrixXd& V) {
  check.input("a grid of values", {{"m, l, b, g, strongest", numbersOf(d.pendulum)},
                                   {"angles, rates", Eigen::RowVector2d(d.grid.angles, d.grid.rates)},
                                   {"fastest", d.grid.fastest},
                                   {"tau", d.tau},
                                   {"effort", d.effort},
                                   {"discount", d.discount},
                                   {"torques", d.torques},
                                   {"V", V}});
}

inline void sweeps(rex::grading::Check& check, Student& student, const Table& table) {
  const Decision& d = table.decision;
  describe(check, d, table.V);
  const Rule right = bellman(d);
  const double tau = d.tau, gamma = d.discount, turn = 2 * kPi / d.grid.angles, slowest = -d.grid.fastest;
  const auto least = [&](double angle, double rate) {
    return atNodes(d.grid, angle, rate,
                   [&](auto& x, int, int) { return totals(table, x, right).minCoeff(); });
  };
  std::vector<rex::grading::Mistake> mistakes;
  // By the torque that is best by the mistake, and by the one that is really best.
  const auto add = [&](const char* question, const Rule& rule, Step step = Step::kRight) {
    mistakes.emplace_back(question, atNodes(d.grid, turn, slowest, [&](auto& x, int, int) {
                            return totals(table, x, rule, step).minCoeff();
                          }));
    mistakes.emplace_back(question, atNodes(d.grid, turn, slowest, [&](auto& x, int, int) {
                            int best = 0;
                            totals(table, x, right).minCoeff(&best);
                            return totals(table, x, rule, step)[best];
                          }));
  };
  const auto choose = [&](const char* question, const std::function<double(const Eigen::VectorXd&)>& choice) {
    mistakes.emplace_back(question, atNodes(d.grid, turn, slowest, [&](auto& x, int, int) {
                            return choice(totals(table, x, right));
                          }));
  };
  add("Is the cost not multiplied by tau? costOf() is per second.",
      [=](double c, double v) { return c + gamma * v; });
  add("Is nothing discounted?", [=](double c, double v) { return tau * c + v; });
  add("Is the discount applied to the cost of the step, too?",
      [=](double c, double v) { return gamma * (tau * c + v); });
  add("Is the discount taken for that of a second? It is that of a step.",
      [=](double c, double v) { return tau * c + std::pow(gamma, tau) * v; });
  add("Is the cost of the step left out?", [=](double, double v) { return gamma * v; });
  add("Is it the cost of the step alone?", [=](double c, double) { return tau * c; });
  add("Is it V at the node itself? What comes after a step is at nextOf().", right, Step::kNone);
  add("Is the step one of Euler? It has to be nextOf().", right, Step::kEuler);
  choose("Is it the most, not the least?", [](const Eigen::VectorXd& all) { return all.maxCoeff(); });
  choose("Is it the mean over the torques?", [](const Eigen::VectorXd& all) { return all.mean(); });
  choose("Is it always without torque?", [](const Eigen::VectorXd& all) { return all[all.size() / 2]; });
  choose("Is the strongest torque left out? Both ends are among the torques.",
         [](const Eigen::VectorXd& all) { return all.head(all.size() - 1).minCoeff(); });
  mistakes.emplace_back("Do the rates of the nodes begin at 0? They begin at -fastest.", least(turn, 0));
  mistakes.emplace_back("Is the last angle pi? That is the first once more.",
                        least(2 * kPi / (d.grid.angles - 1), slowest));
  Table changing = table;
  atNodes(d.grid, turn, slowest,
          [&](auto& x, int i, int j) { return changing.V(i, j) = totals(changing, x, right).minCoeff(); });
  mistakes.emplace_back("Are values overwritten that other nodes still need?", changing.V);
  check.near("values of swept", student.swept(d, table.V), least(turn, slowest), 1e-9, mistakes);
}

inline void choosesTorques(rex::grading::Check& check, Student& student) {
  Table table;
  Eigen::Vector2d x;
  Eigen::VectorXd all;
  int best = 0, most = 0;
  // The best torque is clearly the best, not zero, and not the first of the list.
  for (double lead = 0; lead < 1e-4;) {
    table = randomTable(check.rng());
    x = {check.rng().uniform(-6, 6), check.rng().uniform(-1, 1) * table.decision.grid.fastest};
    all = totals(table, x, bellman(table.decision));
    const double least = all.minCoeff(&best);
    lead = best == 0 || best == table.decision.torques / 2 ? 0 : INFINITY;
    for (int k = 0; k < all.size(); ++k)
      if (k != best) lead = std::min(lead, all[k] - least);
  }
  const auto& [d, V] = table;
  const Eigen::Vector3d grid(d.grid.angles, d.grid.rates, d.grid.fastest);
  check.input("a state and a grid of values",
              {{"m, l, b, g, strongest", numbersOf(d.pendulum)},
               {"x", x},
               {"angles, rates, fastest", grid},
               {"tau, effort, discount, torques", Eigen::Vector4d(d.tau, d.effort, d.discount, d.torques)},
               {"V", V}});
  const auto at = [&](const Rule& rule) {
    int k = 0;
    totals(table, x, rule).minCoeff(&k);
    return torqueOf(d, k);
  };
  all.maxCoeff(&most);
  // With costs per second, too, the best torque may be 0.
  const double perSecond = at([gamma = d.discount](double c, double v) { return c + gamma * v; });
  check.near("torque of bestTorque", student.bestTorque(d, V, x), torqueOf(d, best), 1e-9,
             {{perSecond == 0 ? "Is the cost not multiplied by tau, or is what comes after the step left out?"
                              : "Is it the torque that costs least at once? Most of the cost comes after.",
               0},
              {"Is the cost not multiplied by tau? costOf() is per second.", perSecond},
              {"Is it the number of the torque?", best},
              {"Is it the least value, not the torque that leads to it?", all[best]},
              {"Is the cost of the step left out?", at([](double, double v) { return v; })},
              {"Is nothing discounted?", at([tau = d.tau](double c, double v) { return tau * c + v; })},
              {"Is it the torque that leads to the most?", torqueOf(d, most)}});
}

/// The least of the library's grid from hanging, followed for 12 s.
inline void climbs(rex::grading::Check& check, Student& student) {
  Decision d{.grid = {.angles = 48, .rates = 49}};
  d.pendulum.strongest = check.rng().uniform(2.5, 4);
  const Pendulum p = d.pendulum;
  const rex::ValueGrid values({.rate = [=](const Eigen::Vector2d& x, double u) { return rateOf(p, x, u); },
                               .cost = [](const Eigen::Vector2d& x, double u) { return costOf(x, u, .02); },
                               .uMin = -p.strongest,
                               .uMax = p.strongest,
                               .discount = .1},
                              {.lower = {-kPi, -9},
                               .upper = {kPi, 9},
                               .nodes = {49, 49},
                               .isAngle = {1, 0},
                               .controls = 9,
                               .tolerance = 1e-3});
  describe(check, d, values.values());
  Eigen::Vector2d x(kPi, 0);
  double nearest = kPi;
  for (int t = 0; t < 240 && nearest > .1; ++t) {
    const double u = student.bestTorque(d, values.values().topRows(48), x);
    x = nextOf(p, x, std::max(-p.strongest, std::min(u, p.strongest)), d.tau);
    nearest = std::min(nearest, std::hypot(std::remainder(x[0], 2 * kPi), x[1] / 4));
  }
  check.atMost("distance from upright that bestTorque reaches on good values", nearest, .3);
}

/// From the velocity of the mass and its height.
inline double workOf(const Pendulum& p, const Eigen::Vector2d& x) {
  const Eigen::Vector2d v = p.length * x[1] * Eigen::Vector2d(std::cos(x[0]), -std::sin(x[0]));
  return p.mass * (v.squaredNorm() / 2 - p.g * (p.length - p.length * std::cos(x[0])));
}

inline void hasEnergy(rex::grading::Check& check, Student& student, const Pendulum& p) {
  const Eigen::Vector2d x(check.rng().uniform(-5, 5), check.rng().uniform(1, 4));
  check.input("a pendulum", {{"m, l, b, g, strongest", numbersOf(p)}, {"x", x}});
  const double E = workOf(p, x), weight = p.mass * p.g * p.length, height = weight * (std::cos(x[0]) - 1),
               kinetic = E - height;
  check.near("energy of energyOf", student.energyOf(p, x), E, 1e-9,
             {{"Is the energy zero hanging? It is zero upright.", E + 2 * weight},
              {"Is the energy zero where the rod is level?", E + weight},
              {"Has the height the wrong sign? Below upright it is negative.", kinetic - height},
              {"Is the mass left out?", E / p.mass},
              {"Is the length not squared? The mass moves at l theta'.", kinetic / p.length + height},
              {"Has the kinetic energy no length? The mass moves at l theta'.",
               kinetic / p.length / p.length + height},
              {"Is the kinetic energy not halved?", 2 * kinetic + height},
              {"Is it the kinetic energy alone?", kinetic},
              {"Is it the potential energy alone?", height},
              {"Is the height l sin(theta)? The angle is that from upright.",
               kinetic + weight * (std::sin(x[0]) - 1)}});
}

inline void pumps(rex::grading::Check& check, Student& student, const Pendulum& p, bool isWeak) {
  rex::Rng& rng = check.rng();
  const auto limited = [&](double u) { return std::max(-p.strongest, std::min(u, p.strongest)); };
  Eigen::Vector2d x;
  double gain = 0, drive = 0, drag = 0, E = 0;
  do {
    x = {rng.uniform(-5, 5), rng.uniform(-4, 4)};
    gain = rng.uniform(.1, 1) / (p.mass * p.length);
    E = workOf(p, x), drive = -gain * x[1] * E, drag = p.friction * x[1];
  } while ((std::abs(drive + drag) > .9 * p.strongest) != isWeak || std::abs(drive) < .2 * p.strongest);
  check.input("a pendulum", {{"m, l, b, g, strongest", numbersOf(p)}, {"gain", gain}, {"x", x}});
  const double swing = 2 * p.mass * p.g * p.length;
  check.near("torque of pumpTorque", student.pumpTorque(p, gain, x), limited(drive + drag), 1e-9,
             {{"Is the motor stronger than it is? Limit the torque.", drive + drag},
              {"Does it take energy away where some is missing? Mind the sign.", limited(drag - drive)},
              {"Is friction left out? It takes energy away, too.", limited(drive)},
              {"Does friction help here? It has the wrong sign.", limited(drive - drag)},
              {"Is it theta'^2? Power is torque times theta'.", limited(drive * x[1] + drag)},
              {"Is theta' left out? Torque and rate have to have the same sign to add energy.",
               limited(-gain * E + drag)},
              {"Is friction added after the limit? The motor has to do that, too.", limited(drive) + drag},
              {"Is the energy zero hanging?", limited(-gain * x[1] * (E + swing) + drag)},
              {"Is the torque always the strongest?", drive > 0 ? p.strongest : -p.strongest},
              {"Is the gain left out?", limited(-x[1] * E + drag)}});
  check.near("torque of pumpTorque at rest", student.pumpTorque(p, gain, {x[0], 0}), 0, 1e-12);
}

/// A regulator for small angles, as strong as the motor.
inline Swing regulatorOf(const Pendulum& p) {
  const double inertia = p.mass * p.length * p.length, weight = p.mass * p.g * p.length;
  const Eigen::Matrix2d A{{0, 1}, {p.g / p.length, -p.friction / inertia}};
  const rex::RiccatiResult best = rex::lqr({.A = A, .B = Eigen::Vector2d(0, 1 / inertia)},
                                           Eigen::Vector2d(10, 1).asDiagonal().toDenseMatrix(),
                                           Eigen::MatrixXd::Constant(1, 1, 100 / weight / weight));
  return {.gain = 1.5 * p.strongest / std::pow(weight, 1.5) * std::sqrt(p.mass) * p.length,
          .K = -best.K.row(0),
          .P = best.X};
}
inline Flow regulated(const Pendulum& p, const Swing& swing) {
  return [=](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return rateOf(p, x, std::max(-p.strongest, std::min(swing.K.dot(x), p.strongest)));
  };
}

/// V at the first place at which it does not fall, along each of many rays.
inline Eigen::VectorXd edgesOf(const Flow& f, const Eigen::Matrix2d& P, double most, int rays) {
  const Eigen::Matrix2d root = P.llt().matrixU();
  Eigen::VectorXd edges = Eigen::VectorXd::Constant(rays, most);
  for (int k = 0; k < rays; ++k) {
    const Eigen::Vector2d circle(std::cos(2 * kPi * k / rays), std::sin(2 * kPi * k / rays)),
        ray = root.triangularView<Eigen::Upper>().solve(circle), slope = P * ray;
    for (double size = .002; size < 1; size += .002)
      if (slope.dot(f(size * std::sqrt(most) * ray)) >= 0) {
        edges[k] = size * size * most;
        break;
      }
  }
  return edges;
}

struct Region {
  Flow f;
  Eigen::Matrix2d P;
  double level = 0;
};
inline Region regionOf(const Flow& f, const Eigen::Matrix2d& P) {
  double most = 1e-3 * P.norm();
  while (edgesOf(f, P, most, 40).minCoeff() == most) most *= 4;
  return {f, P, edgesOf(f, P, most, 2000).minCoeff()};
}

/// Van der Pol's oscillator backward in time, its first state in some unit.
inline Region randomOscillator(rex::Rng& rng) {
  const double mu = rng.uniform(.5, 2), unit = rng.uniform(.3, 3);
  const Eigen::Matrix2d A{{0, -1 / unit}, {unit, -mu}};
  const Flow f = [=](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return A * x + Eigen::Vector2d(0, mu * unit * unit * x[0] * x[0] * x[1]);
  };
  return regionOf(f, rex::solveLyapunov(A, Eigen::Matrix2d::Identity()));
}

inline void fallsBelow(rex::grading::Check& check, Student& student, const std::string& name,
                       const Region& region) {
  const double most = region.level * check.rng().uniform(2, 5);
  check.input(name, {{"P", region.P}, {"most", most}, {"largest level", region.level}});
  int asked = 0;
  const Flow f = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    ++asked;
    return x.size() == 2 && x.allFinite() ? region.f(x) : Eigen::VectorXd::Zero(2);
  };
  const double got = student.fallingLevel(f, region.P, most);
  check.atMost("number of calls of f by fallingLevel", asked, 100000);
  const Eigen::VectorXd four = edgesOf(region.f, region.P, most, 4),
                        many = edgesOf(region.f, region.P, most, 400);
  const auto is = [&](double level) { return std::abs(got / level - 1) < .03; };
  const auto square = check.ask("Is it a length? V grows with its square.", is(std::sqrt(region.level)));
  const auto whole = check.ask(
      "Is it `most`? V rises below, on some rays: are there enough, and does the worst decide?", is(most));
  const auto mean = check.ask("Is it the mean over the rays? The worst of them decides.", is(many.mean()));
  const auto largest =
      check.ask("Is it the largest level over the rays? The worst of them decides.", is(many.maxCoeff()));
  const auto few = check.ask("Are there enough rays, and small enough steps on each?",
                             got > region.level && got < four.maxCoeff() * 1.1);
  const auto high = check.ask("Where on the ellipse of this level does V rise?", got > region.level);
  const auto low = check.ask("Is the level far below the first place at which V rises?");
  check.atMost("level of fallingLevel", got, 1.02 * region.level);
  check.atLeast("level of fallingLevel", got, .9 * region.level);
}

/// Which torque a swing uses; wrong ones are what mistakes lead to.
using Law = std::function<double(const Eigen::Vector2d& wrapped, const Eigen::Vector2d& plain)>;
inline Eigen::MatrixXd motionBy(const Pendulum& p, const Eigen::Vector2d& start, double tau, int steps,
                                const Law& law, bool byEuler = false) {
  Eigen::MatrixXd X(2, steps + 1);
  X.col(0) = start;
  for (int t = 1; t <= steps; ++t) {
    const Eigen::Vector2d before = X.col(t - 1), wrapped(std::remainder(before[0], 2 * kPi), before[1]);
    const double u = law(wrapped, before);
    X.col(t) = byEuler ? Eigen::Vector2d(before + tau * rateOf(p, before, u)) : nextOf(p, before, u, tau);
    X.col(t) = X.col(t).cwiseMax(-1e6).cwiseMin(1e6);
  }
  return X;
}

inline void swingsUp(rex::grading::Check& check, Student& student, const Pendulum& p, double angle,
                     int steps) {
  Swing swing = regulatorOf(p);
  swing.level = .95 * regionOf(regulated(p, swing), swing.P).level;
  Eigen::Vector2d start(angle, check.rng().uniform(.05, .2) * std::sqrt(p.g / p.length));
  // Upright: where the controller wants most, within the level.
  if (angle == 0) {
    const Eigen::Vector2d x = swing.P.llt().solve(swing.K.transpose());
    start = std::sqrt(.9 * swing.level / swing.K.dot(x)) * x;
  }
  check.input("a pendulum", {{"m, l, b, g, strongest", numbersOf(p)},
                             {"gain", swing.gain},
                             {"K", swing.K},
                             {"P", swing.P},
                             {"level", swing.level},
                             {"start", start},
                             {"steps", steps}});
  const auto limited = [&](double u) { return std::max(-p.strongest, std::min(u, p.strongest)); };
  const auto pumping = [&](const Eigen::Vector2d& x) {
    return limited((p.friction - swing.gain * workOf(p, x)) * x[1]);
  };
  const auto near = [&](const Eigen::Vector2d& x) { return x.dot(swing.P * x) < swing.level; };
  const auto by = [&](const Law& law) { return motionBy(p, start, swing.tau, steps, law); };
  const Law right = [&](const Eigen::Vector2d& x, const Eigen::Vector2d&) {
    return near(x) ? limited(swing.K.dot(x)) : pumping(x);
  };
  const Eigen::MatrixXd wanted = by(right), got = student.swungUp(p, swing, start, steps);
  check.shape("states of swungUp", got, 2, steps + 1);
  // Where the motions part, the next state shows whether the torque was that of the other controller.
  Eigen::Index last = 0;
  while (last + 1 < steps && (got.col(last + 1) - wanted.col(last + 1)).norm() < 1e-6) ++last;
  const Eigen::Vector2d there = wanted.col(last), seen(std::remainder(there[0], 2 * kPi), there[1]);
  const auto isUsed = [&](double u) {
    return (got.col(last + 1) - nextOf(p, there, u, swing.tau)).norm() < 1e-5;
  };
  Eigen::MatrixXd apart = got - wanted;
  apart.row(0) = apart.row(0).unaryExpr([](double turned) { return std::remainder(turned, 2 * kPi); });
  const auto wrapped =
      check.ask("Were whole turns taken from the states? Only the controllers get an angle from -pi to pi.",
                apart.cwiseAbs().maxCoeff() < 1e-5);
  const auto region = check.ask("Is it x^T P x < level, and nothing else, that decides which torque is used?",
                                isUsed(near(seen) ? pumping(seen) : limited(swing.K.dot(seen))));
  check.near(
      "states of swungUp", got, wanted, 1e-5,
      {{"Is the angle of the catch not brought to -pi ... pi?",
        by([&](auto&, auto& y) { return near(y) ? limited(swing.K.dot(y)) : pumping(y); })},
       {"Is the angle brought to -pi ... pi for the level, but not for K?",
        by([&](auto& x, auto& y) { return near(x) ? limited(swing.K.dot(y)) : pumping(x); })},
       {"Does it pump only? Where x^T P x < level, u = K x.", by([&](auto& x, auto&) { return pumping(x); })},
       {"Is it u = K x everywhere?", by([&](auto& x, auto&) { return limited(swing.K.dot(x)); })},
       {"Is the sign that of u = -K x?",
        by([&](auto& x, auto&) { return near(x) ? limited(-swing.K.dot(x)) : pumping(x); })},
       {"Is K x limited to what the motor can?",
        by([&](auto& x, auto&) { return near(x) ? swing.K.dot(x) : pumping(x); })},
       {"Is it `level` that has to be exceeded? The catch is where V is small.",
        by([&](auto& x, auto&) { return near(x) ? pumping(x) : limited(swing.K.dot(x)); })},
       {"Are both torques added in the catch?",
        by([&](auto& x, auto&) { return near(x) ? limited(swing.K.dot(x) + pumping(x)) : pumping(x); })},
       {"Are the steps Euler's? They have to be nextOf().",
        motionBy(p, start, swing.tau, steps, right, true)}});
}

/// The slope of the cost by differences, with factors of its terms.
inline Eigen::VectorXd slopeBy(Journey journey, const Eigen::VectorXd& U, double effort = 1,
                               double last = 1) {
  journey.effort *= effort, journey.last *= last;
  Eigen::VectorXd slope(U.size());
  for (Eigen::Index t = 0; t < U.size(); ++t) {
    const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(U.size(), t);
    slope[t] = (priceOf(journey, U + step) - priceOf(journey, U - step)) / 2e-5;
  }
  return slope;
}

inline Journey randomJourney(rex::Rng& rng, double angle) {
  return {.pendulum = randomPendulum(rng),
          .start = {angle, rng.uniform(-1, 1)},
          .tau = rng.uniform(.03, .06),
          .effort = rng.uniform(.1, .4),
          .last = rng.uniform(5, 20)};
}

inline void describe(rex::grading::Check& check, const Journey& journey, const Eigen::VectorXd& U) {
  check.input("a journey", {{"m, l, b, g, strongest", numbersOf(journey.pendulum)},
                            {"start", journey.start},
                            {"tau", journey.tau},
                            {"effort", journey.effort},
                            {"last", journey.last},
                            {"U", U}});
}

inline void slopes(rex::grading::Check& check, Student& student, int N) {
  const Journey journey = randomJourney(check.rng(), check.rng().uniform(-3, 3));
  const Eigen::VectorXd U = check.rng().uniformVector(N, -2, 2);
  describe(check, journey, U);
  const Eigen::VectorXd wanted = slopeBy(journey, U), effort = 2 * journey.tau * journey.effort * U;
  const Eigen::VectorXd withoutLast = slopeBy(journey, U, 1, 0);
  const auto back = check.ask(
      "Which state does a torque move, the one before its step or the one after it? And what takes the worth "
      "of a state "
      "back by a step, A or its transpose?");
  check.near("slope of costSlope", student.costSlope(journey, U), wanted, 1e-6 * (1 + wanted.norm()),
             {{"Is the effort left out, which u costs by itself?", wanted - effort},
              {"Is it the slope of the effort alone? A torque also moves all later states.", effort},
              {"Is the cost of the last state left out?", withoutLast},
              {"Is the cost of the states on the way left out?", wanted - withoutLast + effort},
              {"Is the effort not multiplied by tau?", wanted + (1 / journey.tau - 1) * effort},
              {"Is the effort's slope not doubled?", wanted - effort / 2},
              {"Is the cost of the last state weighted with tau, like the others?",
               withoutLast + journey.tau * (wanted - withoutLast)}});
}

inline void plans(rex::grading::Check& check, Student& student, double angle, int N) {
  const Journey journey = randomJourney(check.rng(), angle);
  const Eigen::VectorXd U = check.rng().uniformVector(N, -.5, .5);
  describe(check, journey, U);
  const Eigen::VectorXd got = student.planned(journey, U);
  check.shape("torques of planned", got, N, 1);
  check.atMost("largest torque of planned", got.cwiseAbs().maxCoeff(), 1e4, "N m");
  const double before = slopeBy(journey, U).cwiseAbs().maxCoeff(),
               after = slopeBy(journey, got).cwiseAbs().maxCoeff();
  const auto soon = check.ask(
      "The slope is smaller than at first, but not zero: does the search end too soon?", after < .5 * before);
  const auto worse = check.ask("Does each change lower the cost? If not, take a part of it.",
                               priceOf(journey, got) >= priceOf(journey, U));
  const auto sign = check.ask("Does the search follow the slope, uphill or downhill?");
  check.atMost("largest number of the slope at the torques of planned", after, 1.01e-3);
  check.atMost("cost of the torques of planned", priceOf(journey, got), priceOf(journey, U));
}
