#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace rex::grading {

/// HMAC-SHA256 (RFC 2104) of the message as 64 hexadecimal digits.
[[nodiscard]] std::string hmacSha256(std::string_view key, std::string_view message);

/// The seed of the hidden checks for one submission: the first 64 bits of the HMAC of submission, exercise
/// and group under the secret of the course.
[[nodiscard]] std::uint64_t hiddenSeed(std::string_view secret, std::string_view submissionSha256,
                                       std::string_view exercise, std::string_view group);

/// The text of the file without the line break at its end. Throws Error for fewer than 16 characters, so
/// that a file that is empty by mistake is not taken for a secret.
[[nodiscard]] std::string readCourseSecret(const std::filesystem::path& file);

/// What to say about a file of the secret that its group or others may read; empty if only its owner may, or
/// if there is none.
[[nodiscard]] std::string openSecretWarning(const std::filesystem::path& file);

/// Eight digits of the secret's hash, which identify it in results; empty if there is no secret.
[[nodiscard]] std::string courseSecretId(std::string_view secret);

}  // namespace rex::grading
