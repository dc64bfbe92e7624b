#include "cli/temporary_folder.h"

#include <cstdlib>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/terminal.h"

namespace rex::cli {

namespace fs = std::filesystem;

fs::path temporaryFolder() {
  std::error_code problem;
  const fs::path folder = fs::temp_directory_path(problem);
  if (!problem) return folder;
  const char* chosen = std::getenv("TMPDIR");
  throw Error({.what = "TMPDIR, where temporary files go",
               .found = fmt::format("'{}'", harmless(chosen == nullptr ? "/tmp" : chosen)),
               .wanted = "a folder"});
}

}  // namespace rex::cli
