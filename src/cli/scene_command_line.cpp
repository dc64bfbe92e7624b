#include <memory>
#include <string>

#include <fmt/format.h>

#include "cli/command_line_internal.h"
#include "cli/contact_limit.h"

namespace rex::cli {
namespace {

constexpr const char* kSceneHelp = "an .ors or .urdf file, or a scene of the course, such as man";

void addReading(CLI::App* command, ReadOptions& reading) {
  command
      ->add_option("--assets", reading.assetRoot, "folder of all meshes (default: above that of the scene)")
      ->type_name("DIR");
  command->add_flag("--allow-missing-meshes", reading.allowMissingMeshes,
                    "boxes for meshes that are not found");
  command->add_flag("--free-base", reading.freeBase, "let the root of a .urdf move freely");
}

void addRenderOptions(CLI::App* command, RenderOptions& options) {
  const auto list = [&](const char* name, std::vector<std::string>& values, const char* type,
                        const char* help) {
    command->add_option(name, values, help)->allow_extra_args(false)->type_name(type);
  };
  list("--q", options.postures, "POSTURE",
       "all numbers, or joint=number,...; several: a motion through them");
  command->add_option("--motion", options.motion, "a motion: a posture per line, with or without a time")
      ->type_name("FILE");
  command->add_option("--seconds", options.seconds, "from each --q to the next (default: 2)")->type_name("S");
  list("--camera", options.cameras, "VIEW",
       "front, back, left, right, top, x,y,z or eye@target; may be repeated");
  list("--trace", options.traces, "BODY", "whose way is drawn as a line");
  command->add_option("--caption", options.caption, "text in the top left corner, or title of a page")
      ->type_name("TEXT");
  command->add_option("--size", options.size, "pixels of one picture (default: 640x480, of a page 800x600)")
      ->type_name("WxH");
  command
      ->add_option("--shapes", options.scene.shapes,
                   "which are drawn: visible, contact or all (default: visible)")
      ->type_name("WHICH");
  command->add_option("--show", options.show, "color, depth or segmentation (default: color)")
      ->type_name("WHAT");
  command
      ->add_option("--aa", options.antiAliasing,
                   "smooth edges by none, fxaa or msaa4 (default: msaa4, films: fxaa)")
      ->type_name("KIND");
}

// Of the film that a command writes besides.
void addFilmOptions(CLI::App* command, RenderOptions& film) {
  command->add_option("--camera", film.cameras, "as for `rex render`; may be repeated")
      ->allow_extra_args(false)
      ->type_name("VIEW");
  command->add_option("--size", film.size, "pixels of the film (default: 640x480)")->type_name("WxH");
}

CLI::App* addVerb(CLI::App& scene, const std::string& name, const std::string& purpose,
                  const std::string& examples) {
  CLI::App* verb = add(scene, name, purpose, examples);
  verb->fallthrough();  // how the scene is read may also be said behind the verb
  return verb;
}

void addPosture(CLI::App* verb, std::string& posture) {
  verb->add_option("--q", posture, "all numbers, joint=number,..., 0, or file (default: file)")
      ->type_name("POSTURE");
}

void addJson(CLI::App* verb, bool& json) { verb->add_flag("--json", json, "print JSON"); }

void addInfo(CLI::App& scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  CLI::App* verb = addVerb(scene, "info", "Show the tree, the joints in the order of q, masses and shapes",
                           "Examples:\n  scripts/rex scene man info\n  scripts/rex scene man info --json");
  addJson(verb, options->json);
  verb->callback(
      [&action, options] { action = [options](const Project& p) { return sceneInfo(p, *options); }; });
}

void addCheck(CLI::App& scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  CLI::App* verb = addVerb(scene, "check", "Say whether a file loads, and what is doubtful in it",
                           "Example: scripts/rex scene man.ors check\n"
                           "Exit codes: 0 the scene loads, perhaps with warnings; 1 it does not.");
  addJson(verb, options->json);
  verb->callback(
      [&action, options] { action = [options](const Project& p) { return sceneCheck(p, *options); }; });
}

void addKinematics(CLI::App& scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  CLI::App* verb = addVerb(
      scene, "fk", "Compute where all bodies are",
      "Examples:\n  scripts/rex scene pegArm fk --q 0.1,0.2,0.3\n  scripts/rex scene man fk --q 0 --json");
  addPosture(verb, options->posture);
  addJson(verb, options->json);
  verb->callback(
      [&action, options] { action = [options](const Project& p) { return sceneKinematics(p, *options); }; });
}

void addJacobian(CLI::App& scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  const auto own = std::make_shared<JacobianOptions>();
  CLI::App* verb =
      addVerb(scene, "jacobian", "Compute the Jacobian of a point on a body, and of its rotation",
              "Example: scripts/rex scene pegArm jacobian --body peg --point 0,0,0.3 --q 0");
  verb->add_option("--body", own->body, "which body, or a shape of it")->type_name("NAME")->required();
  verb->add_option("--point", own->point, "in the body's frame, metres (default: 0,0,0)")->type_name("x,y,z");
  addPosture(verb, options->posture);
  addJson(verb, options->json);
  verb->callback([&action, options, own] {
    own->scene = *options;
    action = [own](const Project& p) { return sceneJacobian(p, *own); };
  });
}

void addContacts(CLI::App& scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  const auto own = std::make_shared<ContactsOptions>();
  CLI::App* verb =
      addVerb(scene, "contacts", "List the shapes that may collide and are near, nearest first",
              "Example: scripts/rex scene pegInAHole contacts --q 0.6,0.5,0,0,0,0,0 --margin 0.02\n\n" +
                  fmt::format("Refuses a scene with more than {} pairs of shapes that take part in contacts.",
                              kMostContactPairs));
  verb->add_option("--margin", own->margin, "the contact cost counts what is nearer (default: 0.1)")
      ->type_name("METRES");
  addPosture(verb, options->posture);
  addJson(verb, options->json);
  verb->callback([&action, options, own] {
    own->scene = *options;
    action = [own](const Project& p) { return sceneContacts(p, *own); };
  });
}

void addDynamics(CLI::App& scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  const auto own = std::make_shared<DynamicsOptions>();
  CLI::App* verb =
      addVerb(scene, "dynamics", "Compute M and F of M qdd + F = u, energies, and qdd",
              "Examples:\n  scripts/rex scene pegArm dynamics --q 0.1,0.2,0.3 --v 0,1,0\n"
              "  scripts/rex scene arm3 dynamics --u 5,0,0 --json\n\n"
              "Gravity is 9.81 m/s^2 along -z. Joints are free: without friction, limits and contacts.");
  addPosture(verb, options->posture);
  verb->add_option("--v", own->velocity, "all velocities, or joint=number,... (default: 0)")
      ->type_name("VELOCITY");
  verb->add_option("--u", own->force, "forces of all joints, or joint=number,... (default: 0)")
      ->type_name("FORCE");
  addJson(verb, options->json);
  verb->callback([&action, options, own] {
    own->scene = *options;
    action = [own](const Project& p) { return sceneDynamics(p, *own); };
  });
}

void addConvert(CLI::App& scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  const auto own = std::make_shared<ConvertOptions>();
  CLI::App* verb = addVerb(scene, "convert", "Write the scene as .ors or .urdf",
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

void addSceneRender(CLI::App& scene, Action& action, const std::shared_ptr<SceneOptions>& options) {
  const auto own = std::make_shared<RenderOptions>();
  CLI::App* verb = addVerb(scene, "render", "Draw the scene, as `rex render` does",
                           "Example: scripts/rex scene man render -o man.png");
  verb->add_option("-o,--out", own->out, "what to make")->type_name("FILE")->required();
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

void addScene(CLI::App& program, Action& action) {
  const auto options = std::make_shared<SceneOptions>();
  CLI::App* scene = add(program, "scene", "Look into a scene, check it, convert it",
                        "Examples:\n  scripts/rex scene man\n  scripts/rex scene my_robot.urdf check\n"
                        "`scripts/rex scene FILE COMMAND --help` explains a command.\n"
                        "Exit codes: 0 done, 1 `check` found a file that does not load, 64 wrong use, or a\n"
                        "scene that does not load.");
  scene->add_option("FILE", options->scene.file, kSceneHelp)->type_name("")->required();
  addReading(scene, options->scene.reading);
  addJson(scene, options->json);
  scene->require_subcommand(0, 1);
  addInfo(*scene, action, options), addCheck(*scene, action, options);
  addKinematics(*scene, action, options), addJacobian(*scene, action, options);
  addContacts(*scene, action, options), addDynamics(*scene, action, options);
  addSceneRender(*scene, action, options), addConvert(*scene, action, options);
  scene->callback([&action, scene, options] {
    if (scene->get_subcommands().empty())
      action = [options](const Project& p) { return sceneInfo(p, *options); };
  });
}

void addRender(CLI::App& program, Action& action) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      add(program, "render", "Draw a scene: a picture, a film, a model or a page with a replay",
          "Examples:\n  scripts/rex render man -o man.png\n"
          "  scripts/rex render man.ors --camera front --camera right --camera top -o views.png\n"
          "  scripts/rex render pegArm.ors --q 0,0,0 --q 0.5,-0.5,0.3 --trace peg -o swing.mp4\n"
          "  scripts/rex render man.ors --q 'upArmR>dnArmR=1.5' -o man.html\n\n"
          "The ending of FILE says what is made: .png (of a motion its key frames); .mp4, .webm, .gif\n"
          "(of one posture a walk around it); .glb; .html; or none for a folder of frames.");
  command->add_option("SCENE", options->scene.file, kSceneHelp)->type_name("")->required();
  command->add_option("-o,--out", options->out, "what to make")->type_name("FILE")->required();
  addReading(command, options->scene.reading);
  addRenderOptions(command, *options);
  addGl(command, options->gl);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return render(p, *options); }; });
}

void addSimulate(CLI::App& program, Action& action) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* command =
      add(program, "simulate", "Let a robot fall, or hold it: a log, an energy plot and a film",
          "Examples:\n  scripts/rex simulate pegArm -o fall\n"
          "  scripts/rex simulate arm3 --q 0.5,-0.5,0.3 --v 0,2,0 --hold --seconds 2 -o hold\n"
          "  scripts/rex simulate pegArm --engine euler --tau 0.01 -o euler\n"
          "  scripts/rex simulate quadruped --free-base --engine bullet --floor -0.9 -o drop\n\n"
          "Joints are free; only bullet knows contacts and limits of joints. DIR gets log.csv\n"
          "(time, q, v and energies of every step), energy.png, energy.svg and simulate.mp4.");
  command->add_option("SCENE", options->scene.file, kSceneHelp)->type_name("")->required();
  command->add_option("-o,--out", options->out, "folder for what is written")->type_name("DIR")->required();
  command
      ->add_option("--engine", options->engine,
                   "rk4, beeman, leapfrog, semi-implicit, euler; bullet (default: rk4)")
      ->type_name("NAME");
  command->add_option("--seconds", options->seconds, "how long (default: 5)")->type_name("S");
  command->add_option("--tau", options->tau, "seconds per step (default: 0.001)")->type_name("S");
  addPosture(command, options->posture);
  command->add_option("--v", options->velocity, "all velocities, or joint=number,... (default: 0)")
      ->type_name("VELOCITY");
  command->add_flag("--hold", options->hold, "computed torque holds the posture of the start");
  command->add_flag("--friction", options->friction, "with friction and damping of the scene's joints");
  command->add_option("--noise", options->noise, "each step adds sqrt(tau) * X * N(0, 1) to velocities")
      ->type_name("X");
  addSeed(command, options->seed, "of the noise (default: 0)");
  command->add_option("--floor", options->floor, "a floor at that height, metres (bullet; default: none)")
      ->type_name("Z");
  command->add_flag("--no-film", options->noFilm, "no simulate.mp4");
  addFilmOptions(command, options->film);
  command->add_option("--trace", options->traces, "whose way is drawn as a line")
      ->allow_extra_args(false)
      ->type_name("BODY");
  addJson(command, options->json);
  addReading(command, options->scene.reading);
  addGl(command, options->film.gl);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return simulate(p, *options); }; });
}

void addPlan(CLI::App& program, Action& action) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App* command = add(
      program, "plan", "Find a way for a robot past all obstacles: path, film and replay",
      "Examples:\n  scripts/rex plan board --goal 1.5,-1.1,-1 -o around\n"
      "  scripts/rex plan maze --goal 3,0,0 --planner rrt-star --speed 0.5 -o rooms\n"
      "  scripts/rex plan board --goal 'stem>arm1=1.5' --planner lazy-prm --seeds 20 -o compare\n\n"
      "Lengths are those of postures as vectors: root of the sum of squares of rad and m. Turning joints\n"
      "without limits turn the shorter way round. DIR gets path.csv (time and joints; `rex render --motion`\n"
      "reads it), tree.png (what was explored), path.mp4 and path.html (a replay).\n"
      "Exit codes: 0 found a path, 1 found none, or one that is not clear, 64 wrong use.");
  command->add_option("SCENE", options->scene.file, kSceneHelp)->type_name("")->required();
  command->add_option("-o,--out", options->out, "folder for what is written")->type_name("DIR")->required();
  command->add_option("--start", options->start, "all numbers, joint=number,..., 0, or file (default: file)")
      ->type_name("POSTURE");
  command->add_option("--goal", options->goal, "the same")->type_name("POSTURE")->required();
  command
      ->add_option("--planner", options->planner,
                   "rrt, rrt-connect, rrt-star; prm, prm-star, lazy-prm (default: rrt-connect)")
      ->type_name("NAME");
  command->add_option("--margin", options->margin, "between all shapes on the way (default: 0.01)")
      ->type_name("METRES");
  command->add_option("--resolution", options->resolution, "of the checks along ways (default: 0.02)")
      ->type_name("LENGTH");
  command->add_option("--step", options->step, "by which trees grow (default: 0.3)")->type_name("LENGTH");
  command
      ->add_option("--samples", options->samples,
                   "the budget (default: 100000; rrt-star 10000, roadmaps 2000)")
      ->type_name("N");
  addSeed(command, options->seed, "of the random numbers (default: 0)");
  command->add_option("--seeds", options->seeds, "searches with so many seeds, and prints a table")
      ->type_name("N");
  CLI::Option* smooth = command->add_flag("--smooth");
  smooth->description("shortcuts, then rounded corners (default)");
  command->add_flag("--no-smooth", options->noSmooth, "the path as the planner finds it");
  command->add_option("--speed", options->speed, "along the path, length per second (default: 1)")
      ->type_name("X");
  command->add_option("--body", options->body, "whose ways are drawn (default: that which most joints move)")
      ->type_name("NAME");
  command->add_flag("--no-film", options->noFilm, "no path.mp4 and path.html");
  addFilmOptions(command, options->film);
  addJson(command, options->json);
  addReading(command, options->scene.reading);
  addGl(command, options->film.gl);
  command->callback([&action, options, smooth] {
    if (options->noSmooth && smooth->count() > 0) throw CLI::ExcludesError("--smooth", "--no-smooth");
    action = [options](const Project& p) { return planPath(p, *options); };
  });
}

void addTrajectory(CLI::App& program, Action& action) {
  const auto options = std::make_shared<TrajectoryOptions>();
  CLI::App* command = add(
      program, "trajectory",
      "Move a body to a point smoothly, past obstacles: motion, costs, film and replay",
      "Examples:\n  scripts/rex trajectory arm7 --goal arm7:0.5,0.2,0.6 -o reach\n"
      "  scripts/rex trajectory board --goal eff:0,-0.3,0.5 --avoid -o around\n\n"
      "Minimises the accelerations of all joints from rest to rest (slides 5:3 to 5:5). DIR gets costs.png,\n"
      "trajectory.csv (time and joints; `rex render --motion` reads it), trajectory.mp4 and\n"
      "trajectory.html (a replay).\n"
      "Exit codes: 0 found, 1 not: it says which constraint does not hold; 64 wrong use.");
  command->add_option("SCENE", options->scene.file, kSceneHelp)->type_name("")->required();
  command->add_option("-o,--out", options->out, "folder for what is written")->type_name("DIR")->required();
  command->add_option("--goal", options->goal, "where the origin of the body shall come to rest, metres")
      ->type_name("BODY:x,y,z")
      ->required();
  command->add_option("--start", options->start, "all numbers, joint=number,..., 0, or file (default: file)")
      ->type_name("POSTURE");
  command->add_flag("--avoid", options->avoid, "all shapes keep apart, also between steps");
  command->add_option("--margin", options->margin, "by so much (default: 0.02)")->type_name("METRES");
  command->add_option("--steps", options->steps, "of the motion (default: 100)")->type_name("N");
  command->add_option("--seconds", options->seconds, "it takes (default: 2)")->type_name("S");
  command
      ->add_option("--method", options->method,
                   "augmented-lagrangian, penalty, barrier (default: augmented-lagrangian)")
      ->type_name("NAME");
  command->add_flag("--no-film", options->noFilm, "no trajectory.mp4 and trajectory.html");
  addFilmOptions(command, options->film);
  addJson(command, options->json);
  addReading(command, options->scene.reading);
  addGl(command, options->film.gl);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return planTrajectory(p, *options); }; });
}

}  // namespace rex::cli
