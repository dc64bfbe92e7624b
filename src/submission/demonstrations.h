#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace rex::submission {

/// A program of share/demonstrations. Its first comment has what lists and pages say about it, each in one
/// or several lines:
///   // Chapter 3: PID control. What it shows.
///   // Slides: 3:15 to 3:17
///   // Formula: u = Kp (q* - q) - Kd q'
///   // Try: Set "load" to zero.
struct Demonstration {
  std::string name{};   ///< of its file, without .cpp
  int chapter = 0;      ///< of the course script
  std::string title{};  ///< "PID control"
  std::string about{};  ///< "What it shows."
  std::string slides{}, formula{}, toTry{};
  std::filesystem::path file{};
  /// Whether its random numbers have a seed, argv[1], and it counts runs with one seed after the other,
  /// argv[2].
  bool takesSeed = false, takesRuns = false;
};

/// Those of a folder, by chapter and name. Throws Error with file:line for a first comment of another form.
[[nodiscard]] std::vector<Demonstration> demonstrations(const std::filesystem::path& folder);

/// Name and text of what a page says about it, in order.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> demonstrationFacts(const Demonstration& one);

/// All of them as a page in Markdown, a table for each chapter. `linkTo` gives the page that a title leads
/// to; empty: none.
[[nodiscard]] std::string demonstrationsPage(const std::vector<Demonstration>& all,
                                             const std::function<std::string(const Demonstration&)>& linkTo);

}  // namespace rex::submission
