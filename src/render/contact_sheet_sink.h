#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "render/contact_sheet.h"
#include "render/frame_sink.h"

namespace rex {

/// Writes one PNG of key frames, evenly spaced over a film of any length and captioned with their times. It
/// keeps at most 2 * kSpare small pictures for each one shown: of longer films only every second, fourth ...
/// frame.
class ContactSheetSink final : public FrameSink {
 public:
  static constexpr std::size_t kSpare = 4;

  /// `rate`: frames per second. Throws Error for an option out of range.
  explicit ContactSheetSink(std::filesystem::path file, const ContactSheetOptions& options = {},
                            double rate = 30);
  /// Small pictures held at the moment.
  std::size_t kept() const { return kept_.size(); }

 private:
  void take(const Image& frame) override;
  void complete() override;
  void thin();

  std::filesystem::path file_;
  ContactSheetOptions options_;
  double rate_;
  std::vector<Image> kept_;  ///< kept_[i] is frame i * stride_
  Image last_;
  std::size_t stride_ = 1, count_ = 0;
};

}  // namespace rex
