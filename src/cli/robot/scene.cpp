#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command_line_internal.h"
#include "cli/command_table.h"
#include "cli/option_table_internal.h"
#include "cli/robot/render_plan.h"
#include "cli/robot/robot_options_internal.h"
#include "cli/robot/scene_option.h"
#include "cli/robot/scene_verbs.h"

namespace rex::cli {
namespace {

CLI::App* addVerbOf(CLI::App* scene, const std::string& name, const std::string& purpose,
                    const std::string& examples) {
  CLI::App* verb = addVerb(scene, name, purpose, examples);
  verb->fallthrough();  // options for reading the scene may also come after the verb
  return verb;
}

void addInfo(CLI::App* scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  CLI::App* verb = addVerbOf(scene, "info", "Show the tree, the joints in the order of q, masses and shapes",
                             "Examples:\n  scripts/rex scene man info\n  scripts/rex scene man info --json");
  addJson(verb, options->json);
  verb->callback(
      [&action, options] { action = [options](const Project& p) { return sceneInfo(p, *options); }; });
}

void addCheck(CLI::App* scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  CLI::App* verb = addVerbOf(scene, "check", "Say whether a file loads, and what looks doubtful in it",
                             "Example: scripts/rex scene man.ors check\n"
                             "Exit codes: 0 the scene loads, perhaps with warnings; 1 it does not.");
  addJson(verb, options->json);
  verb->callback(
      [&action, options] { action = [options](const Project& p) { return sceneCheck(p, *options); }; });
}

void addKinematics(CLI::App* scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  CLI::App* verb = addVerbOf(
      scene, "fk", "Compute the poses of all bodies",
      "Examples:\n  scripts/rex scene pegArm fk --q 0.1,0.2,0.3\n  scripts/rex scene man fk --q 0 --json");
  addPosture(verb, options->posture);
  addJson(verb, options->json);
  verb->callback(
      [&action, options] { action = [options](const Project& p) { return sceneKinematics(p, *options); }; });
}

void addJacobian(CLI::App* scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  const auto own = std::make_shared<JacobianOptions>();
  CLI::App* verb = addVerbOf(scene, "jacobian",
                             "Compute the position Jacobian of a point on a body, and the rotation Jacobian",
                             "Example: scripts/rex scene pegArm jacobian --body peg --point 0,0,0.3 --q 0");
  addOptions(verb,
             {OptionRow("--body", own->body, "NAME", "name of the body, or of one of its shapes").required(),
              {"--point", own->point, "x,y,z", "the point in the body's frame, metres"}});
  addPosture(verb, options->posture);
  addJson(verb, options->json);
  verb->callback([&action, options, own] {
    own->scene = *options;
    action = [own](const Project& p) { return sceneJacobian(p, *own); };
  });
}

void addContacts(CLI::App* scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  const auto own = std::make_shared<ContactsOptions>();
  const auto pairs = std::make_shared<PairsOptions>();
  const auto listsPairs = std::make_shared<bool>(false), looksForNever = std::make_shared<bool>(false);
  CLI::App* verb = addVerbOf(
      scene, "contacts", "List near shapes that may collide, nearest first, or which bodies may collide",
      "Examples:\n  scripts/rex scene pegInAHole contacts --q 0.6,0.5,0,0,0,0,0 --margin 0.02\n"
      "  scripts/rex scene humanoid contacts --pairs\n"
      "  scripts/rex scene robot.urdf contacts --never --samples 10000 > robot.srdf\n\n" +
          fmt::format("Refuses a scene with more than {} pairs of shapes that take part in contacts.",
                      kMostContactPairs));
  const auto added = addOptions(
      verb,
      {{"--margin", own->margin, {1e-9, 1e9}, "METRES", "distance below which pairs add to the contact cost"},
       {"--pairs", *listsPairs, "which bodies may collide, and why others may not"},
       {"--never", *looksForNever, "write an SRDF that disables pairs that never or always touch"},
       {"--samples", pairs->samples, {1, 1e6}, "N", "number of random postures for --never"},
       seedRow(pairs->seed, "seed of the random postures")});
  addPosture(verb, options->posture);
  CLI::Option *margin = added[0], *list = added[1], *never = added[2];
  for (const std::size_t k : {3, 4}) added[k]->needs(never);
  list->excludes(never)->excludes(margin);
  never->excludes(margin);
  addJson(verb, options->json);
  verb->callback([&action, options, own, pairs, listsPairs, looksForNever] {
    own->scene = pairs->scene = *options;
    action = [own, pairs, lists = *listsPairs, never = *looksForNever](const Project& p) {
      if (never) return sceneNeverTouching(p, *pairs);
      return lists ? scenePairs(p, *pairs) : sceneContacts(p, *own);
    };
  });
}

void addDynamics(CLI::App* scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  const auto own = std::make_shared<DynamicsOptions>();
  CLI::App* verb =
      addVerbOf(scene, "dynamics", "Compute M and F of M qdd + F = u, energies, and qdd",
                "Examples:\n  scripts/rex scene pegArm dynamics --q 0.1,0.2,0.3 --v 0,1,0\n"
                "  scripts/rex scene arm3 dynamics --u 5,0,0 --json\n\n"
                "Gravity is 9.81 m/s^2 along -z. Joints move freely: without friction, limits and contacts.");
  addPosture(verb, options->posture);
  addOptions(verb, {{"--v", own->velocity, "VELOCITY", "all velocities, or joint=number,..."},
                    {"--u", own->force, "FORCE", "forces of all joints, or joint=number,..."}});
  addJson(verb, options->json);
  verb->callback([&action, options, own] {
    own->scene = *options;
    action = [own](const Project& p) { return sceneDynamics(p, *own); };
  });
}

void addConvert(CLI::App* scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  const auto own = std::make_shared<ConvertOptions>();
  CLI::App* verb = addVerbOf(scene, "convert", "Write the scene as .ors or .urdf",
                             "Examples:\n  scripts/rex scene man convert man.urdf\n"
                             "  scripts/rex scene robot.urdf convert robot.ors");
  verb->add_option("OUT", own->out, "the file to write; its ending says which format")
      ->type_name("")
      ->required();
  verb->callback([&action, options, own] {
    if (options->json) throw CLI::ExcludesError("--json", "convert");
    own->scene = options->scene;
    action = [own](const Project& p) { return sceneConvert(p, *own); };
  });
}

void addSceneRender(CLI::App* scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  const auto own = std::make_shared<RenderOptions>();
  CLI::App* verb = addVerbOf(scene, "render", "Draw the scene, as `rex render` does",
                             "Example: scripts/rex scene man render -o man.png");
  verb->add_option("-o,--out", own->out, "what to make")->type_name("FILE");
  addRenderOptions(verb, *own);
  addGl(verb, own->gl);
  verb->callback([&action, options, own] {
    if (options->json) throw CLI::ExcludesError("--json", "render");
    const std::string shapes = own->scene.shapes;
    own->scene = options->scene;
    own->scene.shapes = shapes;
    action = [own](const Project& p) { return render(p, *own); };
  });
}

}  // namespace

void addScene(CLI::App* scene, Action& action) {
  const auto options = std::make_shared<SceneOptions>();
  scene->footer(
      "Examples:\n  scripts/rex scene man\n  scripts/rex scene my_robot.urdf check\n"
      "`scripts/rex scene FILE COMMAND --help` explains a command.\n"
      "Exit codes: 0 done, 1 `check` found a file that does not load, 64 wrong use, or a\n"
      "scene that does not load.");
  addSceneFile(scene, "FILE", options->scene.file);
  addReading(scene, options->scene.reading);
  addJson(scene, options->json);
  scene->require_subcommand(0, 1);
  addInfo(scene, action, options);
  addCheck(scene, action, options);
  addKinematics(scene, action, options);
  addJacobian(scene, action, options);
  addContacts(scene, action, options);
  addDynamics(scene, action, options);
  addSceneRender(scene, action, options);
  addConvert(scene, action, options);
  scene->callback([&action, scene, options] {
    if (scene->get_subcommands().empty())
      action = [options](const Project& p) { return sceneInfo(p, *options); };
  });
}

}  // namespace rex::cli
