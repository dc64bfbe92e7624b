#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "cli/robot/posture_option.h"
#include "cli/robot/render_plan.h"
#include "render/report.h"

namespace rex::cli {

/// The longest duration of a film, seconds.
inline constexpr double kLongestFilm = 120;

/// The speed of a film relative to its motion: as requested, or so much faster, with a note, that it takes
/// no longer than kLongestFilm.
[[nodiscard]] double filmSpeed(double asked, double seconds);

/// Throws UsageError naming -o if the folder is named like a file: out.mp4.
void requireFolderName(const std::filesystem::path& folder, const std::string& wanted);

/// Makes the folder of results, and removes what an earlier run left there: these files, and the frames of
/// a film made without ffmpeg, in the folder `frames`. Throws UsageError naming -o if it is named like a
/// file, cannot be made or written to, or has folders where files should be.
void makeResultFolder(const std::filesystem::path& folder, std::initializer_list<const char*> files,
                      const std::string& frames);

/// Writes STEM.mp4 (or a folder STEM of frames), the film of a motion with the replay's title and the trace
/// of `body`, and STEM.html, the replay, which is `report` with that film. Both play `speed` times as fast
/// as the motion, whose postures are speed / kFilmRate seconds apart. Returns both. Throws like writeFilm()
/// and writeReport().
[[nodiscard]] std::vector<std::filesystem::path> writeFilmAndReplay(const Model& model, const Motion& motion,
                                                                    BodyId body, Report report,
                                                                    const RenderPlan& pictures,
                                                                    const std::filesystem::path& stem,
                                                                    double speed);

}  // namespace rex::cli
