#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// What a mesh file may ask for. assimp follows nesting by recursion, and believes the counts that a file
// declares.
namespace rex::mesh {

inline constexpr std::size_t kMostTriangles = 1'000'000;
inline constexpr std::size_t kMostVertices = 2'100'000;  ///< three for each triangle of the largest STL file
inline constexpr std::size_t kMostCorners = 1'000;       ///< of a face: cutting it takes their square
inline constexpr double kLargestCoordinate = 1e6;        ///< metres

/// Throws Error about a file.
[[noreturn]] void fail(const std::string& name, std::string what, std::string found, std::string wanted = "",
                       std::vector<std::string> nearest = {});

/// How large a file of this name may be, bytes: 32 MiB of STL, PLY, GLB and MSH, else 16 MiB, so that what
/// other programs write takes less than a second and 512 MB. Throws Error for an ending of no kind that rex
/// reads.
[[nodiscard]] std::size_t largestFile(const std::string& name);

/// Throws Error if a file of this name has more bytes.
void requireSize(std::size_t bytes, const std::string& name);

/// Throws Error if a count of vertices, or of what is named, is larger than may be.
void requireCount(std::size_t count, const std::string& name, std::size_t most = kMostVertices);

/// Throws Error if a mesh has more triangles than kMostTriangles.
void requireTriangles(std::size_t count, const std::string& name);

/// Throws Error naming the file if its bytes ask for more than the limits allow: counts of vertices and
/// faces, and nesting.
void requireHarmless(std::string_view bytes, const std::string& name);

}  // namespace rex::mesh
