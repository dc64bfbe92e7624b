#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/results_internal.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/scene_option.h"
#include "cli/robot/scene_verbs.h"
#include "cli/terminal.h"
#include "collision/collision_pairs.h"
#include "collision/contacts.h"

namespace rex::cli {
namespace {

Json jsonOfPairs(const Model& model, const std::vector<Proxy>& near) {
  Json pairs = Json::array();
  for (const auto& [pair, proximity] : near)
    pairs.push_back({{"a", shapeLabel(model, pair.a)},
                     {"b", shapeLabel(model, pair.b)},
                     {"distance", proximity.distance},
                     {"pa", toJson(proximity.p_WA)},
                     {"pb", toJson(proximity.p_WB)}});
  return pairs;
}

}  // namespace

ExitCode sceneContacts(const Project& project, const ContactsOptions& options) {
  const Model model = loadScene(project, options.scene.scene);
  const Eigen::VectorXd q = parsePosture(model, options.scene.posture);
  const ContactModel contacts = sceneContactModel(model);
  const BodyPoses poses = forwardKinematics(model, q);
  const double reach = std::max(options.margin, kQueryCutoff);
  const std::vector<Proxy> near = proxies(contacts, poses, reach);
  const double cost = contactCost(contacts, poses, options.margin);
  Results all{.json = {{"cost", cost},
                       {"rule", toString(model.collisionRule())},
                       {"pairs", jsonOfPairs(model, near)}}};
  all.line(
      "{} pairs of shapes may collide (rule {}, see --pairs), {} are nearer than {:g} m; contact cost {:.6g} "
      "with a margin of {:g} m",
      contacts.pairs().size(), toString(model.collisionRule()), near.size(), reach, cost, options.margin);
  if (!near.empty())
    for (const std::string& report = proxyReport(model, near);
         const std::string_view line : splitLines(report))
      all.line("{}", escapeForTerminal(line));
  all.print(options.scene.json);
  return ExitCode::kFull;
}

}  // namespace rex::cli
