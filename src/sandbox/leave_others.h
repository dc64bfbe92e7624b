#pragma once

namespace rex::sandbox {

/// Permanently prevents this process, also after exec, from tracing other processes and from reading or
/// writing their memory. Their environment variables may stay readable. Nothing else is forbidden, so it
/// suits programs that are not confined. Needs landlock (Linux 5.13) or root; returns whether it is in
/// force. Call it between fork and exec.
bool leaveOthersAlone() noexcept;

}  // namespace rex::sandbox
