#pragma once

#include <string>

namespace MT {

/// Keeps the command line of a program, for getParameter().
void initCmdLine(int argc, char** argv);

/// What follows -NAME on the command line, otherwise `usual`. Throws Error for an int or double that is none,
/// and where nothing follows.
template <class T>
T getParameter(const char* name, const T& usual);
template <>
int getParameter(const char* name, const int& usual);
template <>
double getParameter(const char* name, const double& usual);
template <>
bool getParameter(const char* name, const bool& usual);
template <>
std::string getParameter(const char* name, const std::string& usual);

}  // namespace MT
