#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// The kinds of mesh files that are words in lines, or begin with such. assimp fills up what is missing in
// them, and crashes on some that are not quite right.
namespace rex::mesh {

/// The whole number at the begin of a text; 0 without, and as many as there can be for one that is too large.
[[nodiscard]] std::size_t numberAt(std::string_view text);

/// Throw Error naming the file if it is cut off, names vertices that it has not, has a header that assimp
/// does not bear, or asks for more than the limits allow.
void checkStl(std::string_view bytes, const std::string& name);
void checkObj(std::string_view bytes, const std::string& name);
void checkPly(std::string_view bytes, const std::string& name);
void checkOff(std::string_view bytes, const std::string& name);

}  // namespace rex::mesh
