#include "classroom/kept_workers.h"

#include <optional>
#include <system_error>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/private_folder.h"
#include "base/sha256.h"
#include "base/text_file.h"
#include "grading/result_file.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kWorker = "worker";
constexpr const char* kStart = "start.json";
constexpr const char* kSource = "main.cpp";
constexpr const char* kHashes = "kept_sha256";  // in start.json: hashes of the other files

Json hashesOf(const fs::path& entry) {
  Json hashes;
  for (const char* name : {kWorker, kSource, kBuildLog}) hashes[name] = sha256(readTextFile(entry / name));
  return hashes;
}

// The worker gets a second name: whoever finds a fault in the entry may remove it while the worker runs.
void takeWorker(const fs::path& kept, const fs::path& worker) {
  std::error_code otherDisk;
  fs::remove(worker);
  fs::create_hard_link(kept, worker, otherDisk);
  if (otherDisk) fs::copy_file(kept, worker);
}

// Empty if an entry is missing or has changed since it was written, as after a power cut or a disk failure.
std::optional<BuiltSubmission> take(const fs::path& kept, const SubmissionOptions& options) {
  if (!fs::exists(kept / kStart)) return {};
  try {
    const Json hashes = Json::parse(readTextFile(kept / kStart)).at(kHashes);
    const fs::path work = fs::absolute(options.workFolder);
    fs::create_directories(work);
    takeWorker(kept / kWorker, work / kWorker);
    if (hashes != hashesOf(kept) || hashes.at(kWorker) != sha256(readTextFile(work / kWorker))) return {};
    BuiltSubmission built{
        .start = loadResult(kept / kStart), .source = readTextFile(kept / kSource), .worker = work / kWorker};
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
void fill(const fs::path& entry, const BuiltSubmission& built, const fs::path& log) {
  fs::create_directory(entry);
  fs::copy_file(built.worker, entry / kWorker);
  writeTextFile(entry / kSource, built.source);
  writeTextFile(entry / kBuildLog, readTextFile(log));
  for (const char* name : {kWorker, kSource, kBuildLog}) bringToDisk(entry / name);
  Json start = Json::parse(toJson(built.start));
  start[kHashes] = hashesOf(entry);
  replaceTextFile(entry / kStart, start.dump(2) + "\n", "what is known of a program");
}

// The entry is complete and on the disk before it gets its name. If two processes build the same, one wins.
void keep(const BuiltSubmission& built, const fs::path& kept, const fs::path& log) {
  makeFolder(kept.parent_path());
  const PrivateFolder folder(kept.parent_path());
  fill(folder.path() / "entry", built, log);
  std::error_code missing, other;
  fs::rename(kept, folder.path() / "old", missing);
  fs::rename(folder.path() / "entry", kept, other);
  bringToDisk(kept.parent_path());
}

}  // namespace

BuiltSubmission buildOnce(const KeptWorkers& keeping, const Toolchain& toolchain,
                          const ExerciseInfo& exercise, const SubmissionOptions& options) {
  const fs::path kept = keeping.folder / keeping.key;
  if (!keeping.anew)
    if (auto taken = take(kept, options)) return *std::move(taken);
  BuiltSubmission built = buildSubmission(toolchain, exercise, options);
  if (built.worker.empty()) return built;
  keep(built, kept, options.job.results.parent_path() / kBuildLog);
  return built;
}

}  // namespace rex::grading
