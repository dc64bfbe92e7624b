#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/exit_code.h"
#include "cli/project.h"
#include "cli/scene_option.h"

/// The subcommands of `rex`, one source file each. They print for people, and throw UsageError for names that
/// do not exist, Error when the project or the machine is broken.
namespace rex::cli {

ExitCode list(const Project& project);

/// The points of the last test of each exercise, and what to do next.
ExitCode progress(const Project& project);

struct RunOptions {
  std::string exercise;
  bool solution = false;
  std::filesystem::path out;  ///< empty: out/EXERCISE, or out/EXERCISE-solution
};
ExitCode run(const Project& project, const RunOptions& options);

struct TestOptions {
  std::string exercise;
  bool solution = false;
  std::filesystem::path main;       ///< empty: the exercise's own
  std::vector<std::string> checks;  ///< empty: all
  std::optional<std::uint64_t> seed;
  bool json = false;
  bool debug = false;              ///< with the sanitizers
  std::filesystem::path out;       ///< empty: as for run
  std::optional<int> level{};      ///< of the sandbox; nothing: 0
  std::filesystem::path secret{};  ///< file with the secret of the course; empty: none
};
ExitCode test(const Project& project, const TestOptions& options);

struct TestManyOptions {
  std::vector<std::string> exercises;
  bool all = false;  ///< instead of those
  int jobs = 0;      ///< gradings at once; 0: one per processor
  TestOptions each;  ///< for several, `out` gets a folder for each; main and checks belong to one
};
/// Grades several at the same time and tells of each in the order asked for; one as test() does. Of their
/// exit codes the largest: a fault of the grader, then what cannot be graded, then what is below full score.
ExitCode testMany(const Project& project, const TestManyOptions& options);

struct ReportOptions {
  std::filesystem::path results;
  std::string format;         ///< a name of grading::reportFormats()
  std::filesystem::path out;  ///< empty: the standard output
};
/// Writes a result file in the words of another program. kGraderFault if that is what it tells of.
ExitCode report(const ReportOptions& options);

struct WatchOptions {
  std::string exercise;
  bool poll = false;  ///< do not ask inotify
};
/// Grades now and after each save. Ends by itself only without a keyboard, at the full score.
ExitCode watch(const Project& project, const WatchOptions& options);

struct HintOptions {
  std::string exercise;
  std::string part;    ///< empty: the first that needs one
  bool again = false;  ///< those that were shown
};
ExitCode hint(const Project& project, const HintOptions& options);

struct ShowOptions {
  std::string exercise;
  bool solution = false;
};
/// Where replays, films, pictures and the result lie. kBelow if there are none.
ExitCode show(const Project& project, const ShowOptions& options);

/// Makes main.cpp as it was handed out, and keeps the one that is there.
ExitCode reset(const Project& project, const std::string& name);

/// Prints the reference solution where the course allows it. kBelow if the exercise must be solved first.
ExitCode solution(const Project& project, const std::string& name);

struct SubmitOptions {
  std::vector<std::string> exercises;
  std::filesystem::path out = "handin.zip";
};
/// Writes the zip file to hand in: EXERCISE/main.cpp of each, and receipt.json.
ExitCode submit(const Project& project, const SubmitOptions& options);

struct BenchOptions {
  std::vector<std::string> names;
  bool json = false;
};
ExitCode bench(const Project& project, const BenchOptions& options);

/// As typed; empty where nothing was. RenderPlan is what they mean.
struct RenderOptions {
  SceneOption scene{};
  std::vector<std::string> postures{};  ///< see parsePosture(); several: the motion through them
  std::filesystem::path motion{};       ///< see readMotion()
  std::optional<double> seconds{};      ///< from each posture to the next
  std::vector<std::string> cameras{};   ///< see View; several: side by side
  std::vector<std::string> traces{};    ///< bodies whose way is drawn
  std::string caption{};
  std::string size{};           ///< WIDTHxHEIGHT
  std::string show{};           ///< color, depth or segmentation
  std::string antiAliasing{};   ///< none, fxaa or msaa4
  std::string gl{};             ///< auto, osmesa or egl
  std::filesystem::path out{};  ///< its ending says what is made
};
ExitCode render(const Project& project, const RenderOptions& options);

struct SimulateOptions {
  SceneOption scene{};
  std::string posture{};   ///< see parsePosture(); empty: that of the file
  std::string velocity{};  ///< see parseVelocities(); empty: at rest
  std::string engine = "rk4";
  double seconds = 5;
  double tau = 1e-3;              ///< seconds per step
  bool hold = false;              ///< computed torque holds the posture
  bool friction = false;          ///< that of the joints, as in the scene
  double noise = 0;               ///< see StepperOptions
  std::optional<double> floor{};  ///< its height, metres; empty: none but what the scene has
  std::uint64_t seed = 0;
  bool noFilm = false;
  RenderOptions film{};               ///< cameras, size and gl of the film
  std::vector<std::string> traces{};  ///< bodies whose way is drawn
  bool json = false;
  std::filesystem::path out{};  ///< a folder
};
/// Lets a scene move under gravity; writes log, energy plot and film.
ExitCode simulate(const Project& project, const SimulateOptions& options);

struct PlanOptions {
  SceneOption scene{};
  std::string start{};  ///< see parsePosture(); empty: that of the file
  std::string goal{};
  std::string planner = "rrt-connect";
  double margin = 0.01;  ///< metres between all pairs of shapes
  double resolution = 0.02;
  std::optional<double> step{};  ///< of trees; see PathSearch
  std::optional<int> samples{};
  std::uint64_t seed = 0;
  int seeds = 1;  ///< searches, each with the next seed
  bool noSmooth = false;
  double speed = 1;      ///< of the motion along the path, in the metric of the space per second
  std::string body{};    ///< whose ways are drawn; empty: farthestBody()
  RenderOptions film{};  ///< cameras, size and gl of the pictures
  bool noFilm = false;
  bool json = false;
  std::filesystem::path out{};  ///< a folder
};
/// Looks for a way of a robot past all obstacles; writes the path, what was explored, a film and a replay.
/// kBelow if there is no path, or one that is not clear.
ExitCode planPath(const Project& project, const PlanOptions& options);

struct TrajectoryOptions {
  SceneOption scene{};
  std::string start{};   ///< see parsePosture(); empty: that of the file
  std::string goal{};    ///< BODY:x,y,z
  bool avoid = false;    ///< keep shapes apart
  double margin = 0.02;  ///< metres between all pairs of shapes
  int steps = 100;
  double seconds = 2;  ///< of the motion
  std::string method = "augmented-lagrangian";
  RenderOptions film{};  ///< cameras, size and gl of the pictures
  bool noFilm = false;
  bool json = false;
  std::filesystem::path out{};  ///< a folder
};
/// Moves a body to a point with little acceleration; writes the motion, its costs, a film and a replay.
/// kBelow if a constraint does not hold, or the motion is not proven clear.
ExitCode planTrajectory(const Project& project, const TrajectoryOptions& options);

struct SceneOptions {
  SceneOption scene{};
  std::string posture{};  ///< see parsePosture(); empty: that of the file
  bool json = false;
};
/// The bodies as a tree, and the coordinates of the joints.
ExitCode sceneInfo(const Project& project, const SceneOptions& options);
/// Everything that is wrong with a file. kBelow if it does not load.
ExitCode sceneCheck(const Project& project, const SceneOptions& options);
/// Where the bodies are.
ExitCode sceneKinematics(const Project& project, const SceneOptions& options);

struct JacobianOptions {
  SceneOptions scene{};
  std::string body{};
  std::string point{};  ///< x,y,z in the body's frame, metres; empty: its origin
};
ExitCode sceneJacobian(const Project& project, const JacobianOptions& options);

struct ContactsOptions {
  SceneOptions scene{};
  std::optional<double> margin{};  ///< metres; 0.1
};
/// What may collide and is near, and what that costs.
ExitCode sceneContacts(const Project& project, const ContactsOptions& options);

struct DynamicsOptions {
  SceneOptions scene{};
  std::string velocity{};  ///< see parseVelocities(); empty: at rest
  std::string force{};     ///< see parseForces(); empty: none
};
/// Mass matrix, bias forces, energies, and how the joints accelerate.
ExitCode sceneDynamics(const Project& project, const DynamicsOptions& options);

struct ConvertOptions {
  SceneOption scene{};
  std::filesystem::path out{};  ///< its ending says which format
};
ExitCode sceneConvert(const Project& project, const ConvertOptions& options);

struct SlamOptions {
  std::filesystem::path file{};  ///< where it is not, below the project's root
  std::string objective = "chi2";
  std::string start = "chordal";
  std::string kernel = "none";
  double kernelSize = 1;
  int iterations = 100;
  bool json = false;
  std::filesystem::path out{};   ///< a .g2o file; empty: none
  std::filesystem::path plot{};  ///< a .png or .svg file; empty: none
};
/// Makes the map of a pose graph fit its measurements. kBelow if it does not converge.
ExitCode slam(const Project& project, const SlamOptions& options);

struct FilterOptions {
  std::string filter = "ekf";
  int landmarks = 5;
  int steps = 300;
  double dynamicsNoise = 0.03, observationNoise = 0.5;
  bool rangeBearing = false;
  std::optional<double> bearingNoise{}, maxRange{}, fieldOfView{};
  double assumeDynamics = 1, assumeObservation = 1;  ///< factors of the deviations a filter believes in
  std::optional<int> particles{};
  std::uint64_t seed = 0;
  int seeds = 1;  ///< runs, each with the next seed
  bool noFilm = false;
  bool json = false;
  std::filesystem::path out{};  ///< a folder; empty: nothing is written
};
/// Lets a filter follow the car of the course; tells its errors and consistency.
ExitCode filter(const FilterOptions& options);

struct RiccatiOptions {
  std::filesystem::path file{};  ///< an object with the fields A, B, Q and R, each a list of rows
  bool isDiscrete = false;
  bool json = false;
};
/// Solves an algebraic Riccati equation. kBelow if it has no stabilizing solution.
ExitCode riccati(const Project& project, const RiccatiOptions& options);

struct CurvesOptions {
  std::string from{}, to{};  ///< x,y,heading; metres and radians
  double radius = 1;         ///< metres
  bool json = false;
};
/// The shortest ways of a car that drives forward only, and of one that may drive backward.
ExitCode curves(const CurvesOptions& options);

struct DoctorOptions {
  std::string gl;  ///< auto, osmesa or egl; empty: auto
  bool json = false;
  bool sandbox = false;        ///< attack the sandbox instead
  std::optional<int> level{};  ///< of the sandbox, that must hold; nothing: the best
};
/// Tries everything that pictures need on this machine. kGraderFault if something needed does not work; of
/// the two ways to OpenGL, one is needed unless `gl` names it.
ExitCode doctor(const Project& project, const DoctorOptions& options);
/// Attacks the sandbox from inside with a program of ours. kWeakSandbox unless the asked level holds.
ExitCode doctorOfSandbox(const Project& project, const DoctorOptions& options);

struct DebugOptions {
  std::string exercise;
  bool solution = false;
  bool print = false;  ///< only print the debugger's command line
};
ExitCode debug(const Project& project, const DebugOptions& options);

ExitCode devNew(const Project& project, const std::string& name);

struct CheckOptions {
  std::string exercise;  ///< empty: all
  std::string gate;      ///< empty: all
  bool listGates = false;
  int seeds = 3;
};
ExitCode devCheck(const Project& project, const CheckOptions& options);

/// Makes main.cpp of that exercise from its solution.cpp.
ExitCode devStrip(const Project& project, const std::string& name);

struct ReleaseOptions {
  std::filesystem::path out{};      ///< new folder
  std::filesystem::path scan{};     ///< only look through this tree, and write nothing
  std::filesystem::path secret{};   ///< file with the secret of the course; empty: none
  bool prove = false;               ///< see proveRelease()
  std::filesystem::path proveIn{};  ///< the same, in this folder, which stays
};
/// Writes the tree that students get, and says what it holds. kBelow, and nothing written, if anything leaks.
ExitCode devRelease(const Project& project, const ReleaseOptions& options);

struct StatsOptions {
  std::filesystem::path results{};  ///< folder that `rex grade` wrote
  std::filesystem::path figure{};   ///< .png or .svg; empty: none
  bool json = false;
  bool csv = false;
};
/// How a class did, per exercise and check. kNotGradable if some result could not be read.
ExitCode devStats(const Project& project, const StatsOptions& options);

}  // namespace rex::cli
