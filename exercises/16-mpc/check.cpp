#include "grading/check.h"

#include <cmath>
#include <string>

#include "control/regulators.h"
#include "grading/evidence.h"
#include "hand_checks.h"
#include "interface.h"
#include "plans.h"

using rex::grading::Check;
using rex::grading::Evidence;
using rex::grading::Group;

namespace {

// The row that differs most, of both.
Evidence alongRow(const std::string& title, const std::string& xLabel, const std::string& yLabel,
                  const Eigen::MatrixXd& got, const Eigen::MatrixXd& wanted) {
  if (got.rows() != wanted.rows() || got.cols() != wanted.cols() || got.size() == 0) return {};
  Eigen::Index row = 0, worst = 0;
  const double apart = (got - wanted).cwiseAbs().maxCoeff(&row, &worst);
  const auto curve = [&](rex::Series series, const Eigen::MatrixXd& values) {
    for (Eigen::Index t = 0; t < values.cols(); ++t) series.add(static_cast<double>(t), values(row, t));
    return series;
  };
  Evidence evidence{.figures = {{.title = title,
                                 .xLabel = xLabel,
                                 .yLabel = got.rows() > 1 ? yLabel + " " + std::to_string(row) : yLabel,
                                 .series = {curve(rex::grading::gotCurve("got"), got),
                                            curve(rex::grading::wantedCurve("wanted"), wanted)}}}};
  if (apart > 0)
    evidence.figures[0].series.push_back(
        rex::grading::wrongPoint("differs most", static_cast<double>(worst), got(row, worst)));
  return evidence;
}

// Part 1.

void predicts(Check& check, Student& student, const Plant& plant, int N) {
  check.input("a plant", {{"A", plant.A}, {"B", plant.B}, {"N", N}});
  const Prediction got = student.predicted(plant, N), wanted = measuredPrediction(plant, N);
  const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
  const double tolerance = 1e-9 * (1 + wanted.Su.cwiseAbs().maxCoeff() + wanted.Sx.cwiseAbs().maxCoeff());
  check.shape("Sx", got.Sx, N * n, n);
  check.shape("Su", got.Su, N * n, N * m);
  {
    const auto shown =
        check.show([&] { return Evidence{.figures = {rex::grading::comparison("Sx", got.Sx, wanted.Sx)}}; });
    check.near("Sx", got.Sx, wanted.Sx, tolerance);
  }
  const auto shown =
      check.show([&] { return Evidence{.figures = {rex::grading::comparison("Su", got.Su, wanted.Su)}}; });
  check.near("Su", got.Su, wanted.Su, tolerance);
}

void predictsSled(Check& check, Student& student) {
  predicts(check, student, sled(.5), 3);
  predicts(check, student, randomPlant(3, 2, .9, check.rng()), 4);
}

// Part 2.

void costs(Check& check, Student& student, const Plant& plant, const Costs& weights, int N) {
  const Eigen::VectorXd x = roundedMatrix(plant.A.rows(), 1, 2, check.rng());
  check.input("a plant and costs", {{"A", plant.A},
                                    {"B", plant.B},
                                    {"Q", weights.Q},
                                    {"R", weights.R},
                                    {"F", weights.F},
                                    {"N", N},
                                    {"x", x}});
  const Eigen::Index size = N * plant.B.cols();
  const Quadratic got = student.planCost(plant, weights, N, x),
                  wanted = measuredQuadratic(
                      size, [&](const Eigen::VectorXd&U) { return costOf(plant, weights, x, U); });
  const double tolerance = 1e-9 * (1 + wanted.H.cwiseAbs().maxCoeff() + wanted.g.cwiseAbs().maxCoeff() +
                                   std::abs(costOf(plant, weights, x, Eigen::VectorXd::Zero(size))));
  check.shape("H", got.H, size, size);
  check.shape("g", got.g, size, 1);
  const auto require = [&](const std::string& name, const Eigen::MatrixXd& mine,
                           const Eigen::MatrixXd& right) {
    const auto shown =
        check.show([&] { return Evidence{.figures = {rex::grading::comparison(name, mine, right)}}; });
    check.near(name, mine, right, tolerance);
  };
  require("H", got.H, wanted.H);
  require("g", got.g, wanted.g);
}

void costsSled(Check& check, Student& student) {
  const Plant plant = sled(1);
  costs(check, student, plant,
        {Eigen::Vector2d(1, .5).asDiagonal(), Eigen::MatrixXd::Constant(1, 1, .2),
         Eigen::Vector2d(3, 2).asDiagonal()},
        2);
  const Plant other = randomPlant(3, 2, 1, check.rng());
  costs(check, student, other, randomCosts(other, check.rng()), 4);
}

// A plant whose best closed loop decays at least like 0.96^t.
struct Regulated {
  Plant plant;
  Costs costs;
  rex::RiccatiResult right;
};
Regulated regulated(Eigen::Index n, Eigen::Index m, double growth, rex::Rng& rng) {
  for (;;) {
    Regulated r;
    r.plant = randomPlant(n, m, growth, rng);
    r.costs = randomCosts(r.plant, rng);
    r.right = rex::lqr({.A = r.plant.A, .B = r.plant.B, .step = 1.}, r.costs.Q, r.costs.R);
    if (r.right.status != rex::RiccatiStatus::kSolved) continue;
    const double slowest = r.right.closedLoop.cwiseAbs().maxCoeff();
    if (slowest < .96 && r.right.X.cwiseAbs().maxCoeff() < 1000) return r;
  }
}

void goes(Check& check, Student& student, const Regulated& r) {
  const Eigen::MatrixXd &A = r.plant.A, &B = r.plant.B, &Q = r.costs.Q, &R = r.costs.R, &wanted = r.right.X;
  check.input("a plant and costs", {{"A", A}, {"B", B}, {"Q", Q}, {"R", R}});
  const Eigen::MatrixXd got = student.costToGo(r.plant, Q, R);
  check.shape("F of costToGo", got, A.rows(), A.rows());
  const double scale = wanted.cwiseAbs().maxCoeff();
  const auto skew = check.ask("Is F not symmetric? Rounding errors may grow from step to step.",
                              (got - got.transpose()).cwiseAbs().maxCoeff() > 1e-6 * scale);
  const auto early =
      check.ask("Does the iteration end too early?", (got - wanted).cwiseAbs().maxCoeff() < .2 * scale);
  const auto shown = check.show(
      [&] { return Evidence{.figures = {rex::grading::comparison("F of costToGo", got, wanted)}}; });
  check.near("F of costToGo", got, wanted, 1e-6 * scale);
}

void goesOn(Check& check, Student& student) {
  const Plant plant = sled(1);
  const Costs weights{Eigen::Vector2d(1, 1).asDiagonal(), Eigen::MatrixXd::Constant(1, 1, 1.), {}};
  goes(check, student,
       {plant, weights, rex::lqr({.A = plant.A, .B = plant.B, .step = 1.}, weights.Q, weights.R)});
  goes(check, student, regulated(3, 1, 1.2, check.rng()));
}

// Part 3.

void moves(Check& check, Student& student, const BoxedCase& c) {
  const Eigen::Index size = c.cost.g.size();
  const Eigen::VectorXd z = within(check.rng().normalVector(static_cast<int>(size)), c.lower, c.upper);
  check.input("a cost with bounds",
              {{"H", c.cost.H}, {"g", c.cost.g}, {"lower", c.lower}, {"upper", c.upper}, {"z", z}});
  const Eigen::VectorXd got = student.bestMoves(c.cost, c.lower, c.upper, z);
  // The minimum of a parabola through three values, for each number.
  const auto f = [&](const Eigen::VectorXd& at) { return .5 * at.dot(c.cost.H * at) + c.cost.g.dot(at); };
  Eigen::VectorXd free(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    Eigen::VectorXd more = z, less = z;
    more[i] += 1;
    less[i] -= 1;
    free[i] = (f(less) - f(more)) / 2 / (f(more) - 2 * f(z) + f(less));
  }
  const Eigen::VectorXd wanted = within(z + free, c.lower, c.upper) - z;
  const auto shown = check.show(
      [&] { return alongRow("bestMoves", "number", "move", got.transpose(), wanted.transpose()); });
  check.shape("bestMoves", got, size, 1);
  check.near("bestMoves", got, wanted,
             1e-9 * (1 + free.cwiseAbs().maxCoeff()) * std::sqrt(conditionOf(c.cost.H)));
}

BoxedCase smallCase() {
  BoxedCase c;
  c.cost = {(Eigen::MatrixXd(2, 2) << 2, 1.7, 1.7, 2).finished(), Eigen::Vector2d(-3.6, -1.9)};
  c.lower = Eigen::Vector2d(-1, -1);
  c.upper = Eigen::Vector2d(1, 1);
  return c;
}

void movesAlone(Check& check, Student& student) {
  moves(check, student, smallCase());
  moves(check, student, randomBoxedCase(4, 10, check.rng()));
  check.forEachCase(4, [&](int i) { moves(check, student, randomBoxedCase(8 + i, 100, check.rng())); });
}

void boxes(Check& check, Student& student, const BoxedCase& c, bool goesRound = false) {
  const Eigen::Index size = c.cost.g.size();
  check.input("a cost with bounds",
              {{"H", c.cost.H}, {"g", c.cost.g}, {"lower", c.lower}, {"upper", c.upper}});
  const Eigen::VectorXd got = student.boxed(c.cost, c.lower, c.upper);
  const Eigen::VectorXd wanted = boundedMinimum(c.cost, c.lower, c.upper);
  const Eigen::VectorXd free = -rex::solve(c.cost.H, c.cost.g);
  check.shape("z of boxed", got, size, 1);
  {
    const auto boundless = check.ask("Are the bounds forgotten?", (got - free).cwiseAbs().maxCoeff() < 1e-6);
    check.atMost("how far z of boxed is outside of its bounds",
                 (got - within(got, c.lower, c.upper)).cwiseAbs().maxCoeff(), 1e-12);
  }
  const Eigen::VectorXd cutOff = within(free, c.lower, c.upper),
                        held = neverReleased(c.cost, c.lower, c.upper);
  const char* onCut = (cutOff - held).norm() < 1e-6
                          ? "Does all that was beyond a bound stay at it? If one is held, the others move."
                          : "Is it the minimum without bounds, cut off? The others move if one is held.";
  const auto cut = check.suspect(onCut, cutOff);
  const char* onCircles = "Are all numbers held, or let go, at once? That may go round in circles.";
  const auto stuck = check.suspect(
      goesRound ? onCircles : "Does a number never leave a bound again? It must, if its slope leads inside.",
      held);
  const auto circles = check.ask(onCircles, goesRound);
  const auto early = check.ask("Does it end too early?", (got - wanted).cwiseAbs().maxCoeff() < .02);
  const auto shown =
      check.show([&] { return alongRow("boxed", "number", "z", got.transpose(), wanted.transpose()); });
  check.near("z of boxed", got, wanted, 1e-4);
  const Eigen::VectorXd slope = c.cost.H * got + c.cost.g;
  const Eigen::VectorXd left = within(got - slope.cwiseQuotient(c.cost.H.diagonal()), c.lower, c.upper) - got;
  check.atMost("largest of the bestMoves that are left", left.cwiseAbs().maxCoeff(), 1e-8);
}

// Of Curtis, Han and Robinson (2015): a method that holds and lets go all at once goes round in circles.
BoxedCase roundabout() {
  BoxedCase c;
  c.cost = {(Eigen::MatrixXd(3, 3) << 4, 5, -5, 5, 9, -5, -5, -5, 7).finished(), Eigen::Vector3d(2, 1, -3)};
  c.upper = Eigen::Vector3d(0, 0, 0);
  c.lower = Eigen::Vector3d::Constant(-kNoLimit);
  return c;
}

void boxesSmall(Check& check, Student& student) {
  boxes(check, student, smallCase());
  boxes(check, student, roundabout(), true);
  check.forEachCase(6, [&](int i) { boxes(check, student, randomBoxedCase(3 + i, 20, check.rng())); });
}

// Part 4.

// The plan of a task, cut off.
Eigen::MatrixXd cutPlan(const Task& task, const Eigen::VectorXd& x) {
  Task unbounded = task;
  unbounded.uMin.setConstant(-kNoLimit);
  unbounded.uMax.setConstant(kNoLimit);
  const Eigen::MatrixXd U = bestPlan(unbounded, x);
  return U.cwiseMax(task.uMin.replicate(1, task.N)).cwiseMin(task.uMax.replicate(1, task.N));
}

Eigen::MatrixXd boundedAtFirst(const Task& task, const Eigen::VectorXd& x) {
  const Eigen::Index m = task.uMin.size(), size = m * task.N;
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(size, -kNoLimit), upper = -lower;
  lower.head(m) = task.uMin;
  upper.head(m) = task.uMax;
  return boundedMinimum(costOfPlans(task, x), lower, upper).reshaped(m, task.N);
}

Eigen::MatrixXd misread(const Eigen::MatrixXd& plan) {
  const Eigen::VectorXd U = plan.reshaped();
  Eigen::MatrixXd rows(plan);
  for (Eigen::Index i = 0; i < plan.rows(); ++i)
    rows.row(i) = U.segment(i * plan.cols(), plan.cols()).transpose();
  return rows;
}

// Of a drive also the pushes, of a corridor its limits.
void inputOf(Check& check, const Task& task, const Eigen::VectorXd& x, const Eigen::MatrixXd& pushes,
             const Corridor& corridor) {
  const rex::grading::InputValue A("A", task.plant.A), B("B", task.plant.B), Q("Q", task.costs.Q),
      R("R", task.costs.R), F("F", task.costs.F), N("N", task.N), uMin("uMin", task.uMin),
      uMax("uMax", task.uMax), start("x", x);
  if (pushes.size() > 0)
    check.input("a task and pushes", {A, B, Q, R, F, N, uMin, uMax, start, {"pushes", pushes}});
  else if (corridor.xMin.size() > 0)
    check.input("a task and a corridor", {A,
                                          B,
                                          Q,
                                          R,
                                          F,
                                          N,
                                          uMin,
                                          uMax,
                                          start,
                                          {"xMin", corridor.xMin},
                                          {"xMax", corridor.xMax},
                                          {"weight", corridor.weight}});
  else
    check.input("a task", {A, B, Q, R, F, N, uMin, uMax, start});
}

void plans(Check& check, Student& student, const Task& task, const Eigen::VectorXd& x) {
  inputOf(check, task, x, {}, {});
  const Eigen::MatrixXd got = student.planned(task, x), wanted = bestPlan(task, x);
  const Eigen::Index m = task.uMin.size();
  check.shape("U of planned", got, m, task.N);
  const auto cut = check.suspect("Is it the plan without bounds, cut off?", cutPlan(task, x));
  const auto first = check.suspect("Do the bounds hold in the first step only?", boundedAtFirst(task, x));
  const auto order = check.suspect(
      "Are the numbers of U read in the wrong order? Each m of them are one step.", misread(wanted));
  const auto shown = check.show([&] { return alongRow("The plan", "step", "control", got, wanted); });
  check.near("U of planned", got, wanted, 1e-4);
}

Task sledTask(double tau, int N) {
  Task task{.plant = sled(tau), .N = N};
  task.costs = {Eigen::Vector2d(1, 0).asDiagonal(), Eigen::MatrixXd::Constant(1, 1, .2), {}};
  task.costs.F = Eigen::Vector2d(4, 2).asDiagonal();
  task.uMin = Eigen::VectorXd::Constant(1, -1);
  task.uMax = Eigen::VectorXd::Constant(1, .6);
  return task;
}

void plansSled(Check& check, Student& student) {
  plans(check, student, sledTask(.5, 6), Eigen::Vector2d(3, 1));
  rex::Rng& rng = check.rng();
  plans(check, student, randomTask(3, 2, 5, 1.1, rng), roundedMatrix(3, 1, 3, rng));
}

void drives(Check& check, Student& student, const Task& task, const Eigen::VectorXd& start,
            const Eigen::MatrixXd& pushes) {
  inputOf(check, task, start, pushes, {});
  const Drive got = student.driven(task, start, pushes);
  const rex::PredictiveController controller = controllerOf(task);
  const Driver best = [&](int, const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return controller.plan(x).U.col(0);
  };
  const Eigen::MatrixXd first = controller.plan(start).U;
  const Driver blind = [&](int t, const Eigen::VectorXd&) -> Eigen::VectorXd {
    return t < task.N ? Eigen::VectorXd(first.col(t)) : Eigen::VectorXd::Zero(first.rows());
  };
  // Plans again only once a plan is used up.
  Eigen::MatrixXd current;
  const Driver patient = [&](int t, const Eigen::VectorXd& x) -> Eigen::VectorXd {
    if (t % task.N == 0) current = controller.plan(x).U;
    return current.col(t % task.N);
  };
  const Driver last = [&](int, const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return controller.plan(x).U.col(task.N - 1);
  };
  const Driver fromStart = [&](int, const Eigen::VectorXd&) -> Eigen::VectorXd { return first.col(0); };
  const Drive wanted = driveBy(best, task.plant, start, pushes),
              calm = driveBy(best, task.plant, start, Eigen::MatrixXd::Zero(pushes.rows(), pushes.cols()));
  const auto following = [&](const Driver& driver) { return driveBy(driver, task.plant, start, pushes).X; };
  check.shape("X of driven", got.X, wanted.X.rows(), wanted.X.cols());
  check.shape("U of driven", got.U, wanted.U.rows(), wanted.U.cols());
  const auto isBlind = check.suspect("Is the first plan followed to its end? A new one is made in each step.",
                                     following(blind));
  const auto isPatient =
      check.suspect("Is a plan followed to its end? A new one is made in each step.", following(patient));
  const auto isLast = check.suspect(
      "Is the last control of each plan used? It is the first one that counts now.", following(last));
  const auto isStart = check.suspect("Are all plans made from the start?", following(fromStart));
  const auto isCalm = check.suspect("Are there no pushes?", calm.X);
  const auto shown = check.show([&] { return alongRow("The drive", "step", "state", got.X, wanted.X); });
  check.near("X of driven", got.X, wanted.X, 1e-3);
  check.near("U of driven", got.U, wanted.U, 1e-3);
}

Eigen::MatrixXd rarePushes(Eigen::Index n, Eigen::Index T, double size, rex::Rng& rng) {
  Eigen::MatrixXd pushes = Eigen::MatrixXd::Zero(n, T);
  for (Eigen::Index t = 3; t < T; t += 6) pushes.col(t) = roundedMatrix(n, 1, size, rng);
  return pushes;
}

void drivesSled(Check& check, Student& student) {
  drives(check, student, sledTask(.5, 8), Eigen::Vector2d(4, 0), rarePushes(2, 20, .5, check.rng()));
}

// Asks for the time alone; that of a wrong drive does not count.
void drivesLong(Check& check, Student& student) {
  constexpr int kSteps = 60;
  rex::Rng& rng = check.rng();
  const Task task = randomTask(4, 2, 25, .95, rng);
  const Eigen::VectorXd start = roundedMatrix(4, 1, 2, rng);
  const Eigen::MatrixXd pushes = rarePushes(4, kSteps, .5, rng);
  inputOf(check, task, start, pushes, {});
  const Drive got = student.driven(task, start, pushes);
  check.shape("U of driven", got.U, 2, kSteps);
  const rex::PredictiveController controller = controllerOf(task);
  const Drive right =
      driveBy([&](int, const Eigen::VectorXd& x) -> Eigen::VectorXd { return controller.plan(x).U.col(0); },
              task.plant, start, pushes);
  if ((got.U - right.U).cwiseAbs().maxCoeff() < 1e-3) check.recordTime("time of 60 plans of 50 numbers each");
}

// Part 6.

void keeps(Check& check, Student& student, const Task& task, const Corridor& corridor,
           const Eigen::VectorXd& x) {
  inputOf(check, task, x, {}, corridor);
  const Eigen::MatrixXd got = student.plannedWithin(task, corridor, x);
  const auto planWith = [&](double factor) {
    Corridor other = corridor;
    other.weight *= factor;
    return bestPlanWithin(task, other, x);
  };
  const Eigen::MatrixXd wanted = planWith(1), without = bestPlan(task, x);
  check.shape("U of plannedWithin", got, wanted.rows(), wanted.cols());
  Corridor onlyAbove = corridor, onlyBelow = corridor;
  onlyAbove.xMin.setConstant(-kNoLimit);
  onlyBelow.xMax.setConstant(kNoLimit);
  check.atMost("how far U of plannedWithin is outside of its bounds",
               (got - got.cwiseMax(task.uMin.replicate(1, task.N)).cwiseMin(task.uMax.replicate(1, task.N)))
                   .cwiseAbs()
                   .maxCoeff(),
               1e-9);
  const auto ignored = check.suspect("Is the corridor ignored?", without);
  const auto half =
      check.suspect("Is the weight of the corridor only half as large as it should be?", planWith(.5));
  const auto twice =
      check.suspect("Is the weight of the corridor twice as large as it should be?", planWith(2));
  const auto cut = check.suspect("Is it the plan without a bound of controls, cut off?", [&] {
    Task unbounded = task;
    unbounded.uMin.setConstant(-kNoLimit);
    unbounded.uMax.setConstant(kNoLimit);
    const Eigen::MatrixXd U = bestPlanWithin(unbounded, corridor, x);
    return Eigen::MatrixXd(
        U.cwiseMax(task.uMin.replicate(1, task.N)).cwiseMin(task.uMax.replicate(1, task.N)));
  }());
  const auto above = check.suspect("Does only xMax count?", bestPlanWithin(task, onlyAbove, x));
  const auto below = check.suspect("Does only xMin count?", bestPlanWithin(task, onlyBelow, x));
  const auto shown = check.show([&] { return alongRow("The plan", "step", "control", got, wanted); });
  check.near("U of plannedWithin", got, wanted, 1e-3);
}

void keepsFromWall(Check& check, Student& student) {
  const Corridor wall{Eigen::Vector2d(-.1, -.8), Eigen::Vector2d(1, kNoLimit), 2};
  keeps(check, student, sledTask(.5, 10), wall, Eigen::Vector2d(1.9, -1.4));
}

// <hidden>
void predictsMore(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    rex::Rng& rng = check.rng();
    predicts(check, student, randomPlant(1 + i, 1 + (i + 1) % 3, .7 + .1 * i, rng), 1 + 3 * i);
  });
}

void costsMore(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    rex::Rng& rng = check.rng();
    const Plant plant = randomPlant(1 + i, 1 + i % 3, .7 + .1 * i, rng);
    costs(check, student, plant, randomCosts(plant, rng), 1 + 2 * i);
  });
}

void goesFurther(Check& check, Student& student) {
  check.forEachCase(
      8, [&](int i) { goes(check, student, regulated(1 + i % 5, 1 + i % 2, .8 + .1 * i, check.rng())); });
}

void boxesMore(Check& check, Student& student) {
  check.forEachCase(
      12, [&](int i) { boxes(check, student, randomBoxedCase(1 + 5 * i, i < 6 ? 100 : 3000, check.rng())); });
}

void plansMore(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    rex::Rng& rng = check.rng();
    Task task = randomTask(1 + i % 4, 1 + i % 3, 2 + 2 * i, .8 + .05 * i, rng);
    // A motor that cannot stop.
    if (i % 4 == 3) task.uMin[0] = .5 * task.uMax[0];
    plans(check, student, task, roundedMatrix(task.plant.A.rows(), 1, 3, rng));
  });
}

void drivesMore(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    rex::Rng& rng = check.rng();
    const Task task = randomTask(2 + i % 2, 1 + i % 2, 4 + 3 * i, .9, rng);
    const Eigen::Index n = task.plant.A.rows();
    drives(check, student, task, roundedMatrix(n, 1, 2, rng), rarePushes(n, 20, .5, rng));
  });
}

void tracesMore(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    rex::Rng& rng = check.rng();
    const bool isLong = i % 2 == 0;
    Line line{.robot = isLong ? "arm7.ors" : "pegArm2.ors",
              .body = isLong ? "arm7" : "peg",
              .rel = rng.uniformVector(3, -.1, .1)};
    const rex::Simulator S(line.robot);
    const int n = S.getJointDimension();
    line.q = S.getJointAngles() + .5 * rng.normalVector(n);
    line.limits = {line.q - rng.uniformVector(n, .1, .6), line.q + rng.uniformVector(n, .1, .6),
                   rng.uniformVector(n, .3, 1.5)};
    line.goal = armOf(line)(line.q).p + .4 * rng.normalVector(3).normalized();
    line.pace = rng.uniform(.03, .06);
    line.T = 40;
    traces(check, student, line);
  });
  check.forEachCase(4, [&](int i) { bounds(check, student, 1 + 3 * i, .02 + .1 * i); });
  check.forEachCase(8, [&](int i) {
    rex::Rng& rng = check.rng();
    const Eigen::Index n = 2 + i;
    rates(check, student, randomHandTask(1 + i % 3, n, rng), randomLimitedPosture(n, .05, rng), .05);
  });
}

void keepsMore(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    rex::Rng& rng = check.rng();
    const Eigen::Index n = 1 + i % 3;
    Task task = randomTask(n, 1 + i % 2, 8, .95, rng);
    Corridor corridor{Eigen::VectorXd::Constant(n, -.6), Eigen::VectorXd::Constant(n, .4), 1 + .5 * i};
    if (i % 2 == 1) corridor.xMax[0] = kNoLimit;
    keeps(check, student, task, corridor, roundedMatrix(n, 1, 2, rng));
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"predict", "prediction", "Three steps of a sled", 1, Group::kVisible, predictsSled},
      {"plan-cost", "cost", "The cost of a plan", 1, Group::kVisible, costsSled},
      {"cost-to-go", "cost", "The cost of all times to come", 1, Group::kVisible, goesOn},
      {"moves", "bounds", "Moves of single numbers", 1, Group::kVisible, movesAlone},
      {"box", "bounds", "Minima of a few numbers", 1, Group::kVisible, boxesSmall},
      {"plan", "receding", "Plans within bounds", 1, Group::kVisible, plansSled},
      {"drive", "receding", "A drive with pushes", 1, Group::kVisible, drivesSled},
      {"drive-time", "receding", "The time of a long drive (no points)", 0, Group::kVisible, drivesLong},
      {"rate-bounds", "limits", "Bounds of a step", 1, Group::kVisible, boundsOfSteps},
      {"rates", "limits", "Rates within limits", 1, Group::kVisible, ratesOfHands},
      {"line", "limits", "A hand on a line", 1, Group::kVisible, tracesDown},
      {"wall", "corridor", "A plan near a wall", 1, Group::kVisible, keepsFromWall},
      // <hidden>
      {"more-predictions", "prediction", "Predictions of other plants", 1, Group::kHidden, predictsMore},
      {"more-costs", "cost", "Costs of other plans", 1, Group::kHidden, costsMore},
      {"more-to-go", "cost", "Costs to go of other plants", 1, Group::kHidden, goesFurther},
      {"more-boxes", "bounds", "Minima of up to 56 numbers", 2, Group::kHidden, boxesMore},
      {"more-plans", "receding", "Plans of other plants", 1, Group::kHidden, plansMore},
      {"more-drives", "receding", "Drives of other plants", 1, Group::kHidden, drivesMore},
      {"more-hands", "limits", "Hands of other robots", 1, Group::kHidden, tracesMore},
      {"more-walls", "corridor", "Plans within other corridors", 1, Group::kHidden, keepsMore},
      // </hidden>
  };
}
