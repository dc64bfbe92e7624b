#include "cli/student/progress_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/error.h"
#include "base/text_file.h"
#include "cli/json_internal.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "rex-progress/1";

// Keeps other programs from changing the file. If the file system has no locks, nobody waits.
class Lock {
 public:
  explicit Lock(const fs::path& file) : fd_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (fd_ >= 0) ::flock(fd_, LOCK_EX);
  }
  ~Lock() {
    if (fd_ >= 0) ::close(fd_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int fd_;
};

Progress progressOf(const Json& entry) {
  Progress progress{.tested = entry.contains("points"),
                    .points = entry.value("points", 0),
                    .maxPoints = entry.value("max_points", 0),
                    .solved = entry.value("solved", false),
                    .fileSha256 = entry.value("file_sha256", "")};
  if (entry.contains("hints")) entry.at("hints").get_to(progress.hints);
  return progress;
}

void putInto(Json& entry, const Progress& progress) {
  if (progress.tested) {
    entry["points"] = progress.points;
    entry["max_points"] = progress.maxPoints;
    entry["solved"] = progress.solved;
    entry["file_sha256"] = progress.fileSha256;
  }
  if (!progress.hints.empty()) entry["hints"] = progress.hints;
}

// Throws a Json::exception if it is not a progress file.
AllProgress allProgressOf(const Json& json) {
  AllProgress all{.last = json.value("last", "")};
  for (const auto& [name, entry] : json.at("exercises").items()) all.exercises[name] = progressOf(entry);
  return all;
}

Json emptyFile() { return {{"schema", kSchema}, {"exercises", Json::object()}}; }

bool isSound(const Json& json) {
  try {
    static_cast<void>(allProgressOf(json));
    return json.at("schema") == kSchema;
  } catch (const Json::exception&) {
    return false;
  }
}

// The broken file is kept, as somebody may still repair it.
void moveAside(const fs::path& file) {
  fs::path aside;
  for (int k = 1; k == 1 || fs::exists(aside); ++k) aside = fmt::format("{}.broken-{}", file.string(), k);
  fs::rename(file, aside);
  note(wrap(fmt::format("rex: {} cannot be understood and is now {}; progress starts from zero",
                        file.string(), aside.filename().string()),
            2, 0));
}

// Call under the lock. Throws Error if the file cannot be read at all, and leaves it in place.
Json load(const fs::path& file) {
  if (!fs::exists(file)) return emptyFile();
  Json json = Json::parse(readTextFile(file), nullptr, false);
  if (isSound(json)) return json;
  moveAside(file);
  return emptyFile();
}

void complain(const fs::path& folder, const std::exception& error) {
  note(wrap(fmt::format("rex: cannot keep progress in {}: {}", folder.string(), error.what()), 2, 0));
}

}  // namespace

AllProgress ProgressFile::read() const {
  if (!fs::exists(folder_)) return {};
  try {
    const Lock lock(folder_ / "lock");
    return allProgressOf(load(folder_ / "progress.json"));
  } catch (const std::exception& error) {
    complain(folder_, error);
    return {};
  }
}

bool ProgressFile::change(const std::string& exercise, const std::function<void(Progress&)>& edit) const {
  try {
    fs::create_directories(folder_);
    const Lock lock(folder_ / "lock");
    const fs::path file = folder_ / "progress.json";
    Json json = load(file);
    Json& entry = json["exercises"][exercise];
    if (entry.is_null()) entry = Json::object();
    Progress progress = progressOf(entry);
    edit(progress);
    putInto(entry, progress);
    if (progress.tested) json["last"] = exercise;
    replaceTextFile(file, json.dump(2) + "\n", "the progress");
    return true;
  } catch (const std::exception& error) {
    complain(folder_, error);
    return false;
  }
}

}  // namespace rex::cli
