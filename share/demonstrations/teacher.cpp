// Chapter 9: Inverse reinforcement learning. The rooms of a slippery floor are worth something to a teacher
// (left: height and colour; arrows are its policy). A pupil only sees it walk, looks for rewards that tell
// the walks from those of all its policies so far, and adds the policy that is best for these rewards
// (right).
// Slides: 9:12 to 9:14
// Formula: find w with wᵀφ(teacher) >= wᵀφ(π) + margin for all policies π so far
// Try: Inverse reinforcement learning infers what a teacher likes. With 5 "walks of the teacher" it infers
// something else.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "learning/dynamic_programming.h"
#include "learning/inverse_rl.h"
#include "learning/mazes.h"
#include "learning/mdp.h"
#include "render/picture.h"

using namespace rex;

// A floor at x: what its rooms are worth, up to scale and offset, and the likeliest action in each
// state.
void draw(const GridWorld& world, const Eigen::VectorXd& worth, const Eigen::MatrixXd& policy, double x,
          Picture& picture) {
  const double least = worth.minCoeff(), range = std::max(1e-9, worth.maxCoeff() - least);
  for (int s = 0; s < world.mdp.states(); ++s) {
    const auto [column, row] = world.cells[s];
    const double v = (worth[s] - least) / range, height = 0.05 + 1.2 * v;
    const float dark = static_cast<float>(v);
    picture.solids.push_back({{.type = ShapeType::kBox, .extent = {0.94, 0.94, height}},
                              translation(x + column, row, height / 2),
                              Color{0.93f - 0.93f * dark, 0.93f - 0.48f * dark, 0.95f - 0.25f * dark},
                              "cell"});
    Eigen::Index best = 0;
    policy.row(s).maxCoeff(&best);
    const double dx[] = {0, 1, 0, -1}, dy[] = {1, 0, -1, 0};
    const Eigen::Vector3d top(x + column, row, height + 0.03),
        half = 0.35 * Eigen::Vector3d(dx[best], dy[best], 0);
    picture.arrows.push_back(
        {.from = top - half, .to = top + half, .color = kDeadReckoningColor, .radius = 0.04});
  }
}

int main() {
  LiveView view("teacher");
  view.lookFrom({0.1, -1, 1.3});
  Rng rng(1);
  GridWorld world;
  Eigen::MatrixXd features = Eigen::MatrixXd::Zero(9, 36), teacher;
  for (int s = 0; s < 36; ++s) features(s / 12 * 3 + s % 6 / 2, s) = 1;
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(36, 1. / 36);
  Eigen::VectorXd worth, seen;
  Eigen::Vector2d last(0, 0);
  int rounds = 1, plotted = 0;
  for (int t = 0; t < 300 || view.isWatched(); ++t) {
    const double slip = view.slider("slipping", 0, 0.6, 0.3);
    const int walks = static_cast<int>(view.slider("walks of the teacher", 1, 2000, 500));
    const bool another = view.button("another teacher") || worth.size() == 0;
    if (another) worth = rng.uniformVector(9, -1, 1);
    if (another || last != Eigen::Vector2d(slip, walks)) {
      last = {slip, walks}, rounds = 1, plotted = 0;
      world = gridWorld("......\n......\n......\n......\n......\n......", {.slip = slip});
      world.mdp.rewards.colwise() = features.transpose() * worth;
      teacher = deterministicPolicy(world.mdp, policyIteration(world.mdp).actions);
      std::vector<std::vector<int>> shown;
      for (int k = 0; k < walks; ++k)
        shown.push_back(mdpEpisode(world.mdp, teacher, rng.index(36), 200, rng).states);
      seen = featureExpectations(shown, features, world.mdp.discount);
    }
    if (t % 20 == 19) ++rounds;
    const InverseRlResult found = inverseRl(world.mdp, features, start, seen, {.maxIterations = rounds});
    const auto isRunning = found.status == InverseRlStatus::kNotConverged;
    Eigen::Index most = 0;
    found.shares.maxCoeff(&most);
    Picture picture{.ground = {.visible = false}};
    draw(world, features.transpose() * worth, teacher, 0, picture);
    draw(world, features.transpose() * found.w, isRunning ? found.policies.back() : found.policies[most], 7.5,
         picture);
    picture.labels.push_back({.text = "worth to the teacher", .p_WQ = {0, 6.6, 0.8}, .scale = 1.4});
    picture.labels.push_back(
        {.text = "worth, as inferred by the pupil", .p_WQ = {8, 6.6, 0.8}, .scale = 1.4});
    const double best = worth.dot(featureExpectations(world.mdp, teacher, features, start));
    picture.captions.push_back({.text = "policies of the pupil: " + std::to_string(found.policies.size()) +
                                        (isRunning ? "" : ", and it needs no more"),
                                .scale = 1.5});
    if (isRunning && rounds != plotted)
      view.plot("reward lost by the pupil's policies", plotted = rounds, best - worth.dot(found.expectations),
                "round");
    view.show(picture);
  }
}
