#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/mount.h>

#include "support/temporary_folder.h"

namespace rex {

/// A folder on a disk of its own of so many kilobytes; not there where mounting is not allowed.
class TinyDisk {
 public:
  explicit TinyDisk(int kilobytes) {
    const std::string size = "size=" + std::to_string(kilobytes) + "k";
    mounted_ = ::mount("tmpfs", path().c_str(), "tmpfs", 0, size.c_str()) == 0;
  }
  ~TinyDisk() {
    if (mounted_) ::umount2(path().c_str(), MNT_DETACH);
  }
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;
  bool mounted() const { return mounted_; }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  bool mounted_ = false;
};

}  // namespace rex

#define REX_NEEDS_DISK(disk) \
  if (!(disk).mounted()) GTEST_SKIP() << "a full disk takes the right to mount one"
