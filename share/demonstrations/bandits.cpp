// Chapter 6: Bandits. Three rules choose among five arms that pay with probabilities nobody tells them; bars
// show how often each arm was pulled. Epsilon-greedy goes on losing, the others lose less and less. Sliders
// set how much better the best arm is, and epsilon.
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
      for (int r = 0; r < 3; ++r) {
        const int arm = nextArm(records[r], rules[r], rng, epsilon);
        ++records[r].pulls[arm];
        records[r].paid[arm] += rng.uniform() < arms[arm];
        regret[r] += arms[4] - arms[arm];
      }

    Picture picture{.ground = {.visible = false}};
    const Color colors[] = {kDeadReckoningColor, kLandmarkColor, kEstimateColor};
    for (int r = 0; r < 3; ++r) {
      for (int k = 0; k < 5; ++k) {
        const double height = 0.02 + 3.0 * records[r].pulls[k] / pulls;
        picture.solids.push_back({{.type = ShapeType::kBox, .extent = {0.6, 0.6, height}},
                                  translation(k, 1.4 * r, height / 2),
                                  colors[r],
                                  names[r]});
      }
      picture.labels.push_back({.text = names[r], .p_WQ = Eigen::Vector3d(-1.4, 1.4 * r, 0.2), .scale = 1.3});
      view.plot(std::string("regret of ") + names[r], t / 30., regret[r]);
    }
    for (int k = 0; k < 5; ++k)
      picture.labels.push_back(
          {.text = std::to_string(arms[k]).substr(0, 4), .p_WQ = Eigen::Vector3d(k, -0.8, 0), .scale = 1.2});
    picture.captions.push_back({.text = "pulls: " + std::to_string(pulls), .scale = 1.5});
    view.show(picture);
  }
}
