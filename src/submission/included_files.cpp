#include "submission/included_files.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <compare>
#include <cstring>
#include <optional>
#include <set>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/error.h"
#include "submission/build_tools.h"
#include "submission/cpp_names.h"
#include "submission/cpp_text.h"

namespace rex::submission {

using grading::CompileDiagnostic;

namespace {

constexpr std::string_view kDirectiveBlanks = " \t\v\f\r";
constexpr std::size_t kMostMarkers = 100;

/// Searches a source whose lines have been joined at backslashes.
class MarkerSearch {
 public:
  MarkerSearch(std::string_view text, bool knowsComments) : text_(text), knowsComments_(knowsComments) {
    skipBlanksAndComments();
  }

  // The position of the '#' of each marker.
  std::vector<std::size_t> find() const {
    std::vector<std::size_t> found;
    for (std::size_t at = 0; at < text_.size() && found.size() < kMostMarkers;) {
      if (knowsComments_) at = behind_[at];
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      bool isFirst = true;  // only blanks are before it, or a comment could be
      for (std::size_t sign = at; sign < end; ++sign) {
        if (isFirst && isDirective(sign)) found.push_back(sign);
        const bool isBlank = kDirectiveBlanks.find(text_[sign]) != kDirectiveBlanks.npos;
        isFirst = (isFirst && isBlank) || (sign > at && text_.substr(sign - 1, 2) == "*/");
      }
      at = end + 1;
    }
    return found;
  }

 private:
  // Finds where the blanks and comments that begin at each position end; comments may span lines. If the line
  // is inside a comment that began on another one, "/*/" ends that comment. So whatever is skipped is indeed
  // a comment, though perhaps not all of it.
  void skipBlanksAndComments() {
    const std::size_t size = text_.size();
    behind_.assign(size + 3, size);
    std::size_t close = size;  // the next "*/" after this position
    for (std::size_t at = size; at-- > 0;) {
      if (kDirectiveBlanks.find(text_[at]) != kDirectiveBlanks.npos)
        behind_[at] = behind_[at + 1];
      else
        behind_[at] = text_.substr(at, 2) == "/*" ? behind_[close + 2] : at;
      if (text_.substr(at, 2) == "*/") close = at;
    }
  }

  bool isDirective(std::size_t sign) const {
    const bool isHash = text_[sign] == '#',
               isDigraph = text_.substr(sign, 2) == "%:", isTrigraph = text_.substr(sign, 3) == "?\?=";
    if (!isHash && !isDigraph && !isTrigraph) return false;
    const std::size_t at = behind_[sign + (isHash ? 1 : isDigraph ? 2 : 3)];
    const bool isNumber = at < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at])) != 0;
    const bool isLine = at < text_.size() && text_.substr(at, 4) == "line" &&
                        (at + 4 >= text_.size() || !isWord(text_[at + 4]));
    return isNumber || isLine;
  }

  std::string_view text_;
  bool knowsComments_;
  std::vector<std::size_t> behind_{};
};

}  // namespace

std::vector<CompileDiagnostic> lineMarkers(std::string_view source, const std::string& mainFile) {
  if (source.starts_with("\xEF\xBB\xBF")) source.remove_prefix(3);
  const auto [text, places] = spliced(source);
  std::vector<std::size_t> found = MarkerSearch(text, text.find("R\"") == text.npos).find();
  constexpr std::string_view kPragma = "system_header";
  for (std::size_t at = text.find(kPragma); at != text.npos && found.size() < 2 * kMostMarkers;
       at = text.find(kPragma, at + 1))
    found.push_back(at);
  std::sort(found.begin(), found.end());
  const TextPlaces lines(source);
  std::vector<CompileDiagnostic> messages;
  for (const std::size_t at : found) {
    const auto [line, column] = lines.place(places[at]);
    messages.push_back({mainFile, line, column, "error", "line-marker",
                        text[at] == 's'
                            ? "found the pragma system_header, wanted code that the compiler warns about"
                            : "found a #line directive, wanted the real line numbers of the file"});
  }
  return messages;
}

namespace {

namespace fs = std::filesystem;

int lineOf(std::string_view name, std::string_view source) {
  const std::size_t at = source.find(name);
  return at == source.npos ? 0 : TextPlaces(source).line(at);
}

// Identifies a file or folder independently of its names.
struct FileIdentity {
  dev_t device = 0;
  ino_t inode = 0;
  auto operator<=>(const FileIdentity&) const = default;
};

FileIdentity identityOf(const struct stat& status) { return {status.st_dev, status.st_ino}; }

/// A file that was found: its identity and its path with all links resolved.
struct FoundFile {
  FileIdentity identity;
  fs::path place;
};

// Empty if there is no such file. Magic links of /proc are refused: they lead elsewhere in each process.
std::optional<FoundFile> findFile(const fs::path& path) {
  open_how how{};
  how.flags = O_PATH | O_CLOEXEC;
  how.resolve = RESOLVE_NO_MAGICLINKS;
  const int fd = static_cast<int>(::syscall(SYS_openat2, AT_FDCWD, path.c_str(), &how, sizeof how));
  if (fd < 0 && (errno == ENOSYS || errno == EPERM))
    throw Error({.what = "cannot check included files",
                 .found = std::string("openat2: ") + std::strerror(errno),
                 .wanted = "Linux 5.6 or later, and a container that allows this call"});
  if (fd < 0) return {};
  struct stat status {};
  std::error_code failure;
  const bool isKnown = ::fstat(fd, &status) == 0;
  const fs::path place = fs::read_symlink("/proc/self/fd/" + std::to_string(fd), failure);
  ::close(fd);
  if (!isKnown || failure || !place.is_absolute()) return {};
  return FoundFile{identityOf(status), place};
}

// Headers of Eigen have no extension.
bool isPublicHeader(const fs::path& file) {
  const std::string name = file.filename().string(), ending = file.extension().string();
  return (ending.empty() || ending == ".h" || ending == ".hpp") && !name.ends_with("_internal.h");
}

/// The files that may be included, by identity.
class Allowed {
 public:
  Allowed(const std::string& mainFile, const fs::path& folder, const Toolchain& toolchain) {
    add(folder / mainFile);
    if (!toolchain.prefix.empty()) add(toolchain.prefix), add(toolchain.prefix.string() + ".gch");
    for (std::size_t k = 1; k < toolchain.flags.size(); ++k) {
      if (toolchain.flags[k - 1] == "-include") add(toolchain.flags[k]);  // ours: options of the sanitizers
      if (toolchain.flags[k - 1] == "-isystem") addFolder(libraries_, toolchain.flags[k]);
      if (toolchain.flags[k - 1] == "-iquote")
        for (const fs::path& header : studentHeaders(toolchain.flags[k])) add(header);
    }
    for (const char* place : {"/usr/include", "/usr/local/include", "/usr/lib"}) addFolder(system_, place);
    // A separately installed compiler, such as /opt/gcc/bin/g++, brings its own headers.
    const fs::path home = fs::path(toolchain.compiler).parent_path().parent_path();
    if (toolchain.compiler.starts_with('/') && home != "/")
      for (const char* place : {"include", "lib", "lib64"}) addFolder(system_, home / place);
  }

  bool holds(const fs::path& file) const {
    const std::optional<FoundFile> found = findFile(file);
    if (!found) return false;
    if (files_.contains(found->identity)) return true;
    // A library may lie below the folders of the system's headers, but not the other way round. The file has
    // two names: the one by which it was included, and its own.
    const std::set<FileIdentity> folders = foldersAbove(found->place);
    if (isBelow(libraries_, folders)) return isPublicHeader(file) && isPublicHeader(found->place);
    return isBelow(system_, folders);
  }

 private:
  void add(const fs::path& file) {
    if (const auto found = findFile(file)) files_.insert(found->identity);
  }
  static void addFolder(std::set<FileIdentity>& folders, const fs::path& folder) {
    if (const auto found = findFile(folder)) folders.insert(found->identity);
  }
  static std::set<FileIdentity> foldersAbove(fs::path place) {
    std::set<FileIdentity> folders;
    while (place != place.root_path()) {
      place = place.parent_path();
      struct stat status {};
      if (::lstat(place.c_str(), &status) == 0) folders.insert(identityOf(status));
    }
    return folders;
  }
  static bool isBelow(const std::set<FileIdentity>& roots, const std::set<FileIdentity>& folders) {
    return std::any_of(roots.begin(), roots.end(),
                       [&](const FileIdentity& one) { return folders.contains(one); });
  }

  std::set<FileIdentity> files_, libraries_, system_;
};

CompileDiagnostic refusal(const std::string& mainFile, int line, std::string message) {
  return {mainFile, line, line > 0 ? 1 : 0, "error", "forbidden-call", std::move(message)};
}

}  // namespace

std::vector<fs::path> dependenciesIn(std::string_view list, const fs::path& folder) {
  std::vector<fs::path> files;
  std::string name;
  const auto end = [&] {
    if (!name.empty() && name.back() != ':') files.push_back(folder / name);
    name.clear();
  };
  for (std::size_t k = 0; k < list.size(); ++k) {
    const char c = list[k], next = k + 1 < list.size() ? list[k + 1] : '\0';
    if (c == '\\' && (next == ' ' || next == '#' || next == '\\'))
      name += list[++k];
    else if (c == '\\' && next == '\n')
      end(), ++k;
    else if (c == '$' && next == '$')
      name += list[++k];
    else if (c == ' ' || c == '\n')
      end();
    else
      name += c;
  }
  end();
  return files;
}

std::vector<CompileDiagnostic> forbiddenIncludes(const std::vector<fs::path>& dependencies,
                                                 std::string_view source, const std::string& mainFile,
                                                 const fs::path& folder, const Toolchain& toolchain) {
  const Allowed allowed(mainFile, folder, toolchain);
  std::vector<CompileDiagnostic> messages;
  for (const fs::path& file : dependencies) {
    if (messages.size() > kMostMessages) break;
    if (allowed.holds(file)) continue;
    const std::string name = file.filename().string();
    messages.push_back(refusal(
        mainFile, lineOf(name, source),
        fmt::format(
            "includes {}: only public headers of the library, of the system, and those that the handed-out "
            "main.cpp includes may be included",
            name)));
  }
  return messages;
}

std::vector<fs::path> filesOfAssembler(std::string_view list, const fs::path& folder) {
  std::vector<fs::path> files = dependenciesIn(list, folder);
  if (!files.empty()) files.pop_back();
  return files;
}

std::vector<CompileDiagnostic> forbiddenMacros(std::string_view source, const std::string& mainFile) {
  const int line = macroDefinitionLine("rex", source);
  if (line == 0) return {};
  return {refusal(mainFile, line, "defines a macro 'rex', which is the name of the library")};
}

}  // namespace rex::submission
