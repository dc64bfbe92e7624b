#include "authoring/leak_scan.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include "authoring/leak_scan_internal.h"
#include "base/error.h"
#include "base/folders.h"
#include "base/text.h"
#include "base/text_file.h"
#include "submission/student_files.h"

namespace rex::authoring {
namespace {

// Both ways to write them: the second is that of htmlText().
constexpr std::array<std::pair<std::string_view, char>, 10> kMeanings = {{{"&lt;", '<'},
                                                                          {"&gt;", '>'},
                                                                          {"&amp;", '&'},
                                                                          {"&quot;", '"'},
                                                                          {"&#60;", '<'},
                                                                          {"&#62;", '>'},
                                                                          {"&#38;", '&'},
                                                                          {"&#34;", '"'},
                                                                          {"&#39;", '\''},
                                                                          {"\\\"", '"'}}};
// Line breaks and tabs in literals, and lines that continue on the next.
constexpr std::array<std::string_view, 5> kNothing = {"\\n", "\\t", "\\r", "\\\n", "\\\r\n"};
constexpr std::array<std::string_view, 3> kCommentSigns = {"//", "/*", "*/"};

// The comment at the start of `rest`, or nothing.
std::string_view commentAt(std::string_view rest) {
  if (rest.starts_with("//")) return rest.substr(0, std::min(rest.find('\n'), rest.size()));
  if (!rest.starts_with("/*")) return {};
  return rest.substr(0, std::min(rest.find("*/", 2), rest.size() - 2) + 2);
}

// Text at the start of `rest` that is ignored.
std::string_view emptyAt(std::string_view rest, Comments comments) {
  if (rest[0] == '/' && comments == Comments::kDrop) return commentAt(rest);
  if (rest[0] == '/' || rest[0] == '*') {
    for (const std::string_view sign : kCommentSigns)
      if (rest.starts_with(sign)) return sign;
  }
  if (rest[0] == '\\') {
    for (const std::string_view escape : kNothing)
      if (rest.starts_with(escape)) return escape;
  }
  return {};
}

// The length of what represents a letter at the start of `rest`, and that letter (perhaps by itself).
std::pair<std::size_t, char> letterAt(std::string_view rest) {
  if (rest[0] == '&' || rest[0] == '\\')
    for (const auto& [text, letter] : kMeanings)
      if (rest.starts_with(text)) return {text.size(), letter};
  return {1, rest[0]};
}

}  // namespace

NormalText normalText(std::string_view text, Comments comments) {
  NormalText normal;
  int line = 1;
  while (!text.empty()) {
    const std::string_view empty = emptyAt(text, comments);
    const auto [size, letter] = empty.empty() ? letterAt(text) : std::pair{empty.size(), '\0'};
    // The zero bytes of text in UTF-16 vanish here, too.
    if (static_cast<unsigned char>(letter) > ' ') {
      normal.letters += letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
      normal.lines.push_back(line);
    }
    line += static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(size), '\n'));
    text.remove_prefix(size);
  }
  return normal;
}

namespace {

using std::string_view_literals::operator""sv;

constexpr std::size_t kMostBytes = std::size_t{256} << 20;

// A signature and its offset in the file.
struct FileSign {
  std::size_t at;
  std::string_view bytes;
};
constexpr std::array<FileSign, 11> kFileSigns = {{{0, "PK\x03\x04"sv},
                                                  {0, "PK\x05\x06"sv},
                                                  {257, "ustar"sv},
                                                  {0, "\x1f\x8b"sv},
                                                  {0, "BZh"sv},
                                                  {0,
                                                   "\xfd"
                                                   "7zXZ\0"sv},
                                                  {0, "LZIP"sv},
                                                  {0, "\x28\xb5\x2f\xfd"sv},
                                                  {0, "7z\xbc\xaf\x27\x1c"sv},
                                                  {0, "070701"sv},
                                                  {0, "Rar!\x1a"sv}}};

struct FreeArchive {
  void operator()(archive* opened) const { ::archive_read_free(opened); }
};

Error refusal(const std::string& file, std::string found) {
  return Error({.what = "cannot look into this archive",
                .where = {file},
                .found = std::move(found),
                .wanted = "one that can be unpacked here, or none"});
}

Error broken(const std::string& file, archive* reader) {
  const char* said = ::archive_error_string(reader);
  return refusal(file, said == nullptr ? "corrupt data" : said);
}

void readData(archive* reader, const std::string& file, std::size_t& total, std::string& bytes) {
  std::array<char, 65536> buffer;
  for (;;) {
    const la_ssize_t count = ::archive_read_data(reader, buffer.data(), buffer.size());
    if (count == 0) return;
    if (count < 0) throw broken(file, reader);
    total += static_cast<std::size_t>(count);
    if (total > kMostBytes) throw refusal(file, "more than 256 MiB");
    bytes.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

// Supports only those filters of libarchive that start no program.
void supportKnown(archive* reader) {
  ::archive_read_support_filter_gzip(reader);
  ::archive_read_support_filter_bzip2(reader);
  ::archive_read_support_filter_xz(reader);
  ::archive_read_support_filter_lzip(reader);
  ::archive_read_support_filter_zstd(reader);
  ::archive_read_support_format_zip(reader);
  ::archive_read_support_format_tar(reader);
  ::archive_read_support_format_7zip(reader);
  ::archive_read_support_format_cpio(reader);
  ::archive_read_support_format_rar(reader);
  ::archive_read_support_format_rar5(reader);
  ::archive_read_support_format_raw(reader);
}

}  // namespace

bool isPacked(std::string_view bytes) {
  for (const FileSign& sign : kFileSigns)
    if (bytes.size() > sign.at && bytes.substr(sign.at).starts_with(sign.bytes)) return true;
  return false;
}

std::vector<PackedFile> unpack(std::string_view bytes, const std::string& file) {
  const std::unique_ptr<archive, FreeArchive> reader(::archive_read_new());
  supportKnown(reader.get());
  if (::archive_read_open_memory(reader.get(), bytes.data(), bytes.size()) != ARCHIVE_OK)
    throw broken(file, reader.get());
  std::vector<PackedFile> files;
  archive_entry* entry = nullptr;
  std::size_t total = 0;
  for (;;) {
    const int end = ::archive_read_next_header(reader.get(), &entry);
    if (end == ARCHIVE_EOF) return files;
    if (end < ARCHIVE_WARN) throw broken(file, reader.get());
    const bool isRaw = ::archive_format(reader.get()) == ARCHIVE_FORMAT_RAW;
    // Nothing was unpacked then, and scanning would unpack the same bytes again and again.
    if (isRaw && ::archive_filter_count(reader.get()) < 2) throw refusal(file, "an unknown kind");
    if (::archive_entry_is_encrypted(entry) != 0) throw refusal(file, "an encrypted file");
    const char* name = ::archive_entry_pathname(entry);
    PackedFile& packed = files.emplace_back();
    if (!isRaw && name != nullptr) packed.name = name;
    readData(reader.get(), file, total, packed.bytes);
  }
}

namespace {

namespace fs = std::filesystem;

// Depth of nested archives; deeper ones are made to hide something.
constexpr int kDeepest = 4;

// Whether the bytes begin like those of a program or library.
bool isCompiled(std::string_view bytes) {
  constexpr std::array<std::string_view, 6> kBeginnings = {
      "\x7f"
      "ELF",
      "!<arch>\n",
      "!<thin>\n",
      "gpch",
      "\xcf\xfa\xed\xfe",
      "CPCH"};
  return std::any_of(kBeginnings.begin(), kBeginnings.end(),
                     [&](std::string_view beginning) { return bytes.starts_with(beginning); });
}

// Line, from 1, of a mark such as `// <hidden>` that stripping should have removed; 0 if there is none.
int lineOfMark(std::string_view text) {
  constexpr std::array<std::string_view, 6> kMarks = {"<solution ", "</solution>", "<todo>",
                                                      "<hidden>",   "</hidden>",   "<variant "};
  int number = 0;
  for (std::string_view line : splitLines(text)) {
    ++number;
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with("//")) continue;
    for (const std::string_view mark : kMarks)
      if (line.find(mark) != line.npos) return number;
  }
  return 0;
}

// Where a file of an installed tree was before: share/cmake/RexInstall.cmake.
fs::path beforeInstalling(const fs::path& name) {
  if (isBelow("share/rex", name)) return name.lexically_relative("share/rex");
  if (isBelow("include/rex", name)) return "src" / name.lexically_relative("include/rex");
  return name;
}

/// Scans one tree.
class Scanner {
 public:
  Scanner(const std::vector<Secret>& secrets, fs::path library, TreeKind kind)
      : secrets_(secrets), library_(std::move(library)), isInstalled_(kind == TreeKind::kInstalled) {
    for (std::size_t k = 0; k < secrets.size(); ++k)
      for (const std::string& form : secrets[k].forms) index_.add(form, k);
  }

  LeakScan scan(const fs::path& tree) {
    std::vector<fs::path> files;
    for (auto entry = fs::recursive_directory_iterator(tree); entry != fs::end(entry); ++entry) {
      const fs::path name = entry->path().lexically_relative(tree);
      if (entry->is_symlink()) {
        if (isInstalled_ && isBelow(fs::canonical(tree), fs::weakly_canonical(entry->path()))) continue;
        refuse(name.generic_string(), "a link, whose target is not scanned,");
      } else if (name.filename() == ".git") {
        refuse(name.generic_string(), "a history, which is not scanned,");
        if (entry->is_directory()) entry.disable_recursion_pending();
      } else if (entry->is_regular_file()) {
        files.push_back(name);
      }
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& name : files) {
      const fs::path origin = isInstalled_ ? beforeInstalling(name) : name;
      scanFile(name.generic_string(), origin, readTextFile(tree / name), 0);
    }
    return std::move(found_);
  }

 private:
  void refuse(const std::string& file, std::string what, int line = 0) {
    found_.leaks.push_back({.where = {file, line}, .what = std::move(what)});
  }

  // `place` is what messages show, `name` the name of the file in its folder or archive.
  void scanFile(const std::string& place, const fs::path& name, const std::string& bytes, int depth) {
    ++found_.files;
    found_.bytes += bytes.size();
    const std::set<std::size_t> before = std::exchange(told_, {});
    const bool isLibrary = depth == 0 && isOfTheLibrary(name, bytes);
    const bool isShown = isBelow("share/template", name);
    if (!isShown && !isLibrary) judgeName(place, name);
    search(place, name, name.generic_string(), isLibrary, false);
    search(place, name, bytes, isLibrary, true);
    if (const int line = isCode(name) && !isShown && !isLibrary ? lineOfMark(bytes) : 0; line > 0)
      refuse(place, "a mark of a region", line);
    if (isCompiled(bytes) && told_.empty() && !isInstalled_)
      refuse(place, "a compiled file of unknown origin");
    if (isPacked(bytes)) scanPacked(place, bytes, depth);
    told_ = before;
  }

  void scanPacked(const std::string& place, const std::string& bytes, int depth) {
    ++found_.packed;
    try {
      if (depth == kDeepest)
        throw Error({.what = "archives", .found = fmt::format("more than {} inside each other", kDeepest)});
      for (const PackedFile& file : unpack(bytes, place)) {
        const std::string name = file.name.empty() ? "(unpacked)" : file.name;
        if (!name.ends_with('/')) scanFile(place + ": " + name, name, file.bytes, depth + 1);
      }
    } catch (const Error& error) {
      refuse(place, fmt::format("an archive that cannot be opened ({}),", error.parts().found));
    }
  }

  // A file in src counts as the library's own only if its contents are the same.
  bool isOfTheLibrary(const fs::path& name, const std::string& bytes) const {
    if (library_.empty() || !isBelow("src", name)) return false;
    const fs::path original = library_ / name.lexically_relative("src");
    return fs::is_regular_file(original) && readTextFile(original) == bytes;
  }

  void judgeName(const std::string& place, const fs::path& name) {
    if (submission::isForLecturers(name)) refuse(place, "a file of that name");
    if (isInstalled_ && name.filename() == "check.cpp") refuse(place, "a file of that name");
    const fs::path folders = name.parent_path();
    if (std::find(folders.begin(), folders.end(), "wrong") != folders.end())
      refuse(place, "a file in a folder of that name");
  }

  static bool isCode(const fs::path& name) {
    return name.extension() == ".cpp" || name.extension() == ".h" || name.extension() == ".hpp";
  }

  void search(const std::string& place, const fs::path& name, std::string_view text, bool isLibrary,
              bool hasLines) {
    for (const Comments comments : {Comments::kKeep, Comments::kDrop}) {
      const NormalText normal = normalText(text, comments);
      index_.search(normal.letters, [&](std::size_t k, std::size_t at) {
        const Secret& secret = secrets_[k];
        if (isLibrary && secret.kind != SecretKind::kCourseSecret) return;
        if (!isInstalled_ && secret.kind == SecretKind::kVisibleCheck) return;
        if (isUsualElsewhere(secret, isInstalled_ ? name : fs::path(place))) return;
        if (!told_.insert(k).second) return;
        found_.leaks.push_back({.where = {place, hasLines ? normal.lines[at] : 0},
                                .what = std::string(toString(secret.kind)),
                                .text = secret.text,
                                .origin = secret.origin});
      });
    }
  }

  // Loop heads and declarations look alike in all exercises.
  static bool isUsualElsewhere(const Secret& secret, const fs::path& place) {
    constexpr std::size_t kShortestElsewhere = 40;
    const fs::path home = fs::path(secret.origin.file).parent_path(), folder = place.parent_path();
    return secret.kind == SecretKind::kSolution && isBelow("exercises", folder) && folder != "exercises" &&
           !isBelow(home, place) && secret.forms.front().size() < kShortestElsewhere;
  }

  const std::vector<Secret>& secrets_;
  fs::path library_;
  bool isInstalled_;
  internal::FormIndex index_;
  std::set<std::size_t> told_{};  // in this file
  LeakScan found_{};
};

}  // namespace

std::string toString(const Leak& leak) {
  const std::string origin = leak.origin.file.empty() ? "" : "of " + toString(leak.origin);
  const std::string found = leak.text.empty() ? origin : fmt::format("'{}' {}", leak.text, origin);
  return Error({.what = leak.what + " would reach students", .where = leak.where, .found = found}).what();
}

LeakScan scanForLeaks(const fs::path& tree, const std::vector<Secret>& secrets, const fs::path& library,
                      TreeKind kind) {
  try {
    return Scanner(secrets, library, kind).scan(tree);
  } catch (const fs::filesystem_error& error) {
    throw Error({.what = "cannot look through this folder",
                 .where = {error.path1().empty() ? tree.string() : error.path1().string()},
                 .found = error.code().message()});
  }
}

}  // namespace rex::authoring
