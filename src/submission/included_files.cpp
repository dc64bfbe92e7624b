#include "submission/included_files.h"

#include <algorithm>
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
#include "base/text.h"
#include "submission/build_tools.h"
#include "submission/cpp_names.h"
#include "submission/cpp_text.h"

namespace rex::submission {

using grading::CompileDiagnostic;

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWhiteSpace = " \t\v\f\r";

constexpr const char *kLineDirective = "found a #line directive, wanted the real line numbers of the file",
                     *kPragma = "found the pragma system_header, wanted code that the compiler warns about",
                     *kIncludesItself = "found an include of the file itself, wanted each of its lines once";

// After so many empty lines the compiler prints a marker, not the lines.
constexpr int kGap = 16;

struct Marker {
  std::int64_t line = 0;
  std::string_view file{};
  int depth = 0;  // 1: enters an included file; -1: leaves one
};

// Reads `# 7 "main.cpp" 2`; 2 of the flags from 1 to 4 says that a file was left.
std::optional<Marker> markerIn(std::string_view line) {
  if (!line.starts_with("# ")) return {};
  line.remove_prefix(2);
  const auto number = takeNumber<std::int64_t>(line);
  const std::size_t end = line.rfind('"');
  if (!number || !line.starts_with(" \"") || end < 2) return {};
  const std::string_view flags = line.substr(end + 1);
  if (flags.find_first_not_of(" 1234") != flags.npos) return {};
  const auto has = [&](char flag) { return flags.find(flag) != flags.npos; };
  return Marker{*number, line.substr(2, end - 2), has('1') ? 1 : has('2') ? -1 : 0};
}

enum class Oddity : std::uint8_t { kNone, kLine, kSelf };

// Follows the markers, and says at which line of the file the first one appears that no plain file makes.
// After an error the lines may end anywhere: then `size` is 0.
std::pair<Oddity, std::int64_t> firstOddity(std::string_view text, const std::string& mainFile, int size) {
  std::int64_t line = 1, marked = 1;
  int depth = 0;
  const std::size_t begin = text.find(fmt::format("\n# 1 \"{}\"\n", mainFile));
  text.remove_prefix(begin == text.npos ? text.size() : text.find('\n', begin + 1) + 1);
  for (const std::string_view one : splitLines(text)) {
    const std::optional<Marker> marker = markerIn(one);
    if (!marker) {
      line += depth == 0 && !one.ends_with('\t');  // a tab: in a raw string, which a macro may repeat
      continue;
    }
    depth += marker->depth;
    if (marker->depth > 0 && fs::path(marker->file).filename() == mainFile) return {Oddity::kSelf, line};
    if ((depth == 0) != (marker->file == mainFile)) return {Oddity::kLine, line};
    if (depth != 0) continue;
    // A marker in the middle of a line begins a new one.
    if (size > 0 && (marker->line + 1 < line || marker->line > size + kGap)) return {Oddity::kLine, line};
    line = marked = marker->line;
  }
  return {size == 0 || marked == size + kGap ? Oddity::kNone : Oddity::kLine, 1};
}

std::string_view withoutBlanks(std::string_view text) {
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(kWhiteSpace), text.size()));
    if (!text.starts_with("/*")) return text;
    text.remove_prefix(std::min(text.find("*/", 2), text.size() - 2) + 2);
  }
}

// Line and column of the first "#line" or "# 1" from that line on; the line itself if none looks so.
std::pair<int, int> lineDirective(const std::vector<std::string_view>& lines, int from) {
  for (std::size_t k = static_cast<std::size_t>(std::max(from - 2, 0)); k < lines.size(); ++k) {
    const std::string_view sign = withoutBlanks(lines[k]);
    if (!sign.starts_with('#') && !sign.starts_with("%:")) continue;
    const std::string_view word = withoutBlanks(sign.substr(sign.front() == '#' ? 1 : 2));
    if (word.starts_with("line") || (!word.empty() && word.front() >= '0' && word.front() <= '9'))
      return {static_cast<int>(k) + 1, static_cast<int>(lines[k].size() - sign.size()) + 1};
  }
  return {from, 1};
}

CompileDiagnostic lineMarker(const std::string& mainFile, int line, int column,
                             const char* message = kLineDirective) {
  return {mainFile, line, column, "error", "line-marker", message};
}

// What the compiler says itself, in a line such as "main.cpp:7:3: warning: ...". After "# 1" a file can also
// claim to be entered or left.
std::vector<CompileDiagnostic> complaintsOfMarkers(std::string_view complaints, const std::string& mainFile) {
  for (std::string_view line : splitLines(complaints)) {
    const bool isPragma = line.find(": #pragma system_header ignored") != line.npos;
    if (!isPragma && line.find(": style of line directive") == line.npos) continue;
    line.remove_prefix(std::min(mainFile.size() + 1, line.size()));
    const int row = takeNumber<int>(line).value_or(0);
    line.remove_prefix(std::min<std::size_t>(1, line.size()));
    return {
        lineMarker(mainFile, row, takeNumber<int>(line).value_or(0), isPragma ? kPragma : kLineDirective)};
  }
  return {};
}

}  // namespace

std::string sourceForMarkers(std::string_view source) {
  std::string text;
  for (const std::string_view line : splitLines(source)) {
    const std::size_t end = line.find_last_not_of(kWhiteSpace);
    const bool goesOn = end != line.npos && line[end] == '\\';
    text.append(line.substr(0, line.size() - line.ends_with('\r'))).append(goesOn ? "" : "\t");
    text.append(line.ends_with('\r') ? "\r\n" : "\n");
  }
  return text.append(kGap - 1, '\n').append(";\n");
}

std::vector<CompileDiagnostic> lineMarkers(std::string_view text, std::string_view complaints,
                                           std::string_view source, const std::string& mainFile,
                                           bool isWhole) {
  if (const auto found = complaintsOfMarkers(complaints, mainFile); !found.empty()) return found;
  const std::vector<std::string_view> lines = splitLines(source);
  const auto [oddity, line] = firstOddity(text, mainFile, isWhole ? static_cast<int>(lines.size()) : 0);
  if (oddity == Oddity::kNone) return {};
  const int last = std::max(static_cast<int>(lines.size()), 1),
            near = static_cast<int>(std::clamp<std::int64_t>(line, 1, last));
  if (oddity == Oddity::kSelf) return {lineMarker(mainFile, near, 1, kIncludesItself)};
  const auto [row, column] = lineDirective(lines, near);
  return {lineMarker(mainFile, row, column)};
}

namespace {

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
