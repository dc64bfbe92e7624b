#include "render/contact_sheet_sink.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "render/png.h"
#include "render/shrunk.h"

namespace rex {

ContactSheetSink::ContactSheetSink(std::filesystem::path file, const ContactSheetOptions& options,
                                   double rate)
    : FrameSink(file.string()), file_(std::move(file)), options_(options), rate_(rate) {
  requireValid(options);
  if (!(rate > 0))
    throw Error({.what = "contact sheet: frames per second",
                 .found = fmt::format("{:g}", rate),
                 .wanted = "more than 0"});
}

void ContactSheetSink::take(const Image& frame) {
  if (count_ % stride_ == 0) kept_.push_back(shrunk(frame, options_.pictureWidth));
  last_ = frame;
  ++count_;
  if (kept_.size() > 2 * kSpare * static_cast<std::size_t>(options_.pictures)) thin();
}

// Drops every second one.
void ContactSheetSink::thin() {
  for (std::size_t i = 1; 2 * i < kept_.size(); ++i) kept_[i] = std::move(kept_[2 * i]);
  kept_.resize((kept_.size() + 1) / 2);
  stride_ *= 2;
}

void ContactSheetSink::complete() {
  std::vector<KeyFrame> frames;
  for (const std::size_t ideal : keyFrames(count_, options_.pictures)) {
    const bool isLast = ideal + 1 == count_;
    const std::size_t nearest = std::min((ideal + stride_ / 2) / stride_, kept_.size() - 1);
    const std::size_t shown = isLast ? ideal : nearest * stride_;
    frames.push_back(
        {isLast ? last_ : kept_[nearest], fmt::format("{:.2f} s", static_cast<double>(shown) / rate_)});
  }
  writePng(contactSheet(frames, options_), file_);
}

}  // namespace rex
