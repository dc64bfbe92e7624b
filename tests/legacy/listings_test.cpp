// The two listings of the course script, as they stand there: exercises 12.4.2 and 12.12.
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "legacy/legacy.h"

namespace {

std::vector<arr> hands;  // where the hand was when the listing asked

/// Looks over the listing's shoulder.
class ObservedSimulator : public Simulator {
 public:
  using Simulator::Simulator;
  void kinematicsPos(arr& y, const char* body) const {
    Simulator::kinematicsPos(y, body);
    hands.push_back(y);
  }
};

#define Simulator ObservedSimulator
// clang-format off
void multiTask() {
 Simulator S("man.ors");
 arr q,q_home,y_target,y,J,W,Phi,PhiJ;
 uint n = S.getJointDimension();

 S.getJointAngles(q);
 W.setDiag(1.,n);
 q_home = q;

 for(uint i=0;i<10000;i++){
 Phi.clear();
 PhiJ.clear();

 y_target = ARR(-0.2, -0.4, 1.1);
 y_target += .2 * ARR(cos((double)i/20), 0, sin((double)i/20));
 S.kinematicsPos(y,"handR");
 S.jacobianPos (J,"handR");

 Phi.append(1e2 * (y - y_target));
 PhiJ.append(1e2 * J);

 q -= inverse(~PhiJ*PhiJ + W)*~PhiJ* Phi;
 S.setJointAngles(q);
 }
}
// clang-format on
#undef Simulator

// Later the posture drifts and the hand now and then jumps: that is what the exercise is about.
TEST(Listing, MultiTaskLeadsTheHandAroundTheCircle) {
  multiTask();
  ASSERT_EQ(hands.size(), 10000u);
  for (uint i = 20; i < 500; ++i) {
    const double before = (i - 1) / 20.;
    const arr target = ARR(-.2 + .2 * cos(before), -.4, 1.1 + .2 * sin(before));
    ASSERT_LT(length(hands[i] - target), 1e-3) << i;
  }
}

double evaluateControlParameters(const arr& w) {
  Racer R;
  arr y;
  double costs = 0;
  for (uint t = 0; t < 100; t++) {
    R.getObservation(y);
    double u = w(0);
    for (uint i = 0; i < 4; i++) u += w(i + 1) * y(i);
    R.stepDynamics(u);
    costs += 1. * MT::sqr(R.q(0)) + 10. * MT::sqr(R.q(1));
    if (fabs(R.q(1)) > .8) return costs + 10. * (100 - t);
  }
  return costs;
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-variable"
// clang-format off
void search() {
SearchCMA cma;
cma.init(5, -1, -1, -0.1, 0.1);
arr samples, values;

uint T=500;
for(uint t=0;t<1000;t++) {
 cma.step(samples, values);
 for(uint i=0;i<samples.d0;i++) values(i) = evaluateControlParameters(samples[i]);
 uint i=values.minIndex();
 cout <<t << ' ' <<values(i) << ' ' <<samples[i] <<endl;
}
}
// clang-format on
#pragma GCC diagnostic pop

TEST(Listing, TheLoopOfCmaBalancesTheRacerForASecond) {
  std::ostringstream text;
  std::streambuf* const screen = cout.rdbuf(text.rdbuf());
  search();
  cout.rdbuf(screen);
  std::istringstream lines(text.str());
  std::vector<double> costs;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream numbers(line);
    uint t = 0;
    double cost = 0;
    ASSERT_TRUE(numbers >> t >> cost);
    ASSERT_EQ(t, costs.size());
    costs.push_back(cost);
  }
  ASSERT_EQ(costs.size(), 1000u);
  EXPECT_GT(costs.front(), 10);
  EXPECT_LT(costs.back(), 1);
}

}  // namespace
