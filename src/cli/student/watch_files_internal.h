#pragma once

namespace rex::cli {

/// The files of share/watch.
extern const char *const kWatchPage, *const kWatchStyle, *const kWatchScript;

}  // namespace rex::cli
