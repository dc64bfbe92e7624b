#include "live/live_pieces.h"

#include <cassert>
#include <functional>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace rex {
namespace {

std::size_t uint32At(const std::string& bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

}  // namespace

LivePieces piecesOf(const std::string& glb) {
  constexpr std::size_t kHeader = 12, kChunk = 8;  // bytes before a file and before a chunk
  const std::size_t length = uint32At(glb, kHeader), binary = kHeader + kChunk + length + kChunk;
  LivePieces result{.json = glb.substr(kHeader + kChunk, length)};
  const nlohmann::json all = nlohmann::json::parse(result.json);
  for (const nlohmann::json& view : all.value("bufferViews", nlohmann::json::array())) {
    const std::size_t at = view.value("byteOffset", std::size_t{0});
    std::string bytes = glb.substr(binary + at, view.at("byteLength").get<std::size_t>());
    assert(!bytes.empty());
    std::string name = fmt::format("piece-{:016x}-{}", std::hash<std::string>()(bytes), bytes.size());
    result.pieces.push_back({at, std::move(name), std::move(bytes)});
  }
  return result;
}

}  // namespace rex
