#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/project.h"

namespace rex::cli {

/// What handOut() did with one file of a course folder.
struct HandedOut {
  enum class Change {
    kNew,          ///< the folder did not have it
    kReplaced,     ///< it was as handed out before
    kKeptBeside,   ///< replaced; the old one, which was changed or is a contract, is kept as `kept`
    kOwnChange,    ///< not a main.cpp, changed by the student and handed out as before; it stays
    kNotTouched,   ///< a main.cpp: what is handed out changed, the student's file did not
    kRemoved,      ///< a file of the checks, which earlier versions handed out; it was as they did
    kNoLongerPart  ///< no longer handed out; the file stays
  };
  Change change{};
  std::filesystem::path file;    ///< relative to the course folder
  std::filesystem::path kept{};  ///< relative to it
};

/// Brings all that is handed out into a course folder, and records it in kCourseFile. What is there already
/// as it is handed out now is not reported. A main.cpp that exists is never changed. Throws Error if a file
/// cannot be read or written; what was done until then stays, and the next call goes on.
[[nodiscard]] std::vector<HandedOut> handOut(const std::filesystem::path& installed,
                                             const std::filesystem::path& course);

/// Throws UsageError unless this rex is installed; `command` is for the message.
void requireInstalled(const Project& project, const std::string& command);

/// Precompiles what programs include first, which takes some seconds, unless prefixFile() is current. Prints
/// a note if the compiler cannot do that: everything works without, but slower.
void prepareCompiler(const Project& project);

/// The same, and writes compile_commands.json for editors.
void prepareTools(const Project& course);

}  // namespace rex::cli
