#pragma once

#include <array>

namespace rex::sandbox {

/// What every program needs of the system, beside /usr: links to its folders on newer systems, folders on
/// older.
inline constexpr std::array<const char*, 5> kRootFolders = {"/bin", "/lib", "/lib32", "/lib64", "/sbin"};

/// Where libraries and compilers of the system lie; no settings, names of users or keys.
inline constexpr std::array<const char*, 2> kSystemFiles = {"/etc/alternatives", "/etc/ld.so.cache"};

/// Devices that do no harm. Compilers do not get those without an end: a source file could include them.
inline constexpr std::array<const char*, 1> kDevices = {"/dev/null"};
inline constexpr std::array<const char*, 4> kEndlessDevices = {"/dev/zero", "/dev/full", "/dev/random",
                                                               "/dev/urandom"};

}  // namespace rex::sandbox
