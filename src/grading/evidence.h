#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/figure.h"
#include "render/film.h"

namespace rex::grading {

// The colours of evidence: the result, what was wanted, and where it went wrong. They can be told apart
// with any kind of colour vision.
inline constexpr Color kGotColor{0.0f, 0.45f, 0.7f}, kWantedColor{0.20f, 0.22f, 0.26f},
    kWrongColor{0.80f, 0.10f, 0.12f};

/// The curve of a result: thick and blue.
[[nodiscard]] Series gotCurve(std::string label, std::vector<double> x = {}, std::vector<double> y = {});
/// The curve that was wanted: dashed and dark, drawn over the other.
[[nodiscard]] Series wantedCurve(std::string label, std::vector<double> x = {}, std::vector<double> y = {});
/// The part of a curve that went wrong: red and thick.
[[nodiscard]] Series wrongCurve(std::string label, std::vector<double> x = {}, std::vector<double> y = {});
/// A ring around a point where something went wrong.
[[nodiscard]] Series wrongPoint(std::string label, double x, double y);

/// A vertical line where a motion goes wrong.
[[nodiscard]] Guide wrongFrom(double time);

/// The result with the wanted picture drawn into it: solids in translucent green, lines in green, explained
/// by a caption. Solids that are the same in both are drawn once.
[[nodiscard]] Picture withWanted(Picture got, const Picture& wanted);
/// The same for every frame. After the end of the shorter film its last picture stays. Times are those of
/// the longer film.
[[nodiscard]] Film withWanted(const Film& got, const Film& wanted);

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
