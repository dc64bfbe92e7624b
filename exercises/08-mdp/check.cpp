#include "grading/check.h"

#include <algorithm>

#include "gradient_checks.h"
#include "interface.h"
#include "iteration_checks.h"
#include "lesson.h"
#include "maze_checks.h"
#include "natural_checks.h"
#include "process_checks.h"
#include "trial_checks.h"

using rex::grading::Check;
using rex::grading::Group;

namespace {

void mazeOfTheSheet(Check& check, Student& student) { mazeFits(check, student, {4, 0, 2, 3}, .5); }

void valuesOfPolicies(Check& check, Student& student) {
  for (const int n : {3, 1, 6})
    policyIsWorth(check, student, randomProcess(check.rng(), n, 2, check.rng().uniform(.3, .9)));
  // Without a terminal state, a hundred times eq. (9) is not enough.
  policyIsWorth(check, student, randomProcess(check.rng(), 1, 2, .9));
  policyIsWorth(check, student, processOf(rex::tMaze()));
}

void worths(Check& check, Student& student) {
  for (const int n : {3, 1, 6})
    actionsAreWorth(check, student, randomProcess(check.rng(), n, 3, check.rng().uniform(.3, .9)));
}

void settles(Check& check, Student& student) {
  valuesSettle(check, student, processOf(rex::tMaze()), 1e-6);
  valuesSettle(check, student, randomProcess(check.rng(), 4, 2, .95), 1e-3);
  valuesSettle(check, student, randomProcess(check.rng(), 8, 3, .9), .1);
}

void improves(Check& check, Student& student) {
  policiesImprove(check, student, improvableProcess(check.rng()));
  policiesImprove(check, student, processOf(rex::tMaze()));
  for (int i = 0; i < 3; ++i) policiesImprove(check, student, randomProcess(check.rng(), 8, 3, .9));
  tieStays(check, student);
}

void trials(Check& check, Student& student) {
  trialFits(check, student, 2, 15, 100);
  trialFits(check, student, 3, 15, 6);
  trialFits(check, student, 2, 15, 15);
  trialFits(check, student, 1, 8, 1);
}

void returns(Check& check, Student& student) {
  for (const int T : {4, 1, 7}) returnsFit(check, student, T);
}

void gradients(Check& check, Student& student) {
  gradientFits(check, student, 2, 1);
  gradientFits(check, student, 3, 4);
  gradientFits(check, student, 1, 2);
}

void powers(Check& check, Student& student) {
  powerFits(check, student, 2, 1);
  powerFits(check, student, 3, 10);
  powerFits(check, student, 1, 3);
}

void naturalGradients(Check& check, Student& student) {
  naturalGradientFits(check, student, 2, 1);
  naturalGradientFits(check, student, 3, 4);
  naturalGradientFits(check, student, 1, 2);
}

// <hidden>
void mazesOfOtherLeaves(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    mazeFits(check, student, 5 * check.rng().normalVector(4), check.rng().uniform(.1, 1));
  });
}

void largerProcesses(Check& check, Student& student) {
  check.forEachCase(12, [&](int i) {
    rex::Rng& rng = check.rng();
    const Process process = randomProcess(rng, 2 + rng.index(30), 1 + rng.index(4), rng.uniform(0, .98));
    if (i % 2 == 0) policyIsWorth(check, student, process);
    if (i % 2 == 1) actionsAreWorth(check, student, process);
  });
}

void unseenSettle(Check& check, Student& student) {
  check.forEachCase(8, [&](int) {
    rex::Rng& rng = check.rng();
    const Process process = randomProcess(rng, 2 + rng.index(10), 1 + rng.index(4), rng.uniform(.5, .97));
    valuesSettle(check, student, process, std::pow(10, rng.uniform(-6, -1)));
  });
}

void unseenImprove(Check& check, Student& student) {
  const rex::GridWorld world =
      rex::gridWorld("....G\n.##..\n.P...", {.stepReward = -.02, .slip = .1, .marks = {{'G', 1}, {'P', -1}}});
  check.forEachCase(8, [&](int i) {
    rex::Rng& rng = check.rng();
    policiesImprove(check, student,
                    i == 0 ? processOf(world.mdp)
                           : randomProcess(rng, 2 + rng.index(20), 1 + rng.index(4), rng.uniform(0, .97)));
  });
}

// Several: one direction in sixteen is right by chance for a single task.
void trueGradient(Check& check, Student& student) {
  check.forEachCase(4, [&](int) { gradientIsTheTrueOne(check, student); });
}

void morePower(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) { powerFits(check, student, 1 + i % 4, 3 + 5 * i); });
}

// Returns that are linear in dlog pi, as 9:17 approximates them, have their coefficients as the result.
void linearReturns(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    const int k = 1 + i % 4;
    Practice given = naturalPractice(check.rng(), k, k + 2 * i).given;
    const Eigen::VectorXd wanted = someNumbers(check.rng(), k);
    for (Rollout& trial : given.trials) {
      double after = 0;
      for (auto t = trial.rewards.size() - 1; t >= 0; --t) {
        const Eigen::VectorXd phi = trial.features.col(t), seen = given.policy.L.transpose() * phi;
        const double now = phi.dot(wanted) * phi.dot(trial.noise.col(t)) / seen.dot(seen);
        trial.rewards[t] = now - given.discount * after;
        after = now;
      }
    }
    const Eigen::VectorXd got = student.naturalGradientOf(given.policy, given.trials, given.discount);
    check.near("w where the returns to go are linear in dlog pi", got, wanted, 1e-6 * wanted.norm());
  });
}

// With features M phi, the parameters that mean the same are M^-T beta; so a step must become M^-T w. The
// tolerance is what exercise.h allows times 100, more than the condition of M.
void otherFeatures(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    const int k = 1 + i % 4;
    const NaturalPractice made = naturalPractice(check.rng(), k, k + 2 * i);
    const Practice& given = made.given;
    Eigen::MatrixXd M = .3 * someNumbers(check.rng(), k, k);
    for (int j = 0; j < k; ++j) {
      M.row(j).head(j).setZero();
      M(j, j) = check.rng().uniform(.5, 2);
    }
    const Eigen::MatrixXd turned = M.transpose(), back = rex::inverse(turned);
    Practice other{{back * given.policy.beta, back * given.policy.L}, {}, given.discount};
    for (const Rollout& trial : given.trials)
      other.trials.push_back({M * trial.features, back * trial.noise, trial.rewards});

    const Eigen::VectorXd w = student.naturalGradientOf(given.policy, given.trials, given.discount),
                          changed = student.naturalGradientOf(other.policy, other.trials, other.discount);
    check.shape("w of naturalGradientOf", w, k, 1);
    // Both are known: other functions of the policy change with the features in the same way.
    check.near("w of naturalGradientOf", w, made.w, 1e-4 * made.w.norm());
    const Eigen::VectorXd wanted = back * made.w;
    check.near("w for other features", changed, wanted, 1e-4 * wanted.norm());
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"maze", "maze", "The T-maze of the sheet", 1, Group::kVisible, mazeOfTheSheet},
      {"policy-values", "values", "Values of a policy", 1, Group::kVisible, valuesOfPolicies},
      {"worth", "values", "What actions are worth", 1, Group::kVisible, worths},
      {"settles", "values-best", "Value iteration", 1, Group::kVisible, settles},
      {"improves", "policies", "Policy iteration", 1, Group::kVisible, improves},
      {"trials", "trials", "Trials with noise, cut at a failure", 2, Group::kVisible, trials},
      {"returns", "gradient", "Returns to go", 1, Group::kVisible, returns},
      {"gradient", "gradient", "The gradient of given trials", 1, Group::kVisible, gradients},
      {"power", "power", "One step of PoWER", 1, Group::kVisible, powers},
      {"natural", "natural", "The natural gradient of given trials", 1, Group::kVisible, naturalGradients},
      // <hidden>
      {"other-mazes", "maze", "T-mazes with other leaves", 1, Group::kHidden, mazesOfOtherLeaves},
      {"larger", "values", "Processes of any size", 1, Group::kHidden, largerProcesses},
      {"unseen-settle", "values-best", "Value iteration on other processes", 2, Group::kHidden, unseenSettle},
      {"unseen-improve", "policies", "Policy iteration on other processes", 1, Group::kHidden, unseenImprove},
      {"true-gradient", "gradient", "The gradient of a task where it is known", 1, Group::kHidden,
       trueGradient},
      {"more-power", "power", "PoWER on more trials", 1, Group::kHidden, morePower},
      {"linear-returns", "natural", "Returns that are linear in dlog pi", 1, Group::kHidden, linearReturns},
      {"other-features", "natural", "The natural gradient for other features", 1, Group::kHidden,
       otherFeatures},
      // </hidden>
  };
}
