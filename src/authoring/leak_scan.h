#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "authoring/secrets.h"
#include "base/error.h"

namespace rex::grading {

/// Something that students would get and must not.
struct Leak {
  SourceLocation where{};   ///< below the tree; "a.zip: b.txt" inside of an archive; line 0: no text
  std::string what{};       ///< "a line of the solution"
  std::string text{};       ///< how the secret begins; empty: not to be told, or the file itself is the leak
  SourceLocation origin{};  ///< of the secret; empty where the file itself is the leak
};

/// "notes.md:3: a line of the solution would reach students: found 'x = A * b;' of 01/solution.cpp:12".
[[nodiscard]] std::string toString(const Leak& leak);

struct LeakScan {
  std::vector<Leak> leaks{};  ///< by file; of each file a secret once
  int files = 0;              ///< looked through, those in archives among them
  int packed = 0;             ///< archives and compressed files
  std::uintmax_t bytes = 0;   ///< unpacked
};

/// Looks for the secrets in names and contents of all files of a tree: text in any layout, case and comments,
/// also in archives inside of archives, object files and other bytes. Besides refuses solution.cpp, wrong/,
/// marks of regions in C++ files (but in share/template), a history of git, links, compiled files, archives
/// that cannot be opened. A file src/NAME with the bytes of LIBRARY/NAME may hold all but the secret of the
/// course. What this cannot see: share/doc/writing-an-exercise.md. Throws Error for what cannot be read.
[[nodiscard]] LeakScan scanForLeaks(const std::filesystem::path& tree, const std::vector<Secret>& secrets,
                                    const std::filesystem::path& library = {});

}  // namespace rex::grading
