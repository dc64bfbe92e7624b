#include "submission/included_files.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "submission/build_tools.h"
#include "submission/mentions.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

int lineOf(std::string_view name, std::string_view source) {
  const std::size_t at = source.find(name);
  if (at == source.npos) return 0;
  return 1 +
         static_cast<int>(std::count(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

bool isBelow(const fs::path& folder, const fs::path& file) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// Headers of Eigen have no ending.
bool isPublicHeader(const fs::path& file) {
  const std::string name = file.filename().string(), ending = file.extension().string();
  return (ending.empty() || ending == ".h" || ending == ".hpp") && !name.ends_with("_internal.h");
}

/// What may be included, by its place.
class Allowed {
 public:
  Allowed(const std::string& mainFile, const fs::path& folder, const Toolchain& toolchain) {
    add(folder / mainFile);
    if (!toolchain.prefix.empty()) add(toolchain.prefix), add(toolchain.prefix.string() + ".gch");
    for (std::size_t k = 1; k < toolchain.flags.size(); ++k) {
      if (toolchain.flags[k - 1] == "-include") add(toolchain.flags[k]);  // ours: options of the sanitizers
      if (toolchain.flags[k - 1] == "-isystem") libraries_.push_back(normal(toolchain.flags[k]));
      if (toolchain.flags[k - 1] == "-iquote")
        for (const fs::path& header : studentHeaders(toolchain.flags[k])) add(header);
    }
    system_ = {"/usr/include", "/usr/local/include", "/usr/lib"};
    // One of one's own brings its own headers: /opt/gcc/bin/g++.
    const fs::path home = fs::path(toolchain.compiler).parent_path().parent_path();
    if (toolchain.compiler.starts_with('/') && home != "/")
      for (const char* place : {"include", "lib", "lib64"}) system_.push_back(home / place);
  }

  bool holds(const fs::path& file) const {
    if (files_.contains(file)) return true;
    // A library may lie below the system's headers, not the other way round.
    for (const fs::path& library : libraries_)
      if (isBelow(library, file)) return isPublicHeader(file);
    return std::any_of(system_.begin(), system_.end(),
                       [&](const fs::path& folder) { return isBelow(folder, file); });
  }

 private:
  static fs::path normal(const fs::path& path) { return fs::absolute(path).lexically_normal(); }
  void add(const fs::path& file) { files_.insert(normal(file)); }

  std::set<fs::path> files_;
  std::vector<fs::path> libraries_, system_;
};

CompileDiagnostic refusal(const std::string& mainFile, int line, std::string message) {
  return {mainFile, line, line > 0 ? 1 : 0, "error", "forbidden-call", std::move(message)};
}

}  // namespace

std::vector<fs::path> dependenciesIn(std::string_view list, const fs::path& folder) {
  std::vector<fs::path> files;
  std::string name;
  const auto end = [&] {
    if (!name.empty() && name.back() != ':') files.push_back((folder / name).lexically_normal());
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
    if (allowed.holds(file)) continue;
    const std::string name = file.filename().string();
    messages.push_back(refusal(
        mainFile, lineOf(name, source),
        fmt::format(
            "includes {}: only public headers of the library, of the system and of the exercise may be "
            "included",
            name)));
  }
  return messages;
}

std::vector<CompileDiagnostic> forbiddenMacros(std::string_view source, const std::string& mainFile) {
  const int line = macroDefinitionLineOf("rex", source);
  if (line == 0) return {};
  return {refusal(mainFile, line, "defines a macro 'rex', which is the name of the library")};
}

}  // namespace rex::grading
