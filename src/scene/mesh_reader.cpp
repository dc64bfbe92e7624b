#include "scene/mesh_reader.h"

#include <fstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/lower_case.h"
#include "scene/files_internal.h"
#include "scene/isolated_mesh_internal.h"
#include "scene/mesh_limits_internal.h"

namespace rex {
namespace {

namespace fs = std::filesystem;
using mesh::fail;

std::string whyUnreadable(const fs::path& file) {
  std::error_code problem;
  const fs::file_type type = fs::status(file, problem).type();
  if (type == fs::file_type::regular) return {};
  if (type == fs::file_type::not_found) return "no such file";
  if (type == fs::file_type::directory) return "a folder";
  return problem ? problem.message() : "a device";
}

std::string readBytes(const fs::path& file) {
  if (const std::string obstacle = whyUnreadable(file); !obstacle.empty())
    fail(file.string(), "cannot read the mesh file", obstacle, "a file",
         nearestNames(file.filename().string(), internal::namesBeside(file)));
  std::error_code problem;
  const std::uintmax_t size = fs::file_size(file, problem);
  mesh::requireSize(size, file.string());
  std::string bytes(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) fail(file.string(), "cannot read the mesh file", "a file that cannot be opened", "a file");
  return bytes;
}

// Ten times what good files take, plus four seconds for slow machines: not every file on which assimp never
// returns is recognised beforehand. A glTF file keeps most of its data, and all textures, in other files.
IsolationLimits limitsFor(std::size_t bytes, const std::string& name, bool textures) {
  IsolationLimits limits;
  if (endingOf(name) != ".gltf" && !textures) limits.cpuSeconds = 4 + static_cast<double>(bytes >> 22);
  return limits;
}

TexturedMesh meshOf(std::string_view bytes, const std::string& name, const fs::path& folder, bool textures) {
  mesh::requireSize(bytes.size(), name);
  mesh::requireHarmless(bytes, name);
  return mesh::readIsolated(bytes, name, folder, limitsFor(bytes.size(), name, textures), textures);
}

TexturedMesh meshOf(const fs::path& file, bool textures) {
  static_cast<void>(mesh::largestFile(file.string()));  // the ending first, then the file
  return meshOf(readBytes(file), file.string(), internal::folderOf(file), textures);
}

}  // namespace

TexturedMesh mesh::readFile(const fs::path& file, bool textures) { return meshOf(file, textures); }

TriangleMesh readMesh(const fs::path& file) { return meshOf(file, false).mesh; }

TexturedMesh readTexturedMesh(const fs::path& file) { return meshOf(file, true); }

TriangleMesh parseMesh(std::string_view bytes, const std::string& name) {
  return meshOf(bytes, name, {}, false).mesh;
}

}  // namespace rex
