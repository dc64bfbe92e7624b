#include "grading/check.h"

#include <numbers>

#include "gait_checks.h"
#include "interface.h"
#include "preview_checks.h"
#include "support_checks.h"
#include "zmp_checks.h"

using rex::grading::Check;
using rex::grading::Group;

namespace {

// Part 1.

void corners(Check& check, Student& student) {
  cornersFit(check, student, "two soles side by side, with contacts in the middle of each side",
             shuffled(check.rng(), twoSoles()));
  for (int i = 0; i < 20; ++i)
    cornersFit(check, student, "points, some of them on the edges and some coincident",
               scattered(check.rng()));
  for (const int count : {2, 3, 6})
    cornersFit(check, student, "points on a line", inARow(check.rng(), count));
  cornersFit(check, student, "two coincident points", inARow(check.rng(), 1));
  cornersFit(check, student, "no contacts", Eigen::MatrixXd::Zero(2, 0));
}

void borders(Check& check, Student& student) {
  marginsFit(check, student, twoSoles());
  for (int i = 0; i < 10; ++i) marginsFit(check, student, scattered(check.rng()));
  for (const int count : {3, 1}) marginsFit(check, student, inARow(check.rng(), count));
}

void stands(Check& check, Student& student) {
  for (int i = 0; i < 10; ++i) standsAsItShould(check, student, twoSoles());
}

// <hidden>
void standsOnAnything(Check& check, Student& student) {
  check.forEachCase(12, [&](int i) {
    rex::Rng& rng = check.rng();
    standsAsItShould(check, student, i < 9 ? scattered(rng) : inARow(rng, i == 11 ? 1 : 5));
  });
}
// </hidden>

// Part 2.

void moments(Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  std::vector<MovingMass> atRest = pressing(rng, 9.81);
  for (MovingMass& part : atRest) part.a.setZero();
  hasNoMoment(check, student, atRest, 0, 9.81);
  for (int i = 0; i < 10; ++i) hasNoMoment(check, student, pressing(rng, 9.81), 0, 9.81);
  hasNoMoment(check, student, pressing(rng, 9.81), rng.uniform(-1, 1), 9.81);
  fallingHasNone(check, student, 9.81);
}

void sways(Check& check, Student& student) {
  for (int i = 0; i < 20; ++i) swaysRight(check, student);
}

void captures(Check& check, Student& student) {
  for (int i = 0; i < 10; ++i) capturesTheMotion(check, student);
}

// <hidden>
void momentsAnywhere(Check& check, Student& student) {
  check.forEachCase(12, [&](int i) {
    const double g = check.rng().uniform(1, 12);
    if (i == 0) fallingHasNone(check, student, g);
    if (i > 0) hasNoMoment(check, student, pressing(check.rng(), g), check.rng().uniform(-1, 1), g);
  });
}
// </hidden>

// Part 3.

void follows(Check& check, Student& student) {
  for (int i = 0; i < 5; ++i) cartMoves(check, student, randomCart(check.rng()));
  lawIsFollowed(check, student, {});
  for (int i = 0; i < 3; ++i) lawIsFollowed(check, student, randomCart(check.rng()));
}

// For g = 9.8 the numbers are also known from other sources.
void gains(Check& check, Student& student) {
  const CartTable cart{.g = 9.8};
  check.input(described(cart));
  const PreviewLaw law = student.previewLaw(cart);
  check.near("Gi of previewLaw", law.Gi, 618.556392, 1e-3);
  check.near("Gx of previewLaw", law.Gx, Eigen::RowVector3d(72738.06965, 21565.61408, 177.0885579), .1);
  gainsFit(check, student, cart);
  gainsFit(check, student, {.height = .6, .step = .01, .ahead = 150, .R = 1e-5});
}

void staysOn(Check& check, Student& student) {
  staysOnTheSoles(check, student, {.height = .8, .step = .01, .ahead = 160},
                  {.footsteps = rex::straightFootsteps(5, .25, .2)});
}

// <hidden>
void gainsOfAnyCart(Check& check, Student& student) {
  check.forEachCase(6, [&](int) { gainsFit(check, student, randomCart(check.rng())); });
}

void staysOnAnyFootsteps(Check& check, Student& student) {
  check.forEachCase(4, [&](int) {
    const CartTable cart{.height = check.rng().uniform(.6, .9), .step = .01, .ahead = 160};
    staysOnTheSoles(check, student, cart, randomWalk(check.rng()));
  });
}
// </hidden>

// Part 4.

void impacts(Check& check, Student& student) {
  for (int i = 0; i < 20; ++i) impactFits(check, student, {});
}

bool hasFallen(rex::StepStatus status) {
  return status == rex::StepStatus::kFellForward || status == rex::StepStatus::kFellBackward;
}

// Whether the legs would come down after the fall, if they could swing on below the ground; and not nearly
// at the same time.
bool wouldLandLater(const Walker& walker, Eigen::Vector4d x) {
  const rex::CompassGait library = libraryOf(walker);
  const double tau = 1e-3;
  const auto sum = [&](const Eigen::Vector4d& at) { return at[0] + at[1] + 2 * walker.slope; };
  for (double time = 0; time < 4.5 && std::abs(x[0]) < 3; time += tau) {
    const Eigen::Vector4d middle = x + tau / 2 * library.derivative(x), before = x;
    x += tau * library.derivative(middle);
    if (sum(before) > 0 && sum(x) <= 0 && x[1] > x[0] + .05)
      return std::abs(x[0] + walker.slope) > std::numbers::pi / 2 + .1;
  }
  return false;
}

// A fall ends the step, and so do five seconds: with a hundredth of g all takes ten times as long.
void endsInTime(Check& check, Student& student, const KnownGait& gait) {
  Eigen::Vector4d x;
  do {
    const double stance = check.rng().uniform(.1, .25);
    x = {stance, -2 * gait.walker.slope - stance, check.rng().uniform(-3, 3), check.rng().uniform(-6, 6)};
  } while (!hasFallen(libraryOf(gait.walker).step(x, 5).status) || !wouldLandLater(gait.walker, x));
  doesNotStep(check, student, gait.walker, x, "the walker falls");
  Walker floating = gait.walker;
  floating.g /= 100;
  x = gait.x;
  x.tail<2>() /= 10;
  doesNotStep(check, student, floating, x, "the foot lands after more than 5 s");
}

void steps(Check& check, Student& student) {
  const KnownGait gait = gaitOf({});
  for (int i = 0; i < 5; ++i) checkStep(check, student, gait);
  checkStep(check, student, gait, .03);
  doesNotStep(check, student, gait.walker, {.22, -.22 - 2 * gait.walker.slope, -.3, -.3}, "the walker falls");
  endsInTime(check, student, gait);
}

void derivatives(Check& check, Student& student) {
  const KnownGait gait = gaitOf({});
  for (int i = 0; i < 3; ++i) derivativeFits(check, student, gait);
}

// The gait of the paper is known, and so are its multipliers; that of a drawn slope is not.
void gait(Check& check, Student& student) {
  gaitFits(check, student, gaitOf({}), {.2, -.3, -1, -.3});
  rex::Rng& rng = check.rng();
  const KnownGait drawn = gaitOf({.slope = rng.uniform(2.5, 3.5) * kDegree});
  gaitFits(check, student, drawn, near(rng, drawn, .01));
  hasNoGait(check, student, drawn.walker);
}

// <hidden>
void otherSteps(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    const Walker walker = randomWalker(check.rng());
    for (int k = 0; k < 3; ++k) impactFits(check, student, walker);
    const KnownGait known = gaitOf(walker);
    if (i % 2 == 0) checkStep(check, student, known);
    if (i % 2 == 1) derivativeFits(check, student, known);
  });
}

// Beyond some 4.4 degrees the symmetric gait is unstable, and a walker that simply walks on ends up
// limping.
void otherGaits(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    Walker walker = randomWalker(check.rng());
    if (i < 2) walker = {.slope = (4.55 + .1 * i) * kDegree};
    const KnownGait known = gaitOf(walker);
    gaitFits(check, student, known, near(check.rng(), known, .01));
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"corners", "support", "Corners of the support polygon", 1, Group::kVisible, corners},
      {"border", "support", "Distance from its border", 1, Group::kVisible, borders},
      {"stands", "support", "Static stability on two feet", 1, Group::kVisible, stands},
      // <hidden>
      {"stands-any", "support", "Static stability on other contacts", 1, Group::kHidden, standsOnAnything},
      // </hidden>
      {"moment", "zmp", "The zero moment point", 1, Group::kVisible, moments},
      {"sways", "zmp", "How the pendulum sways", 1, Group::kVisible, sways},
      {"capture", "zmp", "The capture point", 1, Group::kVisible, captures},
      // <hidden>
      {"moment-any", "zmp", "The zero moment point at other ground heights", 1, Group::kHidden,
       momentsAnywhere},
      // </hidden>
      {"follows", "preview", "The cart and the law", 1, Group::kVisible, follows},
      {"gains", "preview", "Gains of preview control", 1, Group::kVisible, gains},
      {"stays-on", "preview", "The zero moment point stays on the soles", 1, Group::kVisible, staysOn},
      // <hidden>
      {"gains-any", "preview", "Gains for other carts", 1, Group::kHidden, gainsOfAnyCart},
      {"stays-any", "preview", "Footsteps that you have not seen", 1, Group::kHidden, staysOnAnyFootsteps},
      // </hidden>
      {"impact", "compass", "The impact", 1, Group::kVisible, impacts},
      {"step", "compass", "One step", 1, Group::kVisible, steps},
      {"derivative", "compass", "The derivative of a step", 1, Group::kVisible, derivatives},
      {"gait", "compass", "The gait of the paper, and its multipliers", 1, Group::kVisible, gait},
      // <hidden>
      {"other-steps", "compass", "Impacts and steps of other walkers", 1, Group::kHidden, otherSteps},
      {"other-gaits", "compass", "Gaits on other slopes", 2, Group::kHidden, otherGaits},
      // </hidden>
  };
}
