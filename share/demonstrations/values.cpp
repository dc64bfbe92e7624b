// Chapter 9: Value iteration sweep by sweep. The values of a grid world (height and colour) spread from the
// goal, and arrows show the best actions so far. Sliders change discount and slipping; the dark cell is a
// trap.
// Slides: 9:6 to 9:8
// Formula: V(s) ← max_a Σ_s' P(s'|s, a) (r + γ V(s'))
// Try: Values spread from the goal, one cell per sweep. Raise "slipping": the policy avoids the trap.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "learning/mazes.h"
#include "render/picture.h"

using namespace rex;

int main() {
  LiveView view("values");
  view.lookFrom({-0.3, -1, 1.1});
  Eigen::VectorXd V;
  Eigen::Vector2d last(-1, -1);
  int sweeps = 0;
  for (int t = 0; t < 300 || view.isWatched(); ++t) {
    const double discount = view.slider("discount", 0.5, 0.99, 0.9),
                 slip = view.slider("slipping", 0, 0.6, 0.1);
    const double pace = view.slider("sweeps a second", 0.5, 10, 3);
    const GridWorld world =
        gridWorld("..........\n.####.###.\n.#......#.\n.#.##.#.#.\n.....T#.G.\n.#.####.#.\n..........",
                  {.discount = discount, .slip = slip, .marks = {{}, {.letter = 'T', .reward = -1}}});
    const Mdp& mdp = world.mdp;
    if (view.button("from zero") || last != Eigen::Vector2d(discount, slip))
      last = {discount, slip}, V = Eigen::VectorXd::Zero(mdp.states()), sweeps = 0;
    Eigen::MatrixXd Q = mdp.rewards;
    for (int a = 0; a < mdp.actions(); ++a) Q.col(a) += discount * (mdp.transitions[a] * V);
    if (std::fmod(t * pace / 30, 1) < pace / 30) {  // V <- max_a R + discount P V
      const Eigen::VectorXd next = Q.rowwise().maxCoeff();
      view.plot("largest change in a sweep", ++sweeps, (next - V).cwiseAbs().maxCoeff(), "sweep");
      V = next;
    }
    Picture picture{.ground = {.visible = false}};
    for (int s = 0; s < mdp.states(); ++s) {
      const auto [column, row] = world.cells[s];
      const float v = static_cast<float>(std::clamp(V[s], 0., 1.));
      const double height = 0.05 + 2 * v;
      const Color color = mdp.isTerminal(s) && mdp.rewards(s, 0) < 0
                              ? kTruthColor
                              : Color{0.93f - 0.93f * v, 0.93f - 0.48f * v, 0.95f - 0.25f * v};
      picture.solids.push_back({{.type = ShapeType::kBox, .extent = {0.94, 0.94, height}},
                                translation(column, row, height / 2),
                                color,
                                "cell"});
      const Eigen::Vector3d top(column, row, height + 0.03);
      Eigen::Index best = 0;
      if (mdp.isTerminal(s))
        picture.labels.push_back({.text = mdp.rewards(s, 0) > 0 ? "goal" : "trap",
                                  .p_WQ = top + Eigen::Vector3d(0, 0, 0.3),
                                  .scale = 1.5});
      if (mdp.isTerminal(s) || Q.row(s).maxCoeff(&best) - Q.row(s).minCoeff() < 1e-9) continue;
      const double dx[] = {0, 1, 0, -1}, dy[] = {1, 0, -1, 0};
      const Eigen::Vector3d half = 0.35 * Eigen::Vector3d(dx[best], dy[best], 0);
      picture.arrows.push_back(
          {.from = top - half, .to = top + half, .color = kDeadReckoningColor, .radius = 0.04});
    }
    picture.polylines.push_back(
        {.points = {{-0.5, -0.5, 2.1}, {-0.5, -0.5, 0}, {9.5, -0.5, 0}, {9.5, 6.5, 0}},
         .color = kTruthColor});
    picture.captions.push_back({.text = "sweeps: " + std::to_string(sweeps), .scale = 1.5});
    view.show(picture);
  }
}
