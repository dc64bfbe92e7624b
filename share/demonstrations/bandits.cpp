// Chapter 6: Bandits. Three rules choose among five arms that pay with probabilities nobody tells them; bars
// show how often each arm was pulled. Epsilon-greedy goes on losing, the others lose less and less. Sliders
// set how much better the best arm is, and epsilon.
// Slides: 6:22
// Formula: UCB pulls argmax_a (mean_a + sqrt(2 ln n / n_a))
// Try: Epsilon-greedy keeps losing; the losses of UCB and Thompson sampling level off. Lower "best arm
// better by".
#include "learning/bandits.h"

#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("bandits");
  view.lookFrom({0.25, -1.1, 0.8});
  const BanditRule rules[] = {BanditRule::kEpsilonGreedy, BanditRule::kUcb, BanditRule::kThompson};
  const char* names[] = {"epsilon-greedy", "UCB", "Thompson"};
  double lastGap = -1, regret[3] = {};
  int pulls = 0;
  std::vector<ArmRecord> records;
  Rng rng(1);
  for (int t = 0; t < 300 || view.isWatched(); ++t) {
    const double gap = view.slider("best arm better by", 0.02, 0.2, 0.1),
                 epsilon = view.slider("epsilon", 0, 0.5, 0.1),
                 speed = view.slider("pulls in a picture", 1, 50, 10);
    if (view.button("again") || gap != lastGap) {
      lastGap = gap, pulls = 0, std::fill(regret, regret + 3, 0.);
      records.assign(3, {Eigen::VectorXi::Zero(5), Eigen::VectorXd::Zero(5)});
    }
    const Eigen::VectorXd arms = (Eigen::VectorXd(5) << 0.3, 0.4, 0.5, 0.6, 0.6 + gap).finished();
    for (int n = 0; n < static_cast<int>(speed); ++n, ++pulls)
      for (int rule = 0; rule < 3; ++rule) {
        const int arm = nextArm(records[rule], rules[rule], rng, epsilon);
        ++records[rule].pulls[arm];
        records[rule].paid[arm] += rng.uniform() < arms[arm];
        regret[rule] += arms[4] - arms[arm];
      }

    Picture picture{.ground = {.visible = false}};
    const Color colors[] = {kDeadReckoningColor, kLandmarkColor, kEstimateColor};
    for (int rule = 0; rule < 3; ++rule) {
      for (int k = 0; k < 5; ++k) {
        const double height = 0.02 + 3.0 * records[rule].pulls[k] / pulls;
        picture.solids.push_back({{.type = ShapeType::kBox, .extent = {0.6, 0.6, height}},
                                  translation(k, 1.4 * rule, height / 2),
                                  colors[rule],
                                  names[rule]});
      }
      picture.labels.push_back(
          {.text = names[rule], .p_WQ = Eigen::Vector3d(-1.4, 1.4 * rule, 0.2), .scale = 1.3});
      view.plot(std::string("regret of ") + names[rule], t / 30., regret[rule]);
    }
    for (int k = 0; k < 5; ++k)
      picture.labels.push_back(
          {.text = std::to_string(arms[k]).substr(0, 4), .p_WQ = Eigen::Vector3d(k, -0.8, 0), .scale = 1.2});
    picture.captions.push_back({.text = "pulls: " + std::to_string(pulls), .scale = 1.5});
    view.show(picture);
  }
}
