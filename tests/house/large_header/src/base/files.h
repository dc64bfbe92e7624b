#pragma once

#include <filesystem>
