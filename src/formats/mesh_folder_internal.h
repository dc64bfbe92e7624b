#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include <assimp/IOSystem.hpp>

namespace rex::mesh {

/// The files that assimp may read: the mesh, from memory and under a name of our own, and files in its folder
/// or below, after following links. Without a folder only the mesh.
class MeshFolder : public Assimp::IOSystem {
 public:
  /// Neither name nor bytes are copied.
  MeshFolder(const std::string& name, std::string_view bytes, std::filesystem::path folder)
      : name_(name), bytes_(bytes), folder_(std::move(folder)) {}

  bool Exists(const char* name) const override;
  char getOsSeparator() const override { return '/'; }
  /// The content of a file of the folder, if there is one.
  [[nodiscard]] std::optional<std::string> contentOf(const char* name) const;
  Assimp::IOStream* Open(const char* name, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;
  /// The materials that the libraries of an OBJ file define, as far as these were opened. assimp makes up
  /// those that it does not find.
  [[nodiscard]] const std::set<std::string>& materials() const { return materials_; }

 private:
  [[nodiscard]] std::filesystem::path find(const char* name) const;

  const std::string& name_;
  std::string_view bytes_;
  std::filesystem::path folder_;
  std::set<std::string> materials_;
};

}  // namespace rex::mesh
