#include "classroom/download.h"

#include <algorithm>
#include <array>
#include <cerrno>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "base/lower_case.h"
#include "base/opened_folder.h"
#include "classroom/archive.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = std::size_t{20} << 20, kMostBytes = std::size_t{512} << 20;
constexpr int kMostFiles = 100'000, kDeepest = 30;

bool isWantedInDownload(const std::string& name) {
  return isSourceName(name) || isArchiveName(name) || endingOf(name) == ".yml";
}

/// Reads a folder and all folders in it.
class FolderWalk {
 public:
  explicit FolderWalk(const fs::path& path) : path_(path) {}

  std::vector<DownloadedFile> read() {
    visit(OpenedFolder(path_), "", 0);
    return std::move(files_);
  }

 private:
  void visit(const OpenedFolder& folder, const std::string& prefix, int depth) {
    if (depth > kDeepest) throw tooMuch(folder.path(), "folders in folders", kDeepest);
    for (const OpenedFolder::Entry& entry : folder.entries()) {
      const std::string name = prefix + entry.name;
      if (entry.type == fs::file_type::directory) {
        if (entry.name != ".git") visit(folder.folder(entry.name), name + "/", depth + 1);
        continue;
      }
      if (static_cast<int>(files_.size()) >= kMostFiles) throw tooMuch(path_, "files", kMostFiles);
      files_.push_back(readEntry(folder, entry, name));
    }
  }

  DownloadedFile readEntry(const OpenedFolder& folder, const OpenedFolder::Entry& entry,
                           const std::string& name) {
    DownloadedFile file{.name = name, .place = name};
    if (entry.type != fs::file_type::regular)
      file.whyNot = entry.type == fs::file_type::symlink ? "a symbolic link" : "a pipe or device";
    else if (isWantedInDownload(name))
      readText(folder, entry.name, file);
    return file;
  }

  void readText(const OpenedFolder& folder, const std::string& entry, DownloadedFile& file) {
    try {
      const OpenedFile opened = folder.file(entry);
      file.modifiedAt = opened.modifiedAt();
      std::string text;
      std::array<char, 65536> buffer;
      for (ssize_t n = 1; n > 0 && text.size() <= kLargestFile;) {
        n = ::read(opened.fd(), buffer.data(), buffer.size());
        if (n < 0) throw Error({.what = "cannot be read", .found = std::strerror(errno)});
        text.append(buffer.data(), static_cast<std::size_t>(n));
      }
      bytes_ += text.size();
      if (bytes_ > kMostBytes) throw tooMuch(path_, "MiB in all files", static_cast<int>(kMostBytes >> 20));
      if (text.size() > kLargestFile)
        file.whyNot = fmt::format("more than {} MiB", kLargestFile >> 20);
      else
        file.text = std::move(text);
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      file.whyNot = error.parts().found;
    }
  }

  static UsageError tooMuch(const fs::path& where, const std::string& of, int limit) {
    return UsageError({.what = "too much for a class",
                       .where = {where.string()},
                       .found = "more " + of,
                       .wanted = fmt::format("at most {}", limit)});
  }

  fs::path path_;
  std::vector<DownloadedFile> files_{};
  std::size_t bytes_ = 0;
};

std::vector<DownloadedFile> filesOfBundle(const fs::path& path) {
  ArchiveContent content = readBundle(path, isWantedInDownload);
  std::vector<DownloadedFile> files;
  for (ArchiveFile& file : content.files) {
    DownloadedFile& kept = files.emplace_back(
        DownloadedFile{.name = file.name, .place = file.name, .modifiedAt = file.modifiedAt});
    if (isWantedInDownload(kept.name)) kept.text = std::move(file.text);
  }
  for (const ArchiveContent::LeftOut& left : content.leftOut)
    files.push_back({.name = left.name, .place = left.name, .whyNot = left.why});
  return files;
}

}  // namespace

Download readDownload(const fs::path& path) {
  if (!fs::is_directory(path) && !isArchiveName(path.filename().string()))
    throw UsageError({.what = fs::exists(path) ? "not a download" : "no such file or folder",
                      .where = {path.string()},
                      .found = fs::exists(path) ? "a file" : "",
                      .wanted = "a .zip, .tar or .tar.gz file, or the folder that one was unpacked into"});
  Download download{.path = path,
                    .files = fs::is_directory(path) ? FolderWalk(path).read() : filesOfBundle(path)};
  std::sort(download.files.begin(), download.files.end(),
            [](const DownloadedFile& a, const DownloadedFile& b) { return a.name < b.name; });
  return download;
}

bool isOfSystem(const fs::path& name) {
  const std::string file = lowerCase(name.filename().string());
  return std::find(name.begin(), name.end(), "__MACOSX") != name.end() || file.starts_with("._") ||
         file == ".ds_store" || file == "thumbs.db" || file == "desktop.ini";
}

bool isSourceName(const std::string& name) {
  const std::string ending = endingOf(name);
  return ending == ".cpp" || ending == ".cc" || ending == ".cxx" || ending == ".c++";
}

}  // namespace rex::grading
