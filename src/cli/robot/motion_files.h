#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "cli/robot/posture_option.h"
#include "cli/robot/render_plan.h"
#include "render/report.h"

namespace rex::cli {

/// What films last at most, seconds.
inline constexpr double kLongestFilm = 120;

/// How many times as fast as the motion its film is: as asked, or so much faster that it lasts no longer than
/// kLongestFilm, and a note then.
[[nodiscard]] double filmSpeed(double asked, double seconds);

/// Throws UsageError naming -o for a folder that is called like a file: out.mp4.
void requireFolderName(const std::filesystem::path& folder, const std::string& wanted);

/// Makes the folder of results, and takes away what an earlier run left there: these files, and the frames of
/// a film that was made without ffmpeg, in the folder `frames`. Throws UsageError naming -o for one that
/// is called like a file, cannot be, that cannot be written to, or where folders stand in the place of files.
void makeResultFolder(const std::filesystem::path& folder, std::initializer_list<const char*> files,
                      const std::string& frames);

/// Writes STEM.mp4 (or a folder STEM of frames), the film of a motion that has the replay's title and draws
/// the way of `body`, and STEM.html, the replay, which is `report` with that film. Both play `speed` times as
/// fast as the motion, whose postures are speed / kFilmRate seconds apart. Gives back both. Throws as
/// writeFilm() and writeReport().
[[nodiscard]] std::vector<std::filesystem::path> writeFilmAndReplay(const Model& model, const Motion& motion,
                                                                    BodyId body, Report report,
                                                                    const RenderPlan& pictures,
                                                                    const std::filesystem::path& stem,
                                                                    double speed);

}  // namespace rex::cli
