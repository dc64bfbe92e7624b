#pragma once

#include <string>

#include "base/folders.h"
#include "live/live_server.h"

namespace rex {

/// Brings a page to the user. Where this machine shows windows, it opens the address in a browser, without
/// waiting for that: through a page in `folder` (null: never) that leads on to it, because everybody on this
/// machine could read the secret in an argument. Over ssh it opens nothing. Returns what the user must know,
/// such as the command that forwards the port, or nothing. Throws Error if the page cannot be written.
[[nodiscard]] std::string bringToUser(const LiveServer& server, const PrivateFolder* folder);

}  // namespace rex
