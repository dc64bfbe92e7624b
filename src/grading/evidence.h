#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/figure.h"
#include "render/film.h"

namespace rex::grading {

/// What a failed check shows: what happened next to what was wanted.
struct Evidence {
  std::vector<Figure> figures{};
  Film film{};  ///< may be empty
  Eigen::Vector3d view = kDefaultView;
  double moment = 0;  ///< time in the film where it went wrong, s
};

/// Names of the files that show the evidence, relative to their folder; empty if there is none.
struct EvidenceFiles {
  std::string picture{};
  std::string replay{};
};

/// Plots the rows of both matrices over their columns, or the columns of a tall matrix over its rows: at
/// most four, those that differ most, and of many columns the 400 around the worst. Both must be finite and
/// of the same size, with more than one row or column.
[[nodiscard]] Figure comparison(const std::string& title, const Eigen::Ref<const Eigen::MatrixXd>& got,
                                const Eigen::Ref<const Eigen::MatrixXd>& wanted);

/// What the evidence of a check says in words.
struct EvidenceText {
  std::string title{};    ///< of the check
  std::string failure{};  ///< the requirement that failed, with its numbers
};

/// Draws the evidence as ID.png: the failure in words above the figures in a row, or else above the film's
/// frame at `moment`. Writes a film as ID.html, which opens at that moment with the figures next to it.
/// Throws Error like writeFigure() and writeReport().
[[nodiscard]] EvidenceFiles writeEvidence(const Evidence& evidence, const std::string& id,
                                          const EvidenceText& text, const std::filesystem::path& folder);

}  // namespace rex::grading
