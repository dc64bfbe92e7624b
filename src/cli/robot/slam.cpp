#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/text_file.h"
#include "cli/command_table.h"
#include "cli/numbers.h"
#include "cli/option_table_internal.h"
#include "cli/project.h"
#include "cli/results_internal.h"
#include "cli/terminal.h"
#include "estimation/g2o_file.h"
#include "estimation/pose_graph.h"
#include "render/figure.h"

namespace rex::cli {
namespace {

enum class Start { kChordal, kFile, kOdometry };

struct SlamOptions {
  std::filesystem::path file{};  ///< if it does not exist, looked up below the project's root
  Start start = Start::kChordal;
  PoseGraphOptions how{};
  bool json = false;
  std::filesystem::path out{};   ///< a .g2o file; empty: none
  std::filesystem::path plot{};  ///< a .png or .svg file; empty: none
};

// Positions seen from above, as a figure shows them.
Eigen::Matrix2Xd positionsOf(const PlanarPoseGraph& graph) { return graph.poses.topRows<2>(); }
Eigen::Matrix2Xd positionsOf(const SpatialPoseGraph& graph) {
  Eigen::Matrix2Xd positions(2, static_cast<Eigen::Index>(graph.poses.size()));
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    positions.col(static_cast<Eigen::Index>(i)) = graph.poses[i].p.head<2>();
  return positions;
}

// What the figure and the summary show besides the poses.
Eigen::Matrix2Xd landmarksOf(const PlanarPoseGraph& graph) { return graph.landmarks; }
Eigen::Matrix2Xd landmarksOf(const SpatialPoseGraph&) { return Eigen::Matrix2Xd(2, 0); }
std::size_t sightingsOf(const PlanarPoseGraph& graph) { return graph.sightings.size(); }
std::size_t sightingsOf(const SpatialPoseGraph&) { return 0; }

void writePlot(const SlamOptions& options, const Eigen::Matrix2Xd& before, const Eigen::Matrix2Xd& after,
               const Eigen::Matrix2Xd& landmarks) {
  Figure figure = planeFigure(
      {.title = fmt::format("{}: before and after", options.file.filename().string()),
       .legend = Legend::kOutside,
       .series = {through(before, {.label = "before", .dashed = true}), through(after, {.label = "after"})},
       .width = 900,
       .height = 700});
  if (landmarks.cols() > 0)
    figure.series.push_back(through(landmarks, {.label = "landmarks", .style = SeriesStyle::kPoints}));
  writeFigure(figure, options.plot);
}

const char* toString(PoseGraphStatus status) {
  switch (status) {
    case PoseGraphStatus::kConverged:
      return "converged";
    case PoseGraphStatus::kBudgetSpent:
      return "budget spent";
    case PoseGraphStatus::kNoProgress:
      return "no progress";
  }
  return "";
}

// "400 poses, 438 edges"; with landmarks "400 poses, 12 landmarks, 438 edges, 90 sightings".
template <class Graph>
std::string sizeOf(const Graph& graph, std::size_t poses) {
  const auto counted = [](std::size_t count, const char* thing) {
    return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
  };
  const auto landmarks = static_cast<std::size_t>(landmarksOf(graph).cols());
  const std::string edges = counted(graph.edges.size(), "edge");
  if (landmarks == 0) return fmt::format("{}, {}", counted(poses, "pose"), edges);
  return fmt::format("{}, {}, {}, {}", counted(poses, "pose"), counted(landmarks, "landmark"), edges,
                     counted(sightingsOf(graph), "sighting"));
}

// Makes the map of a pose graph fit its measurements. kBelow if it does not converge.
template <class Graph>
ExitCode slam(const SlamOptions& options, G2oFile& file, Graph& graph) {
  PoseGraphOptions how = options.how;
  how.chordalStart = options.start == Start::kChordal;
  if (options.start == Start::kOdometry) asWrongUse([&] { return setOdometryPoses(graph), 0; });
  const Eigen::Matrix2Xd before = positionsOf(graph);
  const std::clock_t begin = std::clock();
  const PoseGraphResult result = asWrongUse([&] { return optimize(graph, how); });
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  Results all{.json = {{"poses", file.ids.size()},
                       {"edges", graph.edges.size()},
                       {"landmarks", landmarksOf(graph).cols()},
                       {"sightings", sightingsOf(graph)},
                       {"initial_cost", result.initialCost},
                       {"cost", result.cost},
                       {"iterations", result.iterations},
                       {"seconds", seconds},
                       {"status", toString(result.status)}}};
  all.line("{}; {}", sizeOf(graph, file.ids.size()), result.message);
  all.line("{:.3f} s of processor time", seconds);
  if (!options.plot.empty()) writePlot(options, before, positionsOf(graph), landmarksOf(graph));
  if (!options.out.empty()) writeTextFile(options.out, writeG2o(file));
  for (const std::filesystem::path& written : {options.plot, options.out})
    if (!written.empty()) all.line("wrote {}", written.string());
  all.print(options.json);
  return result.status == PoseGraphStatus::kConverged ? ExitCode::kFull : ExitCode::kBelow;
}

}  // namespace

ExitCode slam(const Project& project, const SlamOptions& options) {
  if (!options.plot.empty() && options.plot.extension() != ".png" && options.plot.extension() != ".svg")
    throw UsageError({.what = "--plot",
                      .found = "'" + escapeForTerminal(options.plot.string()) + "'",
                      .wanted = "a .png or .svg file"});
  const bool isExample =
      !std::filesystem::exists(options.file) && std::filesystem::exists(project.files() / options.file);
  G2oFile file =
      asWrongUse([&] { return readG2o(isExample ? project.files() / options.file : options.file); });
  for (const Diagnostic& one : file.notes) note(escapeForTerminal(toString(one)));
  return std::visit([&](auto& graph) { return slam(options, file, graph); }, file.graph);
}

void addSlam(CLI::App* command, Action& action) {
  const auto options = std::make_shared<SlamOptions>();
  command->footer(
      "Examples:\n  scripts/rex slam data/graphs/streets.g2o --plot streets.png\n"
      "  scripts/rex slam data/graphs/streets.g2o -o better.g2o --json\n\n"
      "The file is in g2o format: poses, landmarks (VERTEX_XY) and edges. The cost is the sum of\n"
      "e^T information e over the edges, without a factor 1/2; --objective sesync takes distances\n"
      "of rotation matrices instead.\n"
      "Exit code 1: the optimisation did not converge.");
  command->add_option("file", options->file, "pose graph (.g2o)")->type_name("FILE")->required();
  using enum RobustKernel;
  PoseGraphOptions& how = options->how;
  addOptions(
      command,
      {{"--objective",
        how.objective,
        {{"chi2", PoseGraphObjective::kChi2}, {"sesync", PoseGraphObjective::kSESync}},
        "what is minimised"},
       {"--start",
        options->start,
        {{"chordal", Start::kChordal}, {"file", Start::kFile}, {"odometry", Start::kOdometry}},
        "poses to start from"},
       {"--kernel",
        how.kernel,
        {{"none", kNone}, {"huber", kHuber}, {"cauchy", kCauchy}, {"geman-mcclure", kGemanMcClure}},
        "robust kernel"},
       {"--kernel-size", how.kernelSize, {1e-6, 1e6}, "X", "width of the kernel in standard deviations"},
       {"--iterations", how.maxIterations, {0, 100'000}, "N", "limit of iterations"},
       {"--plot", options->plot, "FILE.png", "draw the poses before and after"},
       {"-o,--out", options->out, "FILE.g2o", "write the graph with its new poses"},
       {"--json", options->json, "print JSON"}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return slam(p, *options); }; });
}

}  // namespace rex::cli
