#pragma once
#include <fmt/format.h>

#include "base/words.h"
