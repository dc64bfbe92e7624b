#include "classroom/kept_workers.h"

#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/folders.h"
#include "base/sha256.h"
#include "base/text_file.h"
#include "classroom/stored_result.h"
#include "grading/results.h"

namespace rex::classroom {

using submission::SubmissionOptions;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kWorker = "worker";
constexpr const char* kStart = "start.json";
constexpr const char* kSource = "main.cpp";
// In start.json: the parts of the exercise with workers of their own, and the hashes of all other files.
constexpr const char *kParts = "kept_parts", *kHashes = "kept_sha256";

fs::path workerIn(const fs::path& folder, const std::string& part) {
  return folder / fmt::format("{}.{}", kWorker, part);
}

// Of all files but start.json itself; one that is missing is an error.
Json hashesOf(const fs::path& entry, const std::vector<std::string>& parts) {
  std::vector<fs::path> files = {entry / kWorker, entry / kSource, entry / kBuildLog};
  for (const std::string& part : parts) files.push_back(workerIn(entry, part));
  Json hashes;
  for (const fs::path& file : files) hashes[file.filename().string()] = sha256(readTextFile(file));
  return hashes;
}

// The worker gets a second name, because the entry may be removed, being faulty, while the worker runs.
void takeWorker(const fs::path& kept, const fs::path& worker) {
  std::error_code otherDisk;
  fs::remove(worker);
  fs::create_hard_link(kept, worker, otherDisk);
  if (otherDisk) fs::copy_file(kept, worker);
}

// Empty if an entry is missing or has changed since it was written, as after a power cut or a disk failure.
std::optional<submission::BuiltSubmission> take(const fs::path& kept, const SubmissionOptions& options) {
  if (!fs::exists(kept / kStart)) return {};
  try {
    const Json start = Json::parse(readTextFile(kept / kStart)), &hashes = start.at(kHashes);
    submission::BuiltSubmission built{.start = grading::loadResult(kept / kStart),
                                      .source = readTextFile(kept / kSource),
                                      .worker = {},
                                      .parts = start.at(kParts).get<std::vector<std::string>>()};
    if (hashes != hashesOf(kept, built.parts)) return {};
    const fs::path work = fs::absolute(options.workFolder);
    fs::create_directories(work);
    built.worker = work / kWorker;
    std::vector<fs::path> workers = {built.worker};
    for (const std::string& part : built.parts) workers.push_back(workerIn(work, part));
    for (const fs::path& worker : workers) {
      takeWorker(kept / worker.filename(), worker);
      if (hashes.at(worker.filename().string()) != sha256(readTextFile(worker))) return {};
    }
    writeTextFile(options.job.results.parent_path() / kBuildLog, readTextFile(kept / kBuildLog));
    return built;
  } catch (const Error&) {
    return {};
  } catch (const Json::exception&) {
    return {};
  } catch (const fs::filesystem_error&) {
    return {};
  }
}

// Accessible to its owner only, as the programs in it are run.
void makeFolder(const fs::path& folder) {
  std::error_code refused;
  if (fs::create_directories(folder, refused)) fs::permissions(folder, fs::perms::owner_all, refused);
  if (!refused && !fs::is_directory(folder)) refused = std::make_error_code(std::errc::not_a_directory);
  if (refused)
    throw Error({.what = "cannot keep programs in " + folder.string(), .found = refused.message()});
}

// The hashes come last, once the hashed files are on the disk.
void fill(const fs::path& entry, const submission::BuiltSubmission& built, const fs::path& log) {
  fs::create_directory(entry);
  fs::copy_file(built.worker, entry / kWorker);
  for (const std::string& part : built.parts)
    fs::copy_file(workerIn(built.worker.parent_path(), part), workerIn(entry, part));
  writeTextFile(entry / kSource, built.source);
  writeTextFile(entry / kBuildLog, readTextFile(log));
  Json start = Json::parse(grading::toJson(built.start));
  start[kParts] = built.parts;
  start[kHashes] = hashesOf(entry, built.parts);
  for (const auto& [name, hash] : start[kHashes].items()) bringToDisk(entry / name);
  replaceTextFile(entry / kStart, start.dump(2) + "\n", "what is known of a program");
}

// The entry is complete and on the disk before it gets its name. If two processes build the same, one wins.
void keep(const submission::BuiltSubmission& built, const fs::path& kept, const fs::path& log) {
  makeFolder(kept.parent_path());
  const PrivateFolder folder(kept.parent_path());
  fill(folder.path() / "entry", built, log);
  std::error_code missing, other;
  fs::rename(kept, folder.path() / "old", missing);
  fs::rename(folder.path() / "entry", kept, other);
  bringToDisk(kept.parent_path());
}

}  // namespace

submission::BuiltSubmission buildOnce(const KeptWorkers& keeping, const submission::Toolchain& toolchain,
                                      const submission::ExerciseInfo& exercise,
                                      const SubmissionOptions& options) {
  const fs::path kept = keeping.folder / keeping.key;
  if (!keeping.recompile)
    if (auto taken = take(kept, options)) return *std::move(taken);
  submission::BuiltSubmission built = submission::buildSubmission(toolchain, exercise, options);
  if (built.worker.empty()) return built;
  keep(built, kept, options.job.results.parent_path() / kBuildLog);
  return built;
}

}  // namespace rex::classroom
