#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"
#include "cli/json_internal.h"
#include "cli/project.h"

namespace rex::cli {

/// A JSON object whose fields are matrices, each a list of rows. All errors name the file.
class MatrixFile {
 public:
  /// Reads it, and notes on stderr which fields are not among `known`. `given`: the name for messages. Throws
  /// Error unless it holds a JSON object.
  MatrixFile(const std::filesystem::path& path, const std::filesystem::path& given,
             const std::vector<std::string>& known);

  [[nodiscard]] bool has(const std::string& name) const { return object_.contains(name); }
  /// Throws Error if it is not there, or is not a list of rows of as many numbers.
  [[nodiscard]] Eigen::MatrixXd matrix(const std::string& name) const;
  [[nodiscard]] double number(const std::string& name) const;

  /// What `attempt` returns. An Error that it throws gets the name of the file.
  template <class Attempt>
  auto blamed(const Attempt& attempt) const {
    try {
      return attempt();
    } catch (const Error& error) {
      ErrorParts parts = error.parts();
      parts.where = {.file = file_};
      throw Error(std::move(parts));
    }
  }

 private:
  [[nodiscard]] Error wrong(const std::string& what, const std::string& found,
                            const std::string& wanted) const;
  [[nodiscard]] double numberOf(const Json& json, const std::string& what) const;

  std::string file_;
  Json object_;
};

/// The file, or that of the project if there is none here: an example.
[[nodiscard]] std::filesystem::path inProject(const Project& project, const std::filesystem::path& file);

/// "K =" and its rows.
[[nodiscard]] std::string matrixText(const char* name, const Eigen::MatrixXd& M);
/// Pairs of real and imaginary part.
[[nodiscard]] Json jsonOfComplex(const Eigen::VectorXcd& values);
/// Prints one on each line.
void sayComplex(const Eigen::VectorXcd& values);

}  // namespace rex::cli
