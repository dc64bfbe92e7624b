#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/figure.h"
#include "render/film.h"

namespace rex::grading {

/// What a check that does not hold shows of it: what happened beside what was wanted.
struct Evidence {
  std::vector<Figure> figures{};
  Film film{};  ///< may be empty
  Eigen::Vector3d view = kDefaultView;
  double moment = 0;  ///< s, in the film: where it went wrong
};

/// Names of the files that show it, relative to the folder they are in; empty where there is none.
struct EvidenceFiles {
  std::string picture{};
  std::string replay{};
};

/// Rows of both over their columns, or the other way round for a tall matrix: at most four, those that differ
/// most. Both of the same size and finite, with more than one column or row.
[[nodiscard]] Figure comparison(const std::string& title, const Eigen::Ref<const Eigen::MatrixXd>& got,
                                const Eigen::Ref<const Eigen::MatrixXd>& wanted);

/// Draws it as ID.png, the figures in a row or else the film's moment, and a film as ID.html, which opens at
/// that moment with the figures beside it. Throws Error as writeFigure() and writeReport().
[[nodiscard]] EvidenceFiles writeEvidence(const Evidence& evidence, const std::string& id,
                                          const std::string& title, const std::filesystem::path& folder);

}  // namespace rex::grading
