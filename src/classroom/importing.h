#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "classroom/download.h"
#include "classroom/import_table.h"
#include "classroom/student_files.h"

namespace rex::classroom {

/// What an import did.
struct ImportReport {
  std::vector<std::string> changes{};           ///< files that differ from those of an earlier import
  std::vector<std::string> complaints{};        ///< what was not taken, with its place and why
  std::vector<std::string> doubts{};            ///< what was taken and should be looked at
  std::vector<std::string> notes{};             ///< other things that were found
  int added = 0, changed = 0, same = 0;         ///< files
  int handedIn = 0, missing = 0, rejected = 0;  ///< students, members of groups each, per exercise
  int timesOfPlatform = 0, timesOfGit = 0, timesOfFiles = 0, withoutTime = 0;
};

/// Writes HANDED_IN/STUDENT/EXERCISE/main.cpp for what was downloaded, and HANDED_IN/import.json, which an
/// earlier import may have begun. A file that is not as an import wrote it is never replaced, and nothing is
/// removed but the file of a student who has become a member of a group that another one hands in for.
/// Students keep the name they have in the table; new ones get the first of these that is known, free and can
/// be the name of a folder: id, e-mail, GitHub name, name, name with the platform's number. If the process is
/// killed, the same import goes on and ends with the same files. Throws Error if something cannot be written,
/// and like readImportTable().
[[nodiscard]] ImportReport importSubmissions(const DownloadedSubmissions& submissions,
                                             const PickOptions& options,
                                             const std::filesystem::path& handedIn);

}  // namespace rex::classroom
