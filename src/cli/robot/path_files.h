#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/robot/path_search.h"
#include "cli/robot/path_timing.h"
#include "cli/robot/plan.h"
#include "cli/robot/render_plan.h"
#include "render/picture.h"

namespace rex::cli {

/// "scene, planner, seed 3", without control characters.
[[nodiscard]] std::string titleOf(const PathTask& task, const PlanOptions& options, const FoundPath& found);

/// Draws what a search explored, with a caption, into a .png file. Throws Error if nothing is to be seen.
void writeExplored(Picture picture, RenderPlan plan, std::string caption, const std::filesystem::path& out);

/// Writes into options.out what a search explored, and the motion along the path found as a table, a film
/// and a page with a replay. Pictures show the traces of `body` and are drawn according to `pictures`.
/// Returns the files, as a user would type them. Throws Error like the functions that write them.
[[nodiscard]] std::vector<std::string> writePathFiles(const PathTask& task, const PlanOptions& options,
                                                      const RenderPlan& pictures, BodyId body,
                                                      const FoundPath& found, const PathTiming& timing);

}  // namespace rex::cli
