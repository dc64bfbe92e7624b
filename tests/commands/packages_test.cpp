// Whether the packages of share/packages.txt suffice, on a machine that has more: every file of the system
// that the build read, and every program and library that rex looks for while it runs, must belong to one of
// them or to what they depend on.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "support/file_text.h"
#include "support/paths.h"

namespace rex::cli::packages_test {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

std::string outputOf(const std::vector<std::string>& command) {
  constexpr std::size_t kMost = 200u << 20;
  return runProcess(command, {.timeout = 100, .outputLimit = kMost}).output;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

// Headers that were read for our sources and the exercises, not for tests; libraries that rex is linked with.
Names filesOfTheBuild() {
  Names files;
  bool isOurs = false;
  for (const std::string& line : split(outputOf({"ninja", "-C", ownFolder(), "-t", "deps"}), '\n')) {
    if (!line.starts_with(' ')) isOurs = line.starts_with("src/") || line.starts_with("exercises/");
    if (isOurs && line.starts_with("    /usr/")) files.insert(line.substr(4));
  }
  for (const std::string& line :
       split(outputOf({"ninja", "-C", ownFolder(), "-t", "inputs", "program"}), '\n'))
    if (line.starts_with("/usr/")) files.insert(line);
  return files;
}

Names filesOfTheRun() {
  Names files = {"/usr/share/javascript/three/three.min.js", "/usr/share/zoneinfo/Europe/Berlin"};
  for (const char* program : {"c++", "cmake", "ninja", "ld", "nm", "gnuplot", "ffmpeg", "bwrap", "git"})
    files.insert(fs::canonical(std::string("/usr/bin/") + program).string());
  for (const char* library : {"libOSMesa.so.8", "libEGL.so.1"})
    for (const std::string& line : split(outputOf({"/sbin/ldconfig", "-p"}), '\n'))
      if (line.find(std::string(library) + " (libc6,x86-64)") != line.npos)
        files.insert(line.substr(line.find("=> ") + 3));
  return files;
}

// dpkg knows a file by the path in its package: that of a link's target, or without /usr.
std::string packageOf(const std::string& file) {
  std::error_code missing;
  for (const std::string& path : {file, fs::canonical(file, missing).string(), file.substr(4)}) {
    const std::string found = outputOf({"dpkg-query", "-S", path});
    if (!found.empty()) return found.substr(0, found.find_first_of(":,"));
  }
  return file + " of no package";
}

// Any of which will do: a link of /etc/alternatives may lead elsewhere on another machine.
Names packagesOf(const std::string& file) {
  std::error_code notALink;
  const fs::path target = fs::read_symlink(file, notALink);
  if (target.parent_path() != "/etc/alternatives") return {packageOf(file)};
  Names packages;
  for (const std::string& line :
       split(outputOf({"update-alternatives", "--query", target.filename().string()}), '\n'))
    if (line.starts_with("Alternative: ")) packages.insert(packageOf(line.substr(line.find('/'))));
  return packages;
}

std::map<std::string, Names> packagesOf(const Names& files) {
  std::vector<std::string> command = {"dpkg-query", "-S"};
  command.insert(command.end(), files.begin(), files.end());
  std::map<std::string, Names> packages;
  for (const std::string& line : split(outputOf(command), '\n'))
    packages[line.substr(line.rfind(": ") + 2)] = {line.substr(0, line.find_first_of(":,"))};
  for (const std::string& file : files)
    if (packages.count(file) == 0) packages[file] = packagesOf(file);
  return packages;
}

/// What is installed, with its dependencies.
class Installed {
 public:
  Installed() {
    for (const std::string& line :
         split(outputOf({"dpkg-query", "-W", "-f",
                         "${Package}\t${Provides}\t${Pre-Depends},${Depends}\t${Priority}\n"}),
               '\n')) {
      const std::vector<std::string> fields = split(line, '\t');
      if (fields.size() < 4) continue;
      needs_[fields[0]] = split(fields[2], ',');
      for (const std::string& name : split(fields[1], ',')) providers_[plain(name)].insert(fields[0]);
      if (fields[3] == "required") required_.insert(fields[0]);
    }
  }

  // These, all they depend on, and what every machine has.
  Names closureOf(const Names& wanted) const {
    Names closure;
    std::vector<std::string> open(wanted.begin(), wanted.end());
    open.insert(open.end(), required_.begin(), required_.end());
    while (!open.empty()) {
      const std::string name = open.back();
      open.pop_back();
      if (needs_.count(name) == 0 || !closure.insert(name).second) continue;
      for (const std::string& need : needs_.at(name))
        for (const std::string& taken : takenFor(need)) open.push_back(taken);
    }
    return closure;
  }

 private:
  // "libc6:any (>= 2.36)" is libc6.
  static std::string plain(const std::string& name) {
    const std::size_t first = name.find_first_not_of(' ');
    return first == name.npos ? "" : name.substr(first, name.find_first_of(" :(", first) - first);
  }
  // Of alternatives the first that is there, itself or under another name.
  Names takenFor(const std::string& need) const {
    for (const std::string& alternative : split(need, '|')) {
      const std::string name = plain(alternative);
      if (needs_.count(name) > 0) return {name};
      if (const auto found = providers_.find(name); found != providers_.end()) return found->second;
    }
    return {};
  }

  std::map<std::string, std::vector<std::string>> needs_;
  std::map<std::string, Names> providers_;
  Names required_;
};

Names documentedPackages() {
  Names packages;
  for (const std::string& line : split(fileText(sourcePath("share/packages.txt")), '\n')) {
    std::istringstream words(line);
    std::string package, purpose;
    if (words >> package >> purpose && purpose == "build" && package != "#") packages.insert(package);
  }
  return packages;
}

TEST(Packages, Bar01TheDocumentedPackagesHoldAllThatRexNeeds) {
  if (!runProcess({"dpkg-query", "--version"}).ok()) GTEST_SKIP() << "needs a Debian";
  Names files = filesOfTheBuild();
  ASSERT_GT(files.size(), 500u);
  files.merge(filesOfTheRun());
  const std::map<std::string, Names> packages = packagesOf(files);
  const Installed installed;
  const auto missing = [&](const Names& documented) {
    const Names closure = installed.closureOf(documented);
    Names lacking;
    const auto isThere = [&](const std::string& package) { return closure.count(package) > 0; };
    for (const auto& [file, holders] : packages)
      if (std::none_of(holders.begin(), holders.end(), isThere)) lacking.merge(Names(holders));
    return lacking;
  };
  const Names documented = documentedPackages();
  EXPECT_THAT(missing(documented), ::testing::IsEmpty());
  // Without one of them, the test notices.
  for (const char* package : {"libeigen3-dev", "libtinygltf-dev", "gnuplot-nox", "libosmesa6"}) {
    Names fewer = documented;
    EXPECT_EQ(fewer.erase(package), 1u) << package;
    EXPECT_THAT(missing(fewer), ::testing::Contains(package));
  }
}

}  // namespace rex::cli::packages_test
