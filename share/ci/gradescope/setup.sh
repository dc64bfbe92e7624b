#!/usr/bin/env bash
# Gradescope runs this once, as root, when it makes the image: installs the packages and builds rex.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/rex"
scripts/rex list
