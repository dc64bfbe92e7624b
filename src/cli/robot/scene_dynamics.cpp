#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/json_internal.h"
#include "cli/numbers.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/scene_verbs.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"

namespace rex::cli {
namespace {

struct Dynamics {
  Eigen::VectorXd v, u;
  EquationOfMotion motion;
  Energy energy;
  Eigen::VectorXd a;
};

constexpr int kColumn = 11;  // characters of a number and the blank before it

// Four digits each; zero has no sign.
std::string numbers(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::string line;
  for (const double value : values) line += fmt::format(" {:{}.4g}", value + 0., kColumn - 1);
  return line;
}

void sayHead(const std::string& first, std::size_t width, const std::vector<std::string>& names) {
  std::string line = fmt::format("{:{}}", first, width);
  for (const std::string& name : names) line += fmt::format(" {:>{}}", name, kColumn - 1);
  say(line);
}

// Wide matrices are split into bands of as many columns as fit in the terminal.
void sayMatrix(const Eigen::MatrixXd& M, const std::vector<std::string>& names, std::size_t width) {
  constexpr int kLineLength = 80;
  const int band = std::max(1, (kLineLength - static_cast<int>(width)) / kColumn);
  for (int from = 0; from < static_cast<int>(M.cols()); from += band) {
    const int count = std::min(band, static_cast<int>(M.cols()) - from);
    std::vector<std::string> heads;
    for (int i = from; i < from + count; ++i) heads.push_back(fmt::format("v{}", i));
    say("");
    sayHead("M", width, heads);
    for (int i = 0; i < static_cast<int>(M.rows()); ++i)
      say(fmt::format("{:{}}", names[static_cast<std::size_t>(i)], width) +
          numbers(M.row(i).segment(from, count).transpose()));
  }
}

void sayToPeople(const Model& model, const Dynamics& at) {
  const std::vector<std::string> names = printableVelocityNames(model);
  const std::size_t width = widestOf(names, 5);
  say(fmt::format("kinetic energy {:.6g} J, potential energy {:.6g} J; M qdd + F = u", at.energy.kinetic,
                  at.energy.potential));
  sayHead("joint", width, {"v", "u", "F", "qdd"});
  for (int i = 0; i < model.nv(); ++i)
    say(fmt::format("{:{}}", names[static_cast<std::size_t>(i)], width) +
        numbers(Eigen::Vector4d(at.v[i], at.u[i], at.motion.F[i], at.a[i])));
  sayMatrix(at.motion.M, names, width);
}

}  // namespace

ExitCode sceneDynamics(const Project& project, const DynamicsOptions& options) {
  const Model model = loadScene(project, options.scene.scene);
  const auto given = [&](const std::string& text, const auto& parse, const Eigen::VectorXd& otherwise) {
    return text.empty() ? otherwise : parse(model, text);
  };
  const Eigen::VectorXd q = given(options.scene.posture, parsePosture, model.initialPositions());
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.nv());
  const Eigen::VectorXd v = given(options.velocity, parseVelocities, zero);
  const Eigen::VectorXd u = given(options.force, parseForces, zero);
  const Dynamics at = asWrongUse([&] {
    return Dynamics{v, u, equationOfMotion(model, q, v), energy(model, q, v),
                    forwardDynamics(model, q, v, u)};
  });
  noteOverflow(at.motion.M.allFinite() && at.motion.F.allFinite() && at.a.allFinite() &&
               std::isfinite(at.energy.kinetic) && std::isfinite(at.energy.potential));
  if (!options.scene.json) {
    sayToPeople(model, at);
    return ExitCode::kFull;
  }
  say(dump(Json{{"M", jsonOfRows(at.motion.M)},
                {"F", jsonOf(at.motion.F)},
                {"kinetic", at.energy.kinetic},
                {"potential", at.energy.potential},
                {"qdd", jsonOf(at.a)}}));
  return ExitCode::kFull;
}

}  // namespace rex::cli
