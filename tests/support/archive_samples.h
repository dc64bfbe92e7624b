#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace rex {

/// One member of an archive that a test makes by hand, so that it can be anything.
struct SampleMember {
  std::string name{};
  std::string text{};
  char type = '0';               ///< of tar: 0 file, 1 hard link, 2 symbolic link, 3 device, 5 folder, 6 pipe
  std::string target{};          ///< of a link
  std::uint32_t mode = 0100644;  ///< of Unix, with its type of file, in a zip
};

/// The text of a tar file (ustar).
inline std::string tarOf(const std::vector<SampleMember>& members) {
  std::string tar;
  for (const SampleMember& member : members) {
    std::string header(512, '\0');
    const auto put = [&](std::size_t at, std::string_view text) {
      std::memcpy(header.data() + at, text.data(), text.size());
    };
    put(0, member.name.substr(0, 100));
    put(100, "0000644\0");
    put(124, fmt::format("{:011o}", member.text.size()));
    put(136, "00000000000");
    put(148, "        ");
    header[156] = member.type;
    put(157, member.target);
    put(257, std::string_view("ustar\00000", 8));
    unsigned sum = 0;
    for (const char c : header) sum += static_cast<unsigned char>(c);
    put(148, fmt::format("{:06o}", sum) + std::string("\0 ", 2));
    tar += header + member.text + std::string((512 - member.text.size() % 512) % 512, '\0');
  }
  return tar + std::string(1024, '\0');
}

/// The CRC-32 of zip files, one bit at a time.
inline std::uint32_t crcOf(std::string_view text) {
  std::uint32_t crc = 0xffffffff;
  for (const char c : text) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ (0xedb88320u & (0u - (crc & 1u)));
  }
  return ~crc;
}

/// The text of a zip file whose members are not compressed. `claimed` other than nothing: the size that its
/// headers tell of each.
inline std::string zipOf(const std::vector<SampleMember>& members, std::int64_t claimed = -1) {
  std::string zip, directory;
  const auto number = [](std::uint64_t value, int bytes) {
    std::string text;
    for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> (8 * k) & 0xff);
    return text;
  };
  for (const SampleMember& member : members) {
    const std::uint64_t size = claimed < 0 ? member.text.size() : static_cast<std::uint64_t>(claimed);
    const std::string common = number(20, 2) + number(0, 4) + number(0x00210000, 4) +
                               number(crcOf(member.text), 4) + number(size, 4) + number(size, 4) +
                               number(member.name.size(), 2) + number(0, 2);
    directory += "PK\x01\x02" + number(0x0314, 2) + common + number(0, 6) +
                 number(std::uint64_t{member.mode} << 16, 4) + number(zip.size(), 4) + member.name;
    zip += "PK\x03\x04" + common + member.name + member.text;
  }
  return zip + directory + "PK\x05\x06" + number(0, 4) + number(members.size(), 2) +
         number(members.size(), 2) + number(directory.size(), 4) + number(zip.size(), 4) + number(0, 2);
}

}  // namespace rex
