#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/numbers.h"
#include "cli/results_internal.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/scene_verbs.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/joint_springs.h"

namespace rex::cli {
namespace {

struct Dynamics {
  Eigen::VectorXd v, u;
  EquationOfMotion motion;
  Energy energy;
  Eigen::VectorXd a;
};

constexpr int kColumn = 10, kNameColumn = 5;  // characters

// Zero has no sign.
std::string fourDigits(double value) { return fmt::format("{:.4g}", value + 0.); }

Results resultsOf(const Model& model, const Dynamics& at) {
  Results all{.json = {{"M", jsonOfRows(at.motion.M)},
                       {"F", toJson(at.motion.F)},
                       {"kinetic", at.energy.kinetic},
                       {"potential", at.energy.potential},
                       {"qdd", toJson(at.a)}}};
  all.line("kinetic energy {:.6g} J, potential energy {:.6g} J; M qdd + F = u", at.energy.kinetic,
           at.energy.potential);
  const std::vector<std::string> names = printableVelocityNames(model);
  Table joints(kNameColumn, kColumn);
  joints.add({"joint", "v", "u", "F", "qdd"});
  for (int i = 0; i < model.nv(); ++i)
    joints.add(names[static_cast<std::size_t>(i)], Eigen::Vector4d(at.v[i], at.u[i], at.motion.F[i], at.a[i]),
               fourDigits);
  all.line("{}", joints.text());
  // Wide matrices are split into bands of as many columns as fit in the terminal.
  constexpr int kLineLength = 80;
  std::size_t width = kNameColumn;
  for (const std::string& name : names) width = std::max(width, name.size());
  const int band = std::max(1, (kLineLength - static_cast<int>(width)) / (kColumn + 1));
  for (int from = 0; from < model.nv(); from += band) {
    const int count = std::min(band, model.nv() - from);
    Table M(kNameColumn, kColumn);
    std::vector<std::string> heads = {"M"};
    for (int i = from; i < from + count; ++i) heads.push_back(fmt::format("v{}", i));
    M.add(heads);
    for (int i = 0; i < model.nv(); ++i)
      M.add(names[static_cast<std::size_t>(i)], at.motion.M.row(i).segment(from, count).transpose(),
            fourDigits);
    all.line("\n{}", M.text());
  }
  return all;
}

}  // namespace

ExitCode sceneDynamics(const Project& project, const DynamicsOptions& options) {
  const Model model = loadScene(project, options.scene.scene);
  const Eigen::VectorXd q = parsePosture(model, options.scene.posture);
  const Eigen::VectorXd v = parseVelocities(model, options.velocity);
  const Eigen::VectorXd u = parseForces(model, options.force);
  const Dynamics at = asWrongUse([&] {
    const Eigen::VectorXd springs = springForces(model, q);
    Dynamics all{v, u, equationOfMotion(model, q, v), energy(model, q, v),
                 forwardDynamics(model, q, v, u + springs)};
    all.motion.F -= springs;
    return all;
  });
  noteOverflow(at.motion.M.allFinite() && at.motion.F.allFinite() && at.a.allFinite() &&
               std::isfinite(at.energy.kinetic) && std::isfinite(at.energy.potential));
  resultsOf(model, at).print(options.scene.json);
  return ExitCode::kFull;
}

}  // namespace rex::cli
