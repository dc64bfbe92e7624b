#include "cli/instructor/release_proof.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/join.h"
#include "base/private_folder.h"
#include "base/process.h"
#include "cli/out_folder.h"
#include "cli/progress_line.h"
#include "cli/result_list.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

/// Builds and tries one copy of a release.
class Proof {
 public:
  explicit Proof(const fs::path& tree) : tree_(tree) {}

  void build() {
    if (fs::exists(tree_ / "scripts/check-links")) run({"scripts/check-links"}, 0);
    run({"cmake", "--preset", "release"}, 0);
    run({"cmake", "--build", "build/release", "--target", "rex"}, 0);
    run({kRex, "list"}, 0);
  }

  void tryExercise(const std::string& name) {
    run({kRex, "test", name}, 1);
    run({"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", kRex, "run", name}, 0);
    if (filesIn(tree_ / "out" / name, ".png").empty())
      throw Error({.what = fmt::format("the release: {} drew no picture", name)});
  }

  std::string step() const {
    const std::lock_guard lock(mutex_);
    return step_;
  }

 private:
  static constexpr const char* kRex = "build/release/rex";

  void run(const std::vector<std::string>& command, int wanted) {
    constexpr double kLongest = 3 * 3600;
    constexpr std::size_t kShown = 1500;
    const std::string text = join(command, " ");
    {
      const std::lock_guard lock(mutex_);
      step_ = text;
    }
    const ProcessResult run = runProcess(command, {.directory = tree_, .timeout = kLongest});
    if (run.exitCode == wanted) return;
    const std::string said = run.output + run.error;
    note(harmless(said.substr(said.size() - std::min(said.size(), kShown))));
    throw Error({.what = "the release does not work on its own: " + text,
                 .found = run.started ? fmt::format("exit code {}", run.exitCode) : run.error,
                 .wanted = fmt::format("{}", wanted)});
  }

  fs::path tree_;
  mutable std::mutex mutex_;
  std::string step_;
};

}  // namespace

void proveRelease(const fs::path& release, const fs::path& in) {
  std::optional<PrivateFolder> folder;
  if (in.empty()) folder.emplace(temporaryFolder());
  const fs::path tree = folder ? folder->path() / "student release" : in;
  fs::copy(release, tree, fs::copy_options::recursive);
  Proof proof(tree);
  const ProgressLine line([&] { return proof.step(); });
  proof.build();
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(tree / "exercises"))
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) proof.tryExercise(name);
}

}  // namespace rex::cli
