#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/robot/render_plan.h"

namespace rex::cli {

/// Options that several commands about a scene have in common.
void addSceneFile(CLI::App* command, const std::string& name, std::filesystem::path& file);
/// How a scene is read.
void addReading(CLI::App* command, ReadOptions& reading);
/// `--q`.
void addPosture(CLI::App* command, std::string& posture);
/// Throws UsageError without a value. Options that CLI11 itself requires hide what is wrong with the scene.
void requireGiven(const char* option, const std::string& value, const char* command);
void addJson(CLI::App* command, bool& json);
/// All that a picture can be asked for.
void addRenderOptions(CLI::App* command, RenderOptions& options);
/// The same of the film that a command writes besides.
void addFilmOptions(CLI::App* command, RenderOptions& film);
/// `--speed` of a film of a motion that has times.
void addFilmSpeed(CLI::App* command, double& speed);
void addGl(CLI::App* command, std::string& gl);

}  // namespace rex::cli
