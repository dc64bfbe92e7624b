#pragma once
// Writes the pages of a course as a folder of HTML files.
#include <filesystem>
#include <string>
#include <vector>

#include "authoring/leak_scan.h"

namespace rex::authoring {

/// Whether the pages contain the lecturer's notes, which students must not get.
enum class SiteReaders { kEverybody, kLecturers };

/// An exercise of a course, with times as people read them; empty: none is said.
struct SiteExercise {
  std::string name{}, opening{}, deadline{};
  std::vector<std::string> parts{};  ///< ids of those that count; empty: all
  bool isBonus = false;              ///< its points come on top
  std::string minimum{};             ///< of its points: "40 %"; empty: none
};

/// What a course makes of its pages. Without exercises: all, and the documents for lecturers, too.
struct SitePlan {
  std::string title = "Robotics exercises";
  std::vector<SiteExercise> exercises{};  ///< the pages have these alone
  std::vector<std::string> rules{};       ///< of the total, in sentences
};

/// What the pages of a course consist of, and the result of their scan.
struct CourseSite {
  int pages = 0;                        ///< without replays
  int demonstrations = 0, playing = 0;  ///< how many of them have a replay
  int exercises = 0, drawn = 0;         ///< how many of them have a picture
  LeakScan scan{};                      ///< if it has leaks, the folder was removed
};

/// Writes to `target` static pages about the course in `root`: each exercise with its task, points and
/// contract, the demonstrations, the documents of share/doc for students and lecturers with their pictures,
/// and a search over all of them. A demonstration plays if `rex demo` has written its replay to
/// out/demonstrations. The picture of an exercise is the first one named in its README that `rex run NAME
/// --solution` has drawn. The pages need no server and no network, and print well. Finally scans them for
/// leaks like a student release. Throws UsageError if the target is not empty, and Error for files that
/// cannot be read or written.
[[nodiscard]] CourseSite writeCourseSite(const std::filesystem::path& root,
                                         const std::filesystem::path& target,
                                         const std::filesystem::path& courseSecret = {},
                                         SiteReaders readers = SiteReaders::kEverybody,
                                         const SitePlan& plan = {});

}  // namespace rex::authoring
