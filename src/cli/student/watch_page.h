#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "grading/results.h"

namespace rex::cli {

/// The result of `rex watch` as a page that loads itself again every two seconds: what has changed since
/// `before`, the table of checks, pictures of failed ones, links to their replays, and main.cpp. `folder`
/// holds the files that the result names.
[[nodiscard]] std::string watchPage(const grading::GradeResult& result,
                                    const std::optional<grading::GradeResult>& before,
                                    const std::string& source, const std::filesystem::path& folder);

/// Renews folder/watch.html from folder/results.json, if that is there. Throws Error if it cannot be written.
class WatchPage {
 public:
  explicit WatchPage(const std::filesystem::path& folder, const std::filesystem::path& main)
      : folder_(folder), main_(main) {}

  /// Returns whether there was a result to show.
  bool renew();
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "watch.html"; }

 private:
  std::filesystem::path folder_, main_;
  std::optional<grading::GradeResult> last_{};
};

}  // namespace rex::cli
