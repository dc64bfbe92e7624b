#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include <assimp/IOStream.hpp>

#include "base/folders.h"
#include "base/text.h"
#include "formats/mesh_folder_internal.h"

namespace rex::mesh {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestNeighbour = 16u << 20;

// Bytes in memory, either owned or borrowed.
class Bytes : public Assimp::IOStream {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
  explicit Bytes(std::string own) : own_(std::move(own)), bytes_(own_) {}

  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t whole = std::min(count, (bytes_.size() - at_) / size);
    if (whole > 0) std::memcpy(to, bytes_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    if (offset > bytes_.size()) return aiReturn_FAILURE;
    const std::size_t from = origin == aiOrigin_CUR ? at_ : 0;
    if (origin != aiOrigin_END && offset > bytes_.size() - from) return aiReturn_FAILURE;
    at_ = origin == aiOrigin_END ? bytes_.size() - offset : from + offset;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::string own_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

// The names in lines such as "newmtl steel".
void addMaterials(const std::string& library, std::set<std::string>& names) {
  constexpr std::string_view kBegin = "newmtl", kBlanks = " \t";
  std::istringstream lines(library);
  for (std::string line; std::getline(lines, line);) {
    std::string_view rest = line;  // assimp knows none that is indented
    if (!rest.starts_with(kBegin)) continue;
    rest.remove_prefix(kBegin.size());
    if (!rest.empty() && kBlanks.find(rest.front()) != kBlanks.npos) names.emplace(trimmed(rest));
  }
}

}  // namespace

bool MeshFolder::Exists(const char* name) const { return name == name_ || !find(name).empty(); }

Assimp::IOStream* MeshFolder::Open(const char* name, const char*) {
  if (name == name_) return new Bytes(bytes_);
  std::optional<std::string> content = contentOf(name);
  if (content && endingOf(name) == ".mtl") addMaterials(*content, materials_);
  return content ? new Bytes(*std::move(content)) : nullptr;
}

std::optional<std::string> MeshFolder::contentOf(const char* name) const {
  const fs::path file = find(name);
  if (file.empty()) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

void MeshFolder::Close(Assimp::IOStream* stream) { delete stream; }

// Empty unless it is a file in the folder.
fs::path MeshFolder::find(const char* name) const {
  if (folder_.empty()) return {};
  std::error_code problem;
  const fs::path folder = fs::canonical(folder_, problem);
  const fs::path file = fs::canonical(folder / name, problem);
  if (problem || !fs::is_regular_file(file, problem) || fs::file_size(file, problem) > kLargestNeighbour)
    return {};
  return isBelow(folder, file) ? file : fs::path();
}

}  // namespace rex::mesh
