#pragma once

#include <cstddef>

// What an .ors scene may hold, counted over all its files. No text within these limits takes long or much
// memory; share/doc/scenes.md lists them.
namespace rex::ors {

inline constexpr std::size_t kMostBytes = 32u << 20;
inline constexpr int kDeepestBraces = 100;
inline constexpr int kMostNodes = 200'000;
inline constexpr int kMostWords = 1'000'000;  ///< names and numbers
inline constexpr std::size_t kMostKeys = 64;  ///< or parents, of one node
inline constexpr std::size_t kMostAttributes = 256;
inline constexpr std::size_t kMostNumbers = 10'000;  ///< of one array
inline constexpr std::size_t kLongestWord = 256;
inline constexpr int kMostDirectives = 256;  ///< Include, ChDir and Delete
inline constexpr std::size_t kDeepestIncludes = 16;
inline constexpr std::size_t kMostJoints = 1'000;
inline constexpr std::size_t kMostRobots = 64;  ///< statements 'urdf'
inline constexpr std::size_t kMostNotes = 1'000;

}  // namespace rex::ors
