#include "cli/student/course_folder.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/sha256.h"
#include "base/text.h"
#include "base/text_file.h"
#include "cli/terminal.h"
#include "reports/markdown.h"
#include "submission/program_build.h"
#include "submission/student_files.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;
using Change = HandedOut::Change;

void addFilesIn(const fs::path& folder, const fs::path& below, std::map<fs::path, fs::path>& files) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path name = below / entry.path().filename();
    if (entry.is_directory())
      addFilesIn(entry.path(), name, files);
    else if (entry.is_regular_file())
      files[name] = entry.path();
  }
}

// The files of a course folder, and where each comes from.
std::map<fs::path, fs::path> handedOutFiles(const fs::path& installed) {
  std::map<fs::path, fs::path> files;
  addFilesIn(installed / "share" / "course", "", files);
  for (const auto& exercise : fs::directory_iterator(installed / "exercises")) {
    if (!fs::exists(exercise.path() / "exercise.toml")) continue;
    for (const fs::path& name : submission::studentFiles(exercise.path()))
      if (name != "starter.cpp")
        files["exercises" / exercise.path().filename() / name] = exercise.path() / name;
  }
  return files;
}

/// The hash of each file when it was handed out, and the version of rex that did it last.
struct Record {
  std::string version = REX_VERSION;
  std::map<fs::path, std::string> hashes{};
};

Record readRecord(const fs::path& course) {
  const fs::path file = course / kCourseFile;
  Record record;
  if (!fs::exists(file)) return record;
  try {
    const nlohmann::json json = nlohmann::json::parse(readTextFile(file));
    record.version = json.at("version").get<std::string>();
    for (const auto& [name, hash] : json.at("files").items()) record.hashes[name] = hash.get<std::string>();
  } catch (const nlohmann::json::exception& error) {
    throw Error({.what = "cannot read what was handed out",
                 .where = {file.string()},
                 .found = error.what(),
                 .wanted = "this file as `rex init` wrote it; without it, every file counts as changed"});
  }
  return record;
}

void writeRecord(const fs::path& course, const Record& record) {
  nlohmann::json files = nlohmann::json::object();
  for (const auto& [name, hash] : record.hashes) files[name.generic_string()] = hash;
  const nlohmann::json json = {{"version", REX_VERSION}, {"files", files}};
  fs::create_directories((course / kCourseFile).parent_path());
  replaceTextFile(course / kCourseFile, json.dump(2) + "\n", "the record of what was handed out");
}

// "exercise-0.2.0.h" and, if that exists, "exercise-0.2.0-2.h".
fs::path unusedName(const fs::path& course, const fs::path& file, const std::string& version) {
  for (int k = 1;; ++k) {
    const std::string number = k == 1 ? "" : fmt::format("-{}", k);
    fs::path name = file;
    name.replace_filename(
        fmt::format("{}-{}{}{}", file.stem().string(), version, number, file.extension().string()));
    if (!fs::exists(fs::symlink_status(course / name))) return name;
  }
}

/// Brings one file into a course folder.
class Update {
 public:
  Update(fs::path course, Record before) : course_(std::move(course)), before_(std::move(before)) {}

  void bring(const fs::path& name, const fs::path& source) {
    std::string text = readTextFile(source);
    if (name.extension() == ".md") text = reports::forInstalledRex(std::move(text));
    const std::string hash = sha256(text);
    const auto known = before_.hashes.find(name);
    const bool changed = known == before_.hashes.end() || known->second != hash;
    const fs::path file = course_ / name;
    now_.hashes[name] = hash;
    if (!fs::exists(file)) return write(Change::kNew, name, text);
    if (name.filename() == "main.cpp") {
      if (changed && readTextFile(file) != text) done_.push_back({Change::kNotTouched, name});
      return;
    }
    const std::string old = readTextFile(file);
    if (old == text) return;
    const bool isContract = name.extension() == ".h";
    if (known != before_.hashes.end() && known->second == sha256(old) && !isContract)
      return write(Change::kReplaced, name, text);
    if (!changed) {
      done_.push_back({Change::kOwnChange, name});
      return;
    }
    const fs::path kept = unusedName(course_, name, before_.version);
    replaceTextFile(course_ / kept, old, "the file to keep");
    write(Change::kKeptBeside, name, text, kept);
  }

  std::vector<HandedOut> finish() {
    for (const auto& [name, hash] : before_.hashes) {
      if (now_.hashes.contains(name) || !fs::exists(course_ / name)) continue;
      // What rex once handed out with the checks of an exercise.
      const bool isOfChecks = (name.extension() == ".h" || name.filename() == "check.cpp") &&
                              now_.hashes.contains(name.parent_path() / "exercise.h");
      const bool isLeftOver = isOfChecks && sha256(readTextFile(course_ / name)) == hash;
      if (isLeftOver) fs::remove(course_ / name);
      done_.push_back({isLeftOver ? Change::kRemoved : Change::kNoLongerPart, name});
    }
    writeRecord(course_, now_);
    return std::move(done_);
  }

 private:
  void write(Change change, const fs::path& name, const std::string& text, const fs::path& kept = {}) {
    fs::create_directories((course_ / name).parent_path());
    replaceTextFile(course_ / name, text, name.string());
    done_.push_back({change, name, kept});
  }

  fs::path course_;
  Record before_, now_{};
  std::vector<HandedOut> done_{};
};

void writeCompileCommands(const Project& project) {
  nlohmann::json commands = nlohmann::json::array();
  for (const ExerciseInfo& exercise : project.exercises()) {
    if (!project.isBuilt(exercise.name)) {
      note(wrap(fmt::format("{} is not built in this rex: it can be read, not run or graded", exercise.name),
                2, 0));
      continue;
    }
    const submission::Toolchain toolchain =
        submission::readToolchain(project.buildFolder(exercise) / "build.json");
    const fs::path folder = project.root / "exercises" / exercise.name;
    for (const char* name : {"main.cpp", "show.cpp"}) {
      if (!fs::exists(folder / name)) continue;
      std::vector<std::string> words = {toolchain.compiler};
      words.insert(words.end(), toolchain.flags.begin(), toolchain.flags.end());
      words.insert(words.end(), {"-c", (folder / name).string()});
      commands.push_back(
          {{"directory", folder.string()}, {"file", (folder / name).string()}, {"arguments", words}});
    }
  }
  replaceTextFile(project.root / "compile_commands.json", commands.dump(1) + "\n", "compile_commands.json");
}

}  // namespace

std::vector<HandedOut> handOut(const fs::path& installed, const fs::path& course) {
  try {
    Update update(course, readRecord(course));
    for (const auto& [name, source] : handedOutFiles(installed)) update.bring(name, source);
    return update.finish();
  } catch (const fs::filesystem_error& error) {
    throw Error({.what = "cannot fill the course folder",
                 .where = {(error.path1().empty() ? course : error.path1()).string()},
                 .found = error.code().message()});
  }
}

void requireInstalled(const Project& project, const std::string& command) {
  if (!project.installed.empty()) return;
  throw UsageError(
      {.what = fmt::format("rex {} makes course folders from an installed rex", command),
       .where = {project.root.string()},
       .found = "a source tree",
       .wanted = fmt::format("`{}/exercises` to work in, or a rex that was installed", shown(project.root))});
}

void prepareCompiler(const Project& project) {
  try {
    const ProgressLine line([] { return std::string("preparing the compiler, once"); });
    submission::makePrefix(
        prefixFile(project),
        submission::readProgramToolchain(project.build / "student" / "program.json").toolchain);
  } catch (const Error& error) {
    note(wrap(fmt::format("Compiling will take longer: {}", error.what()), 2, 0));
  }
}

void prepareTools(const Project& course) {
  writeCompileCommands(course);
  std::error_code ignored;
  for (const char* ending : {"", ".gch", ".d", ".gch.made-from"})  // of 0.3.0, in each folder
    fs::remove(course.root / (std::string(".rex/prefix.h") + ending), ignored);
  prepareCompiler(course);
}

}  // namespace rex::cli
