#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "authoring/secrets.h"
#include "base/error.h"

namespace rex::authoring {

/// Text normalised for comparison with what must not leak: in lower case, without blanks, line breaks,
/// control characters and comment markers. `lines` has the line, from 1, of each letter.
struct NormalText {
  std::string letters{};
  std::vector<int> lines{};
};

enum class Comments { kKeep, kDrop };

/// Normalises a text, dropping C++ comments or only their markers. Escapes in string literals and the HTML
/// entities for < > & " are decoded.
[[nodiscard]] NormalText normalText(std::string_view text, Comments comments);

/// A file that is packed in another file.
struct PackedFile {
  std::string name{};  ///< as stored there; empty for a file that is only compressed
  std::string bytes{};
};

/// Whether these bytes begin as a zip, tar, 7z, cpio or rar archive, or as a gzip, bzip2, xz, lzip or zstd
/// file.
[[nodiscard]] bool isPacked(std::string_view bytes);

/// The packed files, in memory: at most 256 MiB, and one level deep. Throws Error "cannot look into" with
/// the reason for files that are broken, encrypted, larger, or of a kind that cannot be read.
[[nodiscard]] std::vector<PackedFile> unpack(std::string_view bytes, const std::string& file);

/// Something that students must not get but would.
struct Leak {
  SourceLocation where{};   ///< below the tree; "a.zip: b.txt" inside an archive; line 0: not text
  std::string what{};       ///< "a line of the solution"
  std::string text{};       ///< how the secret begins; empty: confidential, or the file itself is the leak
  SourceLocation origin{};  ///< of the secret; empty if the file itself is the leak
};

/// "notes.md:3: a line of the solution would reach students: found 'x = A * b;' of 01/solution.cpp:12".
[[nodiscard]] std::string toString(const Leak& leak);

struct LeakScan {
  std::vector<Leak> leaks{};  ///< by file; each secret once per file
  int files = 0;              ///< number scanned, including those in archives
  int packed = 0;             ///< archives and compressed files
  std::uintmax_t bytes = 0;   ///< unpacked
};

/// What a tree is. The files of an installed one are compared with those of the source tree by where they
/// came from. It may contain compiled files, and links that stay in it, but no sources of visible checks,
/// which a source tree needs to build graders.
enum class TreeKind { kSource, kInstalled };

/// Searches names and contents of all files of a tree for secrets, in any layout, case and comments, also
/// in nested archives and binary data. Also reports files of submission::isForLecturers(), region markers in
/// C++ files (except in share/template), git history, links, compiled files, and unreadable archives. In a
/// file src/NAME equal to LIBRARY/NAME, only the secret of the course is a leak. Limits:
/// share/doc/teaching.md. Throws Error for files that cannot be read.
[[nodiscard]] LeakScan scanForLeaks(const std::filesystem::path& tree, const std::vector<Secret>& secrets,
                                    const std::filesystem::path& library = {},
                                    TreeKind kind = TreeKind::kSource);

}  // namespace rex::authoring
