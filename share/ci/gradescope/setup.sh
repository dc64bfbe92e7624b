#!/usr/bin/env bash
# Gradescope runs this once, as root, when it makes the image: installs the packages and builds rex.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
# A zip keeps no owner.
[ ! -e secret ] || { chown "$(id -u):$(id -g)" secret && chmod 600 secret; }
rex/scripts/rex list
# The grader is built when it is first asked for: better now than while the first student waits. Below full score is what
# the file gets that was handed out.
rex/scripts/rex test "$(cat exercise)" || [ $? -eq 1 ]
