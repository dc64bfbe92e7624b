#include "grading/kept_workers.h"

#include <system_error>

#include "base/error.h"
#include "grading/private_folder.h"
#include "grading/result_file.h"
#include "grading/text_file.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWorker = "worker";
constexpr const char* kStart = "start.json";
constexpr const char* kSource = "main.cpp";
constexpr const char* kLog = "build.log";

BuiltSubmission take(const fs::path& kept, const SubmissionOptions& options) {
  fs::create_directories(options.workFolder);
  writeTextFile(options.results.parent_path() / kLog, readTextFile(kept / kLog));
  return {.start = loadResult(kept / kStart),
          .source = readTextFile(kept / kSource),
          .worker = fs::absolute(kept / kWorker)};
}

// For its owner alone: what lies in it is run.
void makeFolder(const fs::path& folder) {
  std::error_code refused;
  if (fs::create_directories(folder, refused)) fs::permissions(folder, fs::perms::owner_all, refused);
  if (!refused && !fs::is_directory(folder)) refused = std::make_error_code(std::errc::not_a_directory);
  if (refused)
    throw Error({.what = "cannot keep programs in " + folder.string(), .found = refused.message()});
}

// Complete before it has its name. Where two build the same at once, one of them wins.
void keep(const BuiltSubmission& built, const fs::path& kept, const fs::path& log) {
  makeFolder(kept.parent_path());
  const PrivateFolder folder(kept.parent_path());
  const fs::path entry = folder.path() / "entry";
  fs::create_directory(entry);
  fs::copy_file(built.worker, entry / kWorker);
  saveResult(built.start, entry / kStart);
  writeTextFile(entry / kSource, built.source);
  writeTextFile(entry / kLog, readTextFile(log));
  std::error_code other;
  fs::rename(entry, kept, other);
}

}  // namespace

BuiltSubmission buildOnce(const fs::path& folder, const std::string& key, const Toolchain& toolchain,
                          const ExerciseInfo& exercise, const SubmissionOptions& options) {
  const fs::path kept = folder / key;
  if (fs::exists(kept / kStart)) return take(kept, options);
  BuiltSubmission built = buildSubmission(toolchain, exercise, options);
  if (built.worker.empty()) return built;
  keep(built, kept, options.results.parent_path() / kLog);
  return built;
}

}  // namespace rex::grading
