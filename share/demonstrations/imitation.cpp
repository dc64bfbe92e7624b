// Chapter 9: Imitation. Demonstrations (grey) pass an obstacle on the left or on the right. A clone that
// averages them drives into it; a mixture keeps both ways. DAgger asks an expert, who passes on the left,
// wherever its clone gets to, and so learns to come back when gusts push it. Sliders set what is shown.
// Slides: 9:9 to 9:11
// Formula: min_β Σ (u_t - β φ(x_t))² over the states of the teacher, or, as in DAgger, of the pupil
// Try: The mean of demonstrations on both sides hits the obstacle; "next clone" shows a mixture and DAgger.
// With demonstrations on one side without noise, only DAgger avoids the obstacle in every run.
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "learning/behavioural_cloning.h"
#include "learning/mixture_cloning.h"
#include "render/picture.h"

using namespace rex;

constexpr double kGoal = 8, kStep = 0.1, kPass = 1.9, kRadius = 1.4;

// Drives until it arrives or hits the obstacle. Each row: the features x, y, sin, cos, 1 of a state, and the
// slope dy/dx chosen there.
Eigen::MatrixXd driven(const ActionOf& slope, double gust, Rng& rng) {
  Eigen::MatrixXd way(static_cast<int>(kGoal / kStep) + 1, 6);
  double y = 0;
  for (int i = 0; i < way.rows(); ++i) {
    const double x = i * kStep, phase = M_PI * x / kGoal;
    const Eigen::VectorXd phi = (Eigen::VectorXd(5) << x, y, std::sin(phase), std::cos(phase), 1).finished();
    way.row(i) << phi.transpose(), slope(phi)[0];
    if (std::hypot(x - kGoal / 2, y) < kRadius) return way.topRows(i + 1);
    y += kStep * way(i, 5) + gust * rng.normal();
  }
  return way;
}

int main() {
  LiveView view("imitation");
  view.lookFrom({0, -0.5, 1});
  Eigen::Vector4d last(-1, 0, 0, 0);
  int which = 0, shown = 0, at = 0;
  std::vector<Eigen::MatrixXd> seen, runs;
  const auto hits = [](const Eigen::MatrixXd& way) { return way(way.rows() - 1, 0) < kGoal - kStep / 2; };
  for (int t = 0; t < 300 || view.isWatched(); ++t, ++at) {
    const int count = static_cast<int>(view.slider("demonstrations", 2, 40, 20));
    const double left = view.slider("share on the left", 0, 1, 0.5),
                 noise = view.slider("noise of demonstrations", 0, 0.6, 0.2),
                 gust = view.slider("gusts [m]", 0, 0.15, 0.02);
    if (view.button("next clone") || (!view.isWatched() && t > 0 && t % 100 == 0))
      which = (which + 1) % 3, last[0] = -1;
    if (const Eigen::Vector4d now(count, left, noise, gust); now != last) {
      last = now, shown = at = 0, seen.clear(), runs.clear();
      Rng rng(1);
      // Along half a wave that passes on that side, +1: left, and back to it from elsewhere.
      const auto expert = [&](double side) -> ActionOf {
        return [&, side](const VectorArg& phi) {
          const double turn = M_PI * kStep / kGoal, here = kPass * side * phi[2],
                       next = kPass * side * (phi[2] * std::cos(turn) + phi[3] * std::sin(turn));
          const double slope = (next - here) / kStep + here - phi[1];
          return Eigen::VectorXd::Constant(1, slope + noise * rng.normal());
        };
      };
      Eigen::MatrixXd all(0, 6);
      for (int i = 0; i < count; ++i) {
        seen.push_back(driven(expert(i < std::lround(left * count) ? 1 : -1), 0, rng));
        all.conservativeResize(all.rows() + seen[i].rows(), 6);
        all.bottomRows(seen[i].rows()) = seen[i];
      }
      ActionOf clone;
      if (which == 1) {
        const auto mixture = cloneMixture(all.leftCols(2), all.rightCols(1), rng, {.experts = 4});
        clone = [&rng, policy = mixture.policy, one = std::optional<int>()](const VectorArg& phi) mutable {
          one = policy.expertFor(phi.head(2), phi[0] > 0 ? one : std::nullopt, rng);
          return policy.experts[*one].action(phi.head(2));
        };
      } else {
        const ImitationTask task{expert(1), [&](const ActionOf& act, Rng& random) {
                                   return Eigen::MatrixXd(driven(act, gust, random).leftCols(5));
                                 }};
        const LinearClone linear = which == 0 ? cloneLinear(all.leftCols(5), all.rightCols(1))
                                              : aggregatedClones(task, {.rounds = count}, rng).back();
        clone = [w = linear.weights](const VectorArg& phi) { return Eigen::VectorXd(w.transpose() * phi); };
      }
      for (int i = 0; i < 30; ++i) runs.push_back(driven(clone, gust, rng));
    }
    if (at > runs[shown].rows() + 15) at = 0, shown = (shown + 1) % 30;
    Picture picture{.ground = {.cell = 1}};
    const auto draw = [&](const Eigen::MatrixXd& way, double z, Color color, double width) {
      picture.polylines.push_back({.color = color, .width = width});
      for (const auto& row : way.rowwise()) picture.polylines.back().points.emplace_back(row[0], row[1], z);
    };
    for (const Eigen::MatrixXd& way : seen) draw(way, 0.02, {0.7f, 0.71f, 0.73f}, 1.5);
    for (const Eigen::MatrixXd& way : runs)
      draw(way, 0.04, hits(way) ? Color{0.95f, 0.7f, 0.5f} : Color{0.5f, 0.75f, 0.87f}, 1.5);
    const Eigen::MatrixXd run = runs[shown].topRows(std::min<Eigen::Index>(at + 2, runs[shown].rows()));
    const auto now = run.bottomRows<1>();
    const Color color = hits(runs[shown]) ? kDeadReckoningColor : kEstimateColor;
    draw(run, 0.06, color, 4);
    const Pose X_WR =
        translation(now[0], now[1], 0.12) * rotation(std::atan(now[5]), Eigen::Vector3d::UnitZ());
    picture.solids.push_back({{.type = ShapeType::kBox, .extent = {0.5, 0.3, 0.2}}, X_WR, color, "robot"});
    const Shape disc{.type = ShapeType::kCylinder, .extent = {1, 1, 0.6}, .radius = kRadius - 0.2};
    picture.solids.push_back({disc, translation(kGoal / 2, 0, 0.3), kTruthColor, "obstacle"});
    const char* names[] = {"the mean of all demonstrations", "a mixture of ways", "DAgger"};
    const auto collisions = std::ranges::count_if(runs, hits);
    const std::string text = std::to_string(collisions) + " of 30 runs hit the obstacle";
    picture.captions.push_back({.text = names[which] + (": " + text), .scale = 1.5});
    view.plot("distance to the obstacle [m]", t / 30., std::hypot(now[0] - kGoal / 2, now[1]) - kRadius);
    view.plot("runs that hit it", t / 30., static_cast<double>(collisions));
    view.show(picture);
  }
}
