// Chapter 9: Exploring. A river pays a little at its source and much at its mouth, where the current makes it
// hard to get to. Bars show how often three learners swam left (dark) or right in each state. Q-learning
// explores by chance, R-max with a plan, posterior sampling where it believes differently from draw to draw.
// Slides: 9:6 to 9:8, 6:22
// Formula: Q(s, a) ← Q + α (r + γ max_a' Q(s', a') - Q); R-max: r = r_max where (s, a) is little known
// Try: Three learners in a river that pays at its far end: Q-learning stays near, R-max and posterior
// sampling find it. Raise "states" to 10.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "learning/dynamic_programming.h"
#include "learning/learned_model.h"
#include "learning/mazes.h"
#include "learning/mdp.h"
#include "learning/q_learning.h"
#include "render/picture.h"

using namespace rex;

struct Learner {
  const char* name;
  Color color;
  LearnedModel seen;
  Eigen::MatrixXd Q;
  double paid = 0;
  int s = 0;
};

int main() {
  LiveView view("explore");
  view.lookFrom({0.1, -1.1, 0.8});
  std::vector<Learner> learners;
  Eigen::Vector3d last(0, 0, 0);
  Rng rng(1);
  int steps = 0;
  for (int t = 0; t < 300 || view.isWatched(); ++t) {
    const int n = static_cast<int>(view.slider("states", 3, 10, 6)),
              known = static_cast<int>(view.slider("R-max knows after visits", 1, 40, 15)),
              pace = static_cast<int>(view.slider("steps in a picture", 1, 40, 10));
    const double epsilon = view.slider("epsilon of Q-learning", 0, 1, 0.1);
    if (const Eigen::Vector3d now(n, known, epsilon); view.button("again") || now != last) {
      last = now, steps = 0, learners.clear();
      for (const auto& [name, color] : {std::pair("Q-learning", kDeadReckoningColor),
                                        {"R-max", kLandmarkColor},
                                        {"posterior sampling", kEstimateColor}})
        learners.push_back({name, color, LearnedModel(n, 2), Eigen::MatrixXd::Zero(n, 2)});
    }
    const Mdp river = riverSwim(n);
    for (int i = 0; i < pace; ++i, ++steps)
      for (int k = 0; k < 3; ++k) {
        auto& [name, color, seen, Q, paid, s] = learners[k];
        if (k > 0 && steps % 20 == 0) {  // both plan again now and then
          const Mdp believed = k == 1 ? seen.optimistic(river.discount, known, 1)
                                      : seen.sampled(river.discount, {.rewardNoise = 0.1}, rng);
          Q = valueIteration(believed, {.tolerance = 1e-4}).Q;
        }
        const bool tries = k == 0 && (rng.uniform() < epsilon || Q(s, 0) == Q(s, 1));
        const int a = tries ? rng.index(2) : (Q(s, 1) > Q(s, 0) ? 1 : 0);
        const TabularStep step{s, a, river.rewards(s, a), sampledNext(river, s, a, rng)};
        seen.observe(s, a, step.reward, step.next);
        if (k == 0) learnFrom(Q, step, {}, 0.1, river.discount);
        paid += step.reward, s = *step.next;
      }
    Picture picture{.ground = {.visible = false}};
    for (int k = 0; k < 3; ++k) {
      const Learner& one = learners[k];
      for (int bar = 0; bar < 2 * n; ++bar) {
        const double share = static_cast<double>(one.seen.visits(bar / 2, bar % 2)) / steps,
                     height = 0.02 + 0.04 * std::round(100 * share);
        picture.solids.push_back({{.type = ShapeType::kBox, .extent = {0.4, 0.6, height}},
                                  translation(bar / 2 + 0.42 * (bar % 2), 1.6 * k, height / 2),
                                  bar % 2 == 1 ? one.color : kTruthColor,
                                  one.name});
      }
      picture.solids.push_back({{.type = ShapeType::kSphere, .radius = 0.15},
                                translation(one.s + 0.21, 1.6 * k - 0.5, 0.15),
                                kScanColor,
                                "swimmer"});
      picture.labels.push_back({.text = one.name, .p_WQ = {n + 0.3, 1.6 * k, 0.2}, .scale = 1.3});
      view.plot(std::string("reward of ") + one.name, steps, one.paid, "step");
    }
    picture.captions.push_back({.text = "steps: " + std::to_string(steps), .scale = 1.5});
    view.show(picture);
  }
}
