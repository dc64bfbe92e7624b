#include "classroom/archive.h"

#include <algorithm>
#include <array>
#include <clocale>
#include <memory>
#include <set>
#include <string_view>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/isolated_call.h"
#include "base/text.h"
#include "classroom/gradebook_text.h"

namespace rex::classroom {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kEndings = {".tar.gz", ".tgz", ".tar", ".zip"};

std::size_t endingSize(const std::string& name) {
  const std::string lower = lowerCase(name);
  const auto found = std::find_if(kEndings.begin(), kEndings.end(),
                                  [&](std::string_view ending) { return lower.ends_with(ending); });
  return found == kEndings.end() ? 0 : found->size();
}

struct FreeArchive {
  void operator()(archive* opened) const { ::archive_read_free(opened); }
};

// Upper half of code page 437, the encoding of names in zip files that are not marked as UTF-8.
constexpr std::u16string_view kCodePage437 =
    u"\u00C7\u00FC\u00E9\u00E2\u00E4\u00E0\u00E5\u00E7\u00EA\u00EB\u00E8\u00EF\u00EE\u00EC\u00C4\u00C5"
    u"\u00C9\u00E6\u00C6\u00F4\u00F6\u00F2\u00FB\u00F9\u00FF\u00D6\u00DC\u00A2\u00A3\u00A5\u20A7\u0192"
    u"\u00E1\u00ED\u00F3\u00FA\u00F1\u00D1\u00AA\u00BA\u00BF\u2310\u00AC\u00BD\u00BC\u00A1\u00AB\u00BB"
    u"\u2591\u2592\u2593\u2502\u2524\u2561\u2562\u2556\u2555\u2563\u2551\u2557\u255D\u255C\u255B\u2510"
    u"\u2514\u2534\u252C\u251C\u2500\u253C\u255E\u255F\u255A\u2554\u2569\u2566\u2560\u2550\u256C\u2567"
    u"\u2568\u2564\u2565\u2559\u2558\u2552\u2553\u256B\u256A\u2518\u250C\u2588\u2584\u258C\u2590\u2580"
    u"\u03B1\u00DF\u0393\u03C0\u03A3\u03C3\u00B5\u03C4\u03A6\u0398\u03A9\u03B4\u221E\u03C6\u03B5\u2229"
    u"\u2261\u00B1\u2265\u2264\u2320\u2321\u00F7\u2248\u00B0\u2219\u00B7\u221A\u207F\u00B2\u25A0\u00A0";

std::string fromCodePage437(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) {
    const auto code = static_cast<unsigned char>(byte);
    const unsigned c = code < 0x80 ? code : kCodePage437[code - 0x80u];
    if (c >= 0x800) text += {static_cast<char>(0xE0 | c >> 12), static_cast<char>(0x80 | (c >> 6 & 0x3F))};
    if (c >= 0x80 && c < 0x800) text += static_cast<char>(0xC0 | c >> 6);
    text += static_cast<char>(c >= 0x80 ? 0x80 | (c & 0x3F) : c);
  }
  return text;
}

// The name in UTF-8 if the archive has one. The other form depends on the locale and need not be UTF-8; it is
// then read as code page 437.
std::string nameOf(archive_entry* entry) {
  const char* name = ::archive_entry_pathname_utf8(entry);
  if (name == nullptr) name = ::archive_entry_pathname(entry);
  const std::string bytes = name == nullptr ? "" : name;
  return isUtf8(bytes) ? bytes : fromCodePage437(bytes);
}

// What is wrong with a name; empty if it is safe.
std::string whyUnsafe(const std::string& name, const ArchiveLimits& limits) {
  if (name.empty()) return "no name";
  for (const std::string_view part : splitAt(name, '/'))
    if (part.size() > limits.nameBytes) return fmt::format("a name of {} bytes", part.size());
  if (name.size() > limits.pathBytes) return fmt::format("a path of {} bytes", name.size());
  if (name.front() == '/' || name.find('\\') != std::string::npos) return "an absolute name or a backslash";
  const fs::path path(name);
  if (std::find(path.begin(), path.end(), "..") != path.end()) return "a path out of its folder";
  return {};
}

std::string nameOfType(archive_entry* entry) {
  if (::archive_entry_hardlink(entry) != nullptr) return "a hard link";
  switch (::archive_entry_filetype(entry)) {
    case AE_IFREG:
    case AE_IFDIR:
      return {};
    case AE_IFLNK:
      return "a symbolic link";
    case AE_IFIFO:
      return "a pipe";
    default:
      return "a device or socket";
  }
}

constexpr int kMostFilesOfStudent = 5000;
constexpr std::size_t kMostBytesOfStudent = std::size_t{40} << 20;

}  // namespace

void StudentBudgets::see(const std::string& name) {
  if (name.starts_with("__MACOSX/") || !whyUnsafe(name, {}).empty()) return;
  const std::string top = name.substr(0, name.find('/') + 1);
  around_ = around_.value_or(top) == top ? top : "";
}

bool StudentBudgets::add(const std::string& name, int files, std::size_t bytes) {
  Used& used = used_[studentOf(name)];
  if (used.example.empty() || (!isWanted_(used.example) && isWanted_(name))) used.example = name;
  used.files += files;
  used.bytes += bytes;
  return whyTooMuch(used).empty();
}

bool StudentBudgets::isExceededBy(const std::string& name) const {
  const auto found = used_.find(studentOf(name));
  return found != used_.end() && !whyTooMuch(found->second).empty();
}

std::vector<ArchiveContent::LeftOut> StudentBudgets::leftOut() const {
  std::vector<ArchiveContent::LeftOut> all;
  for (const auto& [student, used] : used_)
    if (const std::string why = whyTooMuch(used); !why.empty()) all.push_back({used.example, why});
  return all;
}

std::string StudentBudgets::studentOf(const std::string& name) const {
  const std::string around = around_.value_or("");
  const std::string own = name.substr(name.starts_with(around) ? around.size() : 0),
                    first = own.substr(0, own.find('/'));
  return first.substr(0, first.find("_assignsubmission_"));
}

std::string StudentBudgets::whyTooMuch(const Used& used) {
  if (used.files > kMostFilesOfStudent)
    return fmt::format("more than {} files of one student", kMostFilesOfStudent);
  if (used.bytes > kMostBytesOfStudent)
    return fmt::format("more than {} MiB in the files of one student", kMostBytesOfStudent >> 20);
  return {};
}

namespace {

/// Where the bytes of an archive are: in an opened file or in memory.
struct ArchiveSource {
  int fd = -1;
  std::string_view bytes{};
  std::size_t size = 0;
};

ArchiveSource sourceOf(const OpenedFile& opened) { return {.fd = opened.fd(), .size = opened.size()}; }

using IsWanted = std::function<bool(const std::string& name)>;

/// Reads one archive, in a process that may crash on it.
class ArchiveReader {
 public:
  // With `isWanted` as readBundle() does, else as readArchive().
  ArchiveReader(const ArchiveSource& source, const fs::path& file, const ArchiveLimits& limits,
                const IsWanted& isWanted)
      : file_(file),
        limits_(limits),
        isWanted_(isWanted),
        budgets_(isWanted),
        source_(source),
        archiveBytes_(source.size) {
    if (archiveBytes_ > limits.bytes)
      throw refusal("", fmt::format("{} bytes", archiveBytes_), fmt::format("at most {}", limits.bytes));
    open();
  }

  ArchiveContent read() {
    if (isWanted_) seeNames();
    ArchiveContent content;
    archive_entry* entry = nullptr;
    for (int count = 1; readHeader(entry); ++count) {
      if (isWanted_) {
        readBundled(entry, content);
        continue;
      }
      requireAtMost(limits_.members, count);
      readMember(entry, content);
    }
    for (const std::string& name : twice_)
      if (std::erase_if(content.files, [&](const ArchiveFile& file) { return file.name == name; }) > 0)
        content.leftOut.push_back({name, "a second file of that name"});
    if (isWanted_) leaveOutStudents(content);
    return content;
  }

 private:
  void open() {
    archive_.reset(::archive_read_new());
    ::archive_read_support_filter_gzip(archive_.get());
    ::archive_read_support_format_tar(archive_.get());
    ::archive_read_support_format_zip_seekable(archive_.get());
    constexpr std::size_t kBlock = 10240;
    const int opened = source_.fd >= 0 ? ::archive_read_open_fd(archive_.get(), source_.fd, kBlock)
                                       : ::archive_read_open_memory(archive_.get(), source_.bytes.data(),
                                                                    source_.bytes.size());
    if (opened != ARCHIVE_OK) throw broken("");
  }

  // False at the end.
  bool readHeader(archive_entry*& entry) {
    const int end = ::archive_read_next_header(archive_.get(), &entry);
    if (end != ARCHIVE_EOF && end < ARCHIVE_WARN) throw broken("");
    return end != ARCHIVE_EOF;
  }

  void requireAtMost(int members, int count) const {
    if (count > members) throw refusal("", "more members", fmt::format("at most {}", members));
  }

  void seeNames() {
    archive_entry* entry = nullptr;
    while (readHeader(entry)) budgets_.see(nameOf(entry));
    if (source_.fd >= 0) ::lseek(source_.fd, 0, SEEK_SET);
    open();
  }

  void leaveOutStudents(ArchiveContent& content) const {
    const auto isTooMuch = [&](const auto& file) { return budgets_.isExceededBy(file.name); };
    std::erase_if(content.files, isTooMuch);
    std::erase_if(content.leftOut, isTooMuch);
    for (const ArchiveContent::LeftOut& file : budgets_.leftOut()) content.leftOut.push_back(file);
  }

  void readMember(archive_entry* entry, ArchiveContent& content) {
    const std::string name = checkedName(entry), type = nameOfType(entry);
    std::string text = textOf(name);
    if (!type.empty())
      content.leftOut.push_back({name, type});
    else if (::archive_entry_filetype(entry) == AE_IFREG)
      content.files.push_back({name, std::move(text), ::archive_entry_mtime(entry)});
  }

  void readBundled(archive_entry* entry, ArchiveContent& content) {
    const std::string name = nameOf(entry);
    if (!budgets_.add(name, 1, 0)) return;
    std::string why = whyUnsafe(name, limits_);
    if (why.empty()) why = nameOfType(entry);
    if (why.empty() && ::archive_entry_is_encrypted(entry) != 0) why = "an encrypted file";
    if (why.empty() && ::archive_entry_filetype(entry) != AE_IFREG) return;
    if (why.empty() && !names_.insert(name).second) {
      twice_.insert(name);
      return;
    }
    std::string text;
    if (why.empty() && isWanted_(name)) {
      why = readBundledText(text);
      if (!budgets_.add(name, 0, text.size())) return;
      bytes_ += text.size();
      if (bytes_ > limits_.bytes)
        throw refusal(name, "more bytes", fmt::format("at most {} in all files", limits_.bytes));
    }
    requireAtMost(limits_.members, static_cast<int>(content.files.size()));
    if (why.empty())
      content.files.push_back({name, std::move(text), ::archive_entry_mtime(entry)});
    else
      content.leftOut.push_back({name, why});
  }

  // Why the text cannot be had; libarchive skips the rest of the member.
  std::string readBundledText(std::string& text) {
    const ArchiveLimits one;
    const void* block = nullptr;
    std::size_t size = 0;
    la_int64_t offset = 0;
    for (;;) {
      const int end = ::archive_read_data_block(archive_.get(), &block, &size, &offset);
      if (end == ARCHIVE_EOF) break;
      if (end != ARCHIVE_OK) return saidBy("corrupt data");
      if (static_cast<std::size_t>(offset) + size > one.bytes)
        return fmt::format("more than {} MiB", one.bytes >> 20);
      text.resize(static_cast<std::size_t>(offset));
      text.append(static_cast<const char*>(block), size);
    }
    return {};
  }

  std::string checkedName(archive_entry* entry) {
    const std::string name = nameOf(entry), shown = printable(name, 100);
    if (const std::string why = whyUnsafe(name, limits_); !why.empty())
      throw refusal(shown, why, wantedInsteadOf(why, "a name inside a folder"));
    if (::archive_entry_is_encrypted(entry) != 0)
      throw refusal(shown, "an encrypted file", "one without a password");
    const std::string normal = lowerCase(fs::path(name).lexically_normal().string());
    const bool isFile = ::archive_entry_filetype(entry) != AE_IFDIR;
    if (isFile && !names_.insert(normal).second)
      throw refusal(shown, "a second file of that name (ignoring case)", "one");
    return name;
  }

  // Unwanted members are read, too: there is no other way to know their size.
  std::string textOf(const std::string& name) {
    std::string text;
    const void* block = nullptr;
    std::size_t size = 0;
    la_int64_t offset = 0;
    for (;;) {
      const int end = ::archive_read_data_block(archive_.get(), &block, &size, &offset);
      if (end == ARCHIVE_EOF) return text;
      if (end != ARCHIVE_OK) throw broken(name);
      bytes_ += size;
      if (bytes_ > limits_.bytes || static_cast<std::size_t>(offset) > limits_.bytes)
        throw refusal(name, "more bytes", fmt::format("at most {} in all files", limits_.bytes));
      if (bytes_ > limits_.ratio * archiveBytes_)
        throw refusal(name, fmt::format("more than {} times the bytes of the archive", limits_.ratio),
                      "files that were written by hand");
      text.resize(static_cast<std::size_t>(offset));  // holes read as zeros
      text.append(static_cast<const char*>(block), size);
    }
  }

  Error refusal(const std::string& member, std::string found, std::string wanted) const {
    return Error({.what = member.empty() ? "this archive is not accepted"
                                         : fmt::format("this archive is not accepted: member '{}'", member),
                  .where = {file_.string()},
                  .found = std::move(found),
                  .wanted = std::move(wanted)});
  }
  Error broken(const std::string& member) const {
    return refusal(member, saidBy("corrupt data"), "an intact .zip, .tar or .tar.gz file");
  }
  std::string saidBy(const char* otherwise) const {
    const char* said = ::archive_error_string(archive_.get());
    return said == nullptr ? otherwise : said;
  }

  fs::path file_;
  ArchiveLimits limits_;
  IsWanted isWanted_;
  StudentBudgets budgets_;
  ArchiveSource source_;
  std::size_t archiveBytes_;
  std::unique_ptr<archive, FreeArchive> archive_;
  std::set<std::string> names_, twice_;
  std::size_t bytes_ = 0;
};

std::string packed(const ArchiveContent& content) {
  nlohmann::json files = nlohmann::json::array(), leftOut = nlohmann::json::array();
  for (const ArchiveFile& file : content.files) files.push_back({file.name, file.text, file.modifiedAt});
  for (const auto& [name, why] : content.leftOut) leftOut.push_back({name, why});
  std::string bytes;
  nlohmann::json::to_cbor(nlohmann::json{{"files", files}, {"left_out", leftOut}}, bytes);
  return bytes;
}

// A bundle is as large as a class, and may take as long.
IsolationLimits isolationOf(const IsWanted& isWanted) {
  if (isWanted) return {.cpuSeconds = 120, .wallSeconds = 600, .memory = std::size_t{4} << 30};
  return {.cpuSeconds = 10, .wallSeconds = 60, .memory = std::size_t{512} << 20};
}

ArchiveContent readIsolated(const ArchiveSource& source, const fs::path& file, const ArchiveLimits& limits,
                            const IsWanted& isWanted) {
  const auto readAll = [&] {
    // In this process only: in the plain locale libarchive has no names for members that are not ASCII.
    std::setlocale(LC_CTYPE, "C.UTF-8");
    return packed(ArchiveReader(source, file, limits, isWanted).read());
  };
  const IsolatedResult read = callIsolated(readAll, isolationOf(isWanted));
  if (read.end != IsolatedEnd::kReturned)
    throw Error({.what = "this archive is not accepted",
                 .where = {file.string()},
                 .found = read.end == IsolatedEnd::kCrashed ? "one that crashes its reader"
                                                            : "one that takes too long or too much memory",
                 .wanted = "an intact .zip, .tar or .tar.gz file"});
  const nlohmann::json content = nlohmann::json::from_cbor(read.bytes);
  ArchiveContent all;
  for (const nlohmann::json& entry : content.at("files"))
    all.files.push_back(
        {entry.at(0).get<std::string>(), entry.at(1).get<std::string>(), entry.at(2).get<std::int64_t>()});
  for (const nlohmann::json& entry : content.at("left_out"))
    all.leftOut.push_back({entry.at(0).get<std::string>(), entry.at(1).get<std::string>()});
  return all;
}

}  // namespace

bool isArchiveName(const std::string& name) { return endingSize(name) > 0; }

std::string wantedInsteadOf(const std::string& why, const std::string& otherwise) {
  const bool isTooLong = why.ends_with(" bytes") && (why.starts_with("a name") || why.starts_with("a path"));
  const ArchiveLimits limits;
  return isTooLong ? fmt::format("names of at most {} bytes in a path of at most {}", limits.nameBytes,
                                 limits.pathBytes)
                   : otherwise;
}

std::string withoutArchiveEnding(const std::string& name) {
  return name.substr(0, name.size() - endingSize(name));
}

ArchiveContent readArchive(const OpenedFile& opened, const fs::path& file, const ArchiveLimits& limits) {
  return readIsolated(sourceOf(opened), file, limits, {});
}

ArchiveContent readArchive(const fs::path& file, const ArchiveLimits& limits) {
  const OpenedFolder folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
  return readArchive(folder.file(file.filename().string()), file, limits);
}

ArchiveContent readArchive(std::string_view bytes, const fs::path& file, const ArchiveLimits& limits) {
  return readIsolated({.bytes = bytes, .size = bytes.size()}, file, limits, {});
}

ArchiveContent readBundle(const fs::path& file, const IsWanted& isWanted) {
  const OpenedFolder folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
  const OpenedFile opened = folder.file(file.filename().string());
  constexpr ArchiveLimits kBundle{.members = 50'000, .bytes = std::size_t{512} << 20, .ratio = 0};
  return readIsolated(sourceOf(opened), file, kBundle, isWanted);
}

}  // namespace rex::classroom
