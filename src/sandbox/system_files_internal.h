#pragma once

#include <array>

namespace rex::sandbox {

/// What every program needs of the system, beside /usr: links to its folders on newer systems, folders on
/// older.
inline constexpr std::array<const char*, 5> kRootFolders = {"/bin", "/lib", "/lib32", "/lib64", "/sbin"};

/// Where libraries and compilers of the system lie; no settings, names of users or keys.
inline constexpr std::array<const char*, 2> kSystemFiles = {"/etc/alternatives", "/etc/ld.so.cache"};

inline constexpr std::array<const char*, 5> kDevices = {"/dev/null", "/dev/zero", "/dev/full", "/dev/random",
                                                        "/dev/urandom"};

}  // namespace rex::sandbox
