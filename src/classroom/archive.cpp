#include "classroom/archive.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string_view>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/isolated_call.h"
#include "base/lower_case.h"

namespace rex::grading {
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

// What is wrong with a name; empty if nothing is.
std::string whyUnsafe(const std::string& name, const ArchiveLimits& limits) {
  if (name.empty()) return "no name";
  if (name.size() > limits.nameBytes) return fmt::format("a name of {} bytes", name.size());
  if (name.front() == '/' || name.find('\\') != std::string::npos || name.find(':') != std::string::npos)
    return "an absolute name, a drive or a backslash";
  const fs::path path(name);
  if (std::find(path.begin(), path.end(), "..") != path.end()) return "a way out of its folder";
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

/// Goes through one archive, in a process that may die of it.
class ArchiveReader {
 public:
  ArchiveReader(const fs::path& file, const ArchiveLimits& limits)
      : file_(file), limits_(limits), archiveBytes_(fs::file_size(file)), archive_(::archive_read_new()) {
    if (archiveBytes_ > limits.bytes)
      throw refusal("", fmt::format("{} bytes", archiveBytes_), fmt::format("at most {}", limits.bytes));
    ::archive_read_support_filter_gzip(archive_.get());
    ::archive_read_support_format_tar(archive_.get());
    ::archive_read_support_format_zip_seekable(archive_.get());
    constexpr std::size_t kBlock = 10240;
    if (::archive_read_open_filename(archive_.get(), file.c_str(), kBlock) != ARCHIVE_OK) throw broken("");
  }

  std::vector<ArchiveFile> read() {
    std::vector<ArchiveFile> files;
    archive_entry* entry = nullptr;
    for (int count = 1;; ++count) {
      const int end = ::archive_read_next_header(archive_.get(), &entry);
      if (end == ARCHIVE_EOF) return files;
      if (end < ARCHIVE_WARN) throw broken("");
      if (count > limits_.members)
        throw refusal("", "more members", fmt::format("at most {}", limits_.members));
      const std::string name = checkedName(entry);
      std::string text = textOf(name);
      if (::archive_entry_filetype(entry) == AE_IFREG) files.push_back({name, std::move(text)});
    }
  }

 private:
  std::string checkedName(archive_entry* entry) {
    const char* pointer = ::archive_entry_pathname(entry);
    const std::string name = pointer == nullptr ? "" : pointer;
    const std::string shown = name.substr(0, 100);
    if (const std::string why = whyUnsafe(name, limits_); !why.empty())
      throw refusal(shown, why, "a name inside of a folder");
    if (const std::string type = nameOfType(entry); !type.empty())
      throw refusal(shown, type, "files and folders only");
    if (::archive_entry_is_encrypted(entry) != 0)
      throw refusal(shown, "an encrypted file", "one without a password");
    const std::string normal = lowerCase(fs::path(name).lexically_normal().string());
    const bool isFile = ::archive_entry_filetype(entry) == AE_IFREG;
    if (isFile && !names_.insert(normal).second)
      throw refusal(shown, "a second file of that name, where case does not count", "one");
    return name;
  }

  // Also what is not wanted is read: only so is it known how large it is.
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
    return Error({.what = member.empty() ? "this archive is not taken"
                                         : fmt::format("this archive is not taken: member '{}'", member),
                  .where = {file_.string()},
                  .found = std::move(found),
                  .wanted = std::move(wanted)});
  }
  Error broken(const std::string& member) const {
    const char* said = ::archive_error_string(archive_.get());
    return refusal(member, said == nullptr ? "something broken" : said, "a whole .zip, .tar or .tar.gz file");
  }

  fs::path file_;
  ArchiveLimits limits_;
  std::size_t archiveBytes_;
  std::unique_ptr<archive, FreeArchive> archive_;
  std::set<std::string> names_;
  std::size_t bytes_ = 0;
};

std::string packed(const std::vector<ArchiveFile>& files) {
  nlohmann::json list = nlohmann::json::array();
  for (const ArchiveFile& file : files) list.push_back({file.name, file.text});
  std::string bytes;
  nlohmann::json::to_cbor(list, bytes);
  return bytes;
}

}  // namespace

bool isArchiveName(const std::string& name) { return endingSize(name) > 0; }

std::string withoutArchiveEnding(const std::string& name) {
  return name.substr(0, name.size() - endingSize(name));
}

std::vector<ArchiveFile> readArchive(const fs::path& file, const ArchiveLimits& limits) {
  const IsolatedResult read = callIsolated([&] { return packed(ArchiveReader(file, limits).read()); },
                                           {.cpuSeconds = 10, .wallSeconds = 60, .memory = 512u << 20});
  if (read.end != IsolatedEnd::kReturned)
    throw Error({.what = "this archive is not taken",
                 .where = {file.string()},
                 .found = read.end == IsolatedEnd::kCrashed ? "one that its reader crashes on"
                                                            : "one that takes too long or too much memory",
                 .wanted = "a whole .zip, .tar or .tar.gz file"});
  std::vector<ArchiveFile> files;
  for (const nlohmann::json& entry : nlohmann::json::from_cbor(read.bytes))
    files.push_back({entry.at(0).get<std::string>(), entry.at(1).get<std::string>()});
  return files;
}

}  // namespace rex::grading
