#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <vector>

#include "cli/robot/posture_option.h"
#include "cli/robot/render_plan.h"
#include "cli/robot/simulation.h"
#include "render/film.h"
#include "render/report.h"
#include "render/video_sink.h"
#include "scene/model.h"

namespace rex::cli {

enum class LogFormat {
  kCsv,  ///< a line of names, then a line per moment, with digits that restore the same numbers
  kNpy   ///< NumPy format 1.0: a matrix of little-endian doubles in row-major order, a row per moment
};

/// A log with the columns time, q, v, kinetic, potential and total energy, written incrementally. An
/// unfinished log leaves nothing behind, neither a file nor folders made for it. An older log is kept until
/// finish().
class MotionLog {
 public:
  /// Throws Error naming the file.
  MotionLog(const std::filesystem::path& file, LogFormat format, const Model& model);
  ~MotionLog();
  MotionLog(const MotionLog&) = delete;
  MotionLog& operator=(const MotionLog&) = delete;

  /// Throws Error naming the file, for example on a full disk.
  void add(const Moment& moment);
  /// Moves the finished file into place. Throws like add().
  void finish();

 private:
  void write(const std::string& bytes);

  std::filesystem::path file_, part_, firstNew_;
  LogFormat format_;
  std::ofstream out_;
  long columns_, rows_ = 0;
  bool isFinished_ = false;
};

/// The pictures of a motion above one level ground. Each is made on demand, because a film of a large scene
/// would not fit into memory.
class MotionPictures {
 public:
  /// Shows the postures with the indices `shown`, in this order; empty: all. `traces` are bodies whose paths
  /// over the whole motion are drawn, and every picture has the `caption`. Throws UsageError for an unknown
  /// body.
  MotionPictures(const Model& model, const Motion& motion, const std::vector<std::size_t>& shown,
                 const std::vector<std::string>& traces, std::string caption);

  [[nodiscard]] std::size_t size() const { return shown_.size(); }
  /// The time of picture i, seconds.
  [[nodiscard]] double time(std::size_t i) const { return motion_.times[shown_[i]]; }
  /// Picture i, with the traces up to its time.
  [[nodiscard]] Picture picture(std::size_t i) const;
  /// All pictures.
  [[nodiscard]] Film film() const;
  /// The bounding box of everything they show.
  [[nodiscard]] const Bounds& bounds() const { return bounds_; }
  /// What cameras show: everything, or only what moves if the scenery, such as the walls of a pen, is four
  /// times as large.
  [[nodiscard]] const Bounds& framed() const {
    constexpr double kFarLarger = 4;
    const bool isLost = !moving_.isEmpty() && bounds_.radius() > kFarLarger * moving_.radius();
    return isLost ? moving_ : bounds_;
  }

 private:
  [[nodiscard]] Picture solidsAt(std::size_t i) const;
  void includeMoving(std::size_t i);

  Model model_;
  Motion motion_;
  std::vector<std::size_t> shown_;
  std::vector<std::vector<Eigen::Vector3d>> traces_;
  std::string caption_;
  Bounds bounds_, moving_;  // of all that is shown, and of the bodies that joints move
  double ground_ = 0;
};

inline constexpr double kVideoRate = VideoOptions().rate;  ///< frames per second

/// Throws UsageError naming --no-film for a scene without a visible shape.
void requireFilmable(const Model& model);

/// Draws the pictures according to the plan into the film `out` or, without ffmpeg, into a folder of frames
/// next to it, and returns its path. A single picture becomes a walk around the scene. Nothing is created
/// until something is visible. Throws like Studio and makeFrameSink().
std::filesystem::path writeMotionFilm(const MotionPictures& pictures, const RenderPlan& plan,
                                      std::filesystem::path out);

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

/// Writes a page with a replay of the pictures, `speed` times as fast as the motion, besides what the report
/// already has. Throws Error like writeReport().
void writeReplay(Report report, const MotionPictures& pictures, const RenderPlan& plan, double speed,
                 const std::filesystem::path& page);

/// Writes STEM.mp4 (or a folder STEM of frames), the film of a motion with the replay's title and the trace
/// of `body`, and STEM.html, the replay, which is `report` with that film. Both play `speed` times as fast
/// as the motion, whose postures are speed / kVideoRate seconds apart. Returns both. Throws like
/// writeMotionFilm() and writeReport().
[[nodiscard]] std::vector<std::filesystem::path> writeFilmAndReplay(const Model& model, const Motion& motion,
                                                                    BodyId body, Report report,
                                                                    const RenderPlan& pictures,
                                                                    const std::filesystem::path& stem,
                                                                    double speed);

}  // namespace rex::cli
