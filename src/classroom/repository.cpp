#include "classroom/repository.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/process.h"
#include "base/text_file.h"

namespace rex::classroom {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostOutput = std::size_t{64} << 20, kLargestContent = std::size_t{2} << 20;

bool isCommitId(const std::string& text, std::size_t fewest = 40) {
  return text.size() >= fewest && text.size() <= 40 &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// A small text file of a clone, without its last line break; nothing if there is no such file.
std::optional<std::string> textIn(const OpenedFolder& folder, const std::string& name) {
  constexpr std::size_t kLargest = std::size_t{8} << 20;
  if (folder.typeOf(name) != fs::file_type::regular) return {};
  const OpenedFile opened = folder.file(name);
  std::string text(std::min(opened.size(), kLargest), '\0');
  const ssize_t size = ::read(opened.fd(), text.data(), text.size());
  text.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
  while (text.ends_with('\n') || text.ends_with('\r')) text.pop_back();
  return text;
}

// The commit of a branch in a file of its own, as after a push, or in the list of packed ones.
std::string commitOf(const OpenedFolder& git, const std::string& branch) {
  const fs::path path(branch);
  const bool isSafe = branch.starts_with("refs/") && branch.find("..") == branch.npos;
  if (!isSafe) return {};
  std::optional<OpenedFolder> folder(git.folder("refs"));
  for (auto part = std::next(path.begin()); part != path.end(); ++part) {
    if (std::next(part) == path.end()) {
      if (const auto id = textIn(*folder, part->string())) return *id;
    } else if (folder->typeOf(part->string()) == fs::file_type::directory) {
      OpenedFolder inner = folder->folder(part->string());
      folder.emplace(std::move(inner));
    } else {
      break;
    }
  }
  std::istringstream packed(textIn(git, "packed-refs").value_or(""));
  for (std::string line; std::getline(packed, line);)
    if (line.size() > 41 && line.substr(41) == branch) return line.substr(0, 40);
  return {};
}

// Those below refs/tags/submit, in files of their own or in the list of packed ones.
std::map<std::string, std::string> submitTagsOf(const OpenedFolder& git) {
  constexpr std::string_view kMark = "refs/tags/submit/";
  std::map<std::string, std::string> tags;
  std::istringstream packed(textIn(git, "packed-refs").value_or(""));
  for (std::string line; std::getline(packed, line);)
    if (line.size() > 41 && line.substr(41).starts_with(kMark))
      tags[line.substr(41 + kMark.size())] = line.substr(0, 40);
  std::optional<OpenedFolder> folder(git.folder("refs"));
  for (const char* part : {"tags", "submit"}) {
    if (folder->typeOf(part) != fs::file_type::directory) return tags;
    OpenedFolder inner = folder->folder(part);
    folder.emplace(std::move(inner));
  }
  for (const OpenedFolder::Entry& entry : folder->entries())
    if (const auto id = textIn(*folder, entry.name)) tags[entry.name] = *id;
  return tags;
}

// git follows links to objects, also to those of other students.
std::string linkBelow(const OpenedFolder& folder, int depth = 0) {
  constexpr int kDeepestObject = 2;  // "pack/NAME", "ab/NAME" and "info/commit-graphs/NAME"
  for (const OpenedFolder::Entry& entry : folder.entries()) {
    std::string found;
    if (entry.type == fs::file_type::directory && depth <= kDeepestObject)
      found = linkBelow(folder.folder(entry.name), depth + 1);
    else if (entry.type != fs::file_type::regular)
      return entry.name;
    if (!found.empty()) return entry.name + "/" + found;
  }
  return {};
}

std::string headOf(const OpenedFolder& git) {
  const std::string head = textIn(git, "HEAD").value_or(""), mark = "ref: ";
  return head.starts_with(mark) ? commitOf(git, head.substr(mark.size())) : head;
}

}  // namespace

Repository::Repository(const OpenedFolder& clone)
    : clone_(clone.path()), ours_(std::make_unique<PrivateFolder>(fs::temp_directory_path())) {
  if (clone.typeOf(".git") != fs::file_type::directory) throw unreadable("no folder .git");
  const OpenedFolder git = clone.folder(".git");
  if (git.typeOf("objects") != fs::file_type::directory) throw unreadable("no folder .git/objects");
  const OpenedFolder objects = git.folder("objects");
  if (const std::string link = linkBelow(objects); !link.empty())
    throw unreadable(fmt::format("a .git/objects/{} that is neither file nor folder", printable(link, 200)));
  if (objects.typeOf("info") == fs::file_type::directory &&
      objects.folder("info").typeOf("alternates") != fs::file_type::not_found)
    throw unreadable("objects that lie in another repository");
  head_ = headOf(git);
  if (!head_.empty() && !isCommitId(head_))
    throw unreadable(fmt::format("'{}' as its newest commit", printable(head_, 60)));
  tags_ = submitTagsOf(git);
  fs::create_directories(ours_->path() / "git" / "objects");
  fs::create_directories(ours_->path() / "git" / "refs");
  writeTextFile(ours_->path() / "git" / "HEAD", "ref: refs/heads/none\n");
  writeTextFile(ours_->path() / "git" / "config", "[core]\n\trepositoryformatversion = 0\n\tbare = true\n");
  // Where the history of a shallow clone ends.
  std::istringstream lines(textIn(git, "shallow").value_or(""));
  std::string shallow;
  for (std::string line; std::getline(lines, line);)
    if (isCommitId(line)) shallow += line + "\n";
  if (!shallow.empty()) writeTextFile(ours_->path() / "git" / "shallow", shallow);
}

Error Repository::unreadable(const std::string& found) const {
  return Error({.what = "cannot read this repository",
                .where = {clone_.string()},
                .found = found,
                .wanted = "a clone with all its objects, as `git clone` makes it"});
}

std::string Repository::git(const std::vector<std::string>& arguments, const std::string& input) const {
  const std::string home = ours_->path().string();
  std::vector<std::string> command = {"git",
                                      "-c",
                                      "core.hooksPath=/dev/null",
                                      "-c",
                                      "core.attributesFile=/dev/null",
                                      "-c",
                                      "protocol.allow=never",
                                      "-c",
                                      "core.packedGitWindowSize=16m",
                                      "-c",
                                      "core.packedGitLimit=256m",
                                      "-c",
                                      "pack.threads=1",
                                      "--no-pager"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const ProcessResult run = runProcess(
      command, {.input = input,
                .directory = ours_->path(),
                .environment = {"GIT_DIR=" + home + "/git",
                                "GIT_OBJECT_DIRECTORY=" + fs::absolute(clone_ / ".git" / "objects").string(),
                                "GIT_ALTERNATE_OBJECT_DIRECTORIES=", "GIT_CONFIG_NOSYSTEM=1",
                                "GIT_CONFIG_GLOBAL=/dev/null", "GIT_CONFIG_COUNT=0",
                                "GIT_CONFIG_PARAMETERS=", "GIT_ATTR_NOSYSTEM=1", "GIT_NO_REPLACE_OBJECTS=1",
                                "GIT_NO_LAZY_FETCH=1", "GIT_TERMINAL_PROMPT=0", "GIT_OPTIONAL_LOCKS=0",
                                "HOME=" + home, "XDG_CONFIG_HOME=" + home, "LC_ALL=C"},
                .timeout = 60,
                .outputLimit = kMostOutput,
                .cpuSeconds = 30,
                .addressSpace = std::size_t{1} << 30,
                .fileSize = 1u << 20});
  if (!run.started)
    throw Error({.what = "git, which reads repositories, is not installed", .wanted = "the package git"});
  if (!run.ok() || run.output.size() >= kMostOutput)
    throw unreadable(run.timedOut ? "one that takes too long"
                                  : "git says: " + printable(run.error.substr(0, run.error.find('\n')), 200));
  return run.output;
}

std::vector<Commit> Repository::history() const {
  std::vector<Commit> commits;
  if (head_.empty()) return commits;
  std::istringstream lines(git({"rev-list", "--first-parent", "--timestamp", "-n", "20000", head_}));
  for (Commit commit; lines >> commit.time >> commit.id;) commits.push_back(commit);
  return commits;
}

std::optional<Commit> Repository::find(const std::string& id) const {
  constexpr std::size_t kFewestDigits = 7;
  if (!isCommitId(id, kFewestDigits)) return {};
  try {
    std::istringstream line(git({"rev-list", "--timestamp", "-n", "1", id}));
    Commit commit;
    if (line >> commit.time >> commit.id) return commit;
  } catch (const Error&) {
    return {};
  }
  return {};
}

std::vector<CommittedFile> Repository::filesNamed(const std::string& name, const Commit& commit) const {
  std::vector<CommittedFile> files;
  const std::string list = git({"ls-tree", "-r", "-l", "-z", "--full-tree", commit.id});
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find('\0', at), list.size());
    const std::string entry = list.substr(at, end - at);
    at = end + 1;
    const std::size_t tab = entry.find('\t');  // "100644 blob ID  SIZE<tab>PATH"
    if (tab == entry.npos || fs::path(entry.substr(tab + 1)).filename() != name) continue;
    std::istringstream words(entry.substr(0, tab));
    CommittedFile file{.path = entry.substr(tab + 1)};
    std::string mode, type;
    std::size_t size = 0;
    words >> mode >> type >> file.id >> size;
    if (type != "blob") file.whyNot = "another repository";
    if (mode == "120000") file.whyNot = "a symbolic link";
    if (size > kLargestContent) file.whyNot = fmt::format("more than {} MiB", kLargestContent >> 20);
    files.push_back(std::move(file));
  }
  return files;
}

std::map<std::string, int> Repository::changeCounts(const std::string& name, const Commit& commit) const {
  std::map<std::string, int> changes;
  const std::string list = git({"log", "--first-parent", "--no-renames", "--format=", "--name-only", "-z",
                                "-n", "20000", commit.id, "--", ":(glob)**/" + name});
  std::size_t at = 0;
  while (at < list.size()) {
    const std::size_t end = std::min(list.find('\0', at), list.size());
    if (end > at) ++changes[list.substr(at, end - at)];
    at = end + 1;
  }
  return changes;
}

// git answers each id with "ID blob SIZE", a line break, the content and another line break.
std::vector<std::string> Repository::readContents(const std::vector<CommittedFile>& files) const {
  std::string ids;
  for (const CommittedFile& file : files)
    if (file.whyNot.empty()) ids += file.id + "\n";
  const std::string answer = ids.empty() ? "" : git({"cat-file", "--batch"}, ids);
  std::vector<std::string> contents(files.size());
  std::size_t at = 0;
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (!files[k].whyNot.empty()) continue;
    const std::size_t end = answer.find('\n', at);
    std::istringstream words(answer.substr(std::min(at, answer.size()), end - at));
    std::string id, type;
    std::size_t size = 0;
    if (!(words >> id >> type >> size) || type != "blob" || end + 1 + size > answer.size())
      throw unreadable("no content of '" + printable(files[k].path, 200) + "'");
    contents[k] = answer.substr(end + 1, size);
    at = end + size + 2;
  }
  return contents;
}

}  // namespace rex::classroom
